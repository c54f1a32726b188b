// Bitmap font for labels in images: 5 x 7 pixels per letter, capitals only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace hearth::viewer
{

inline constexpr uint32_t kLetterHeight = 7;
inline constexpr uint32_t kLetterAdvance = 6; ///< from one letter to the next

/// RGBA8 image in memory, rows from top to bottom.
struct Raster
{
    std::span<std::byte> rgba;
    uint32_t width = 0;
    uint32_t height = 0;
};

/// Draw a line of UTF-8 text, each pixel of a letter as `scale` x `scale` pixels of one grey. Small letters
/// become capitals; a character without a letter becomes a box. Pixels outside of the image are left out.
/// x, y  of the top left corner
void drawText(const Raster& raster, uint32_t x, uint32_t y, uint32_t scale, std::string_view text,
              std::byte grey);

/// Return the number of letters that drawText draws for a text.
size_t countLetters(std::string_view text);

/// Return the longest start of a text with at most `count` letters; never splits a character.
std::string_view firstLetters(std::string_view text, size_t count);

} // namespace hearth::viewer
