// Imports the FLIP image difference metric of hearth-compare into the tests' namespace.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/compare/flip.h"
#include "tests/reference/png_image.h"

namespace hearth::reference
{

using viewer::flip;
using viewer::FlipMap;
using viewer::kFlipPixelsPerDegree;
using viewer::makeFlipImage;

} // namespace hearth::reference
