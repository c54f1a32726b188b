// PNG encoding.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <cstddef>

namespace hearth::samples
{

/// The image as a PNG file: RGB where every texel is opaque, else RGBA. Same image, same bytes.
std::vector<std::byte> encodePng(const Image& image);

} // namespace hearth::samples
