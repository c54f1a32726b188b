// Encodes small images for reports as PNG files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::tools
{

/// Encode codes of 8 bits as a PNG file.
///
/// channels  1: grey; 3: red, green, blue
/// codes     width * height * channels, rows from top to bottom
std::vector<std::byte> encodePng(uint32_t width, uint32_t height, uint32_t channels,
                                 std::span<const uint8_t> codes);

} // namespace hearth::tools
