// Writes small pictures as PNG without compression, and without its library: hearth starts in milliseconds.
// Sources: W3C Portable Network Graphics (Second Edition); RFC 1950 and 1951.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texture_files
{

/// Return the bytes of a file of red, green and blue with 8 bits each.
/// codes  3 * width * height (asserted), rows from top to bottom
std::vector<std::byte> writePng(uint32_t width, uint32_t height, std::span<const uint8_t> codes);

} // namespace hearth::texture_files
