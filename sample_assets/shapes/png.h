// Encodes PNG files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <cstddef>

namespace hearth::samples
{

/// Encode the image as a PNG file: RGB if every texel is opaque, else RGBA. Deterministic.
std::vector<std::byte> encodePng(const Image& image);

} // namespace hearth::samples
