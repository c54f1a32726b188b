// Imports the image type and the PNG reader of hearth-compare into the tests' namespace.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/compare/image.h"

namespace hearth::reference
{

using viewer::Image;
using viewer::linearFromSrgb;
using viewer::readPng;
using viewer::srgbFromLinear;
using viewer::writePng;

} // namespace hearth::reference
