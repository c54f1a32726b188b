// Writes pictures as PNG with zlib alone: libpng is not loaded, so that hearth starts in milliseconds.
// Source: W3C Portable Network Graphics (Second Edition).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texture_files
{

struct PngFormat
{
    uint32_t channels = 3; ///< 3: red, green, blue; 4: alpha as well
    uint32_t bits = 8;     ///< of a channel, 8 or 16
};

/// Return the bytes of a file.
/// codes  channels of all texels (size asserted), rows from top to bottom; those of 16 bits are big-endian
std::vector<std::byte> writePng(uint32_t width, uint32_t height, PngFormat format,
                                std::span<const uint8_t> codes);

} // namespace hearth::texture_files
