// OpenEXR encoding of linear images.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::viewer
{

/// Encode linear Rec. 709 colours as an OpenEXR file in memory: scanlines, half floats, channels R, G, B.
/// Colours beyond a half float are the largest one.
/// rgb  three of each pixel, rows from top to bottom
/// errors: internal.
Result<std::vector<std::byte>> encodeExr(std::span<const float> rgb, uint32_t width, uint32_t height);

} // namespace hearth::viewer
