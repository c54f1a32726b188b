// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/pixel_font.h"

#include <algorithm>

namespace hearth::viewer
{

namespace
{

constexpr uint32_t kLetterWidth = 5;

/// Glyph: rows from top to bottom, separated by spaces.
struct Letter
{
    char character;
    const char* pixels;
};

// clang-format off
constexpr Letter kLetters[] = {
    {'0', ".###. #...# #..## #.#.# ##..# #...# .###."},
    {'1', "..#.. .##.. ..#.. ..#.. ..#.. ..#.. .###."},
    {'2', ".###. #...# ....# ..##. .#... #.... #####"},
    {'3', "####. ....# ....# .###. ....# ....# ####."},
    {'4', "#..#. #..#. #..#. ##### ...#. ...#. ...#."},
    {'5', "##### #.... ####. ....# ....# #...# .###."},
    {'6', ".###. #.... #.... ####. #...# #...# .###."},
    {'7', "##### ....# ...#. ...#. ..#.. ..#.. ..#.."},
    {'8', ".###. #...# #...# .###. #...# #...# .###."},
    {'9', ".###. #...# #...# .#### ....# ....# .###."},
    {'A', ".###. #...# #...# ##### #...# #...# #...#"},
    {'B', "####. #...# #...# ####. #...# #...# ####."},
    {'C', ".###. #...# #.... #.... #.... #...# .###."},
    {'D', "####. #...# #...# #...# #...# #...# ####."},
    {'E', "##### #.... #.... ####. #.... #.... #####"},
    {'F', "##### #.... #.... ####. #.... #.... #...."},
    {'G', ".###. #...# #.... #.### #...# #...# .###."},
    {'H', "#...# #...# #...# ##### #...# #...# #...#"},
    {'I', ".###. ..#.. ..#.. ..#.. ..#.. ..#.. .###."},
    {'J', "..### ...#. ...#. ...#. ...#. #..#. .##.."},
    {'K', "#...# #..#. #.#.. ##... #.#.. #..#. #...#"},
    {'L', "#.... #.... #.... #.... #.... #.... #####"},
    {'M', "#...# ##.## #.#.# #.#.# #...# #...# #...#"},
    {'N', "#...# ##..# ##..# #.#.# #..## #..## #...#"},
    {'O', ".###. #...# #...# #...# #...# #...# .###."},
    {'P', "####. #...# #...# ####. #.... #.... #...."},
    {'Q', ".###. #...# #...# #...# #.#.# #..#. .##.#"},
    {'R', "####. #...# #...# ####. #.#.. #..#. #...#"},
    {'S', ".#### #.... #.... .###. ....# ....# ####."},
    {'T', "##### ..#.. ..#.. ..#.. ..#.. ..#.. ..#.."},
    {'U', "#...# #...# #...# #...# #...# #...# .###."},
    {'V', "#...# #...# #...# #...# .#.#. .#.#. ..#.."},
    {'W', "#...# #...# #...# #.#.# #.#.# ##.## #...#"},
    {'X', "#...# #...# .#.#. ..#.. .#.#. #...# #...#"},
    {'Y', "#...# #...# .#.#. ..#.. ..#.. ..#.. ..#.."},
    {'Z', "##### ....# ...#. ..#.. .#... #.... #####"},
    {'.', "..... ..... ..... ..... ..... .##.. .##.."},
    {'-', "..... ..... ..... .###. ..... ..... ....."},
    {'_', "..... ..... ..... ..... ..... ..... #####"},
    {' ', "..... ..... ..... ..... ..... ..... ....."},
    {'(', "...#. ..#.. .#... .#... .#... ..#.. ...#."},
    {')', ".#... ..#.. ...#. ...#. ...#. ..#.. .#..."},
    {'+', "..... ..#.. ..#.. ##### ..#.. ..#.. ....."},
};
constexpr Letter kMissingLetter = {'?', "##### #...# #...# #...# #...# #...# #####"};
// clang-format on

const Letter& findLetter(char character)
{
    const char capital =
        character >= 'a' && character <= 'z' ? static_cast<char>(character - 'a' + 'A') : character;
    const auto* found = std::find_if(std::begin(kLetters), std::end(kLetters),
                                     [capital](const Letter& letter) { return letter.character == capital; });
    return found == std::end(kLetters) ? kMissingLetter : *found;
}

/// True for continuation bytes of a UTF-8 character.
bool isContinuation(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

void fill(const Raster& raster, uint32_t x, uint32_t y, uint32_t side, std::byte grey)
{
    for (uint32_t row = y; row < std::min(y + side, raster.height); ++row)
        for (uint32_t column = x; column < std::min(x + side, raster.width); ++column)
        {
            std::byte* pixel = raster.rgba.data() + (size_t{row} * raster.width + column) * 4;
            pixel[0] = pixel[1] = pixel[2] = grey;
            pixel[3] = std::byte{255};
        }
}

} // namespace

void drawText(const Raster& raster, uint32_t x, uint32_t y, uint32_t scale, std::string_view text,
              std::byte grey)
{
    for (const char character : text)
    {
        if (isContinuation(character))
            continue;
        const Letter& letter = findLetter(character);
        for (uint32_t row = 0; row < kLetterHeight; ++row)
            for (uint32_t column = 0; column < kLetterWidth; ++column)
                if (letter.pixels[row * (kLetterWidth + 1) + column] == '#')
                    fill(raster, x + column * scale, y + row * scale, scale, grey);
        x += kLetterAdvance * scale;
    }
}

size_t countLetters(std::string_view text)
{
    return static_cast<size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return !isContinuation(c); }));
}

std::string_view firstLetters(std::string_view text, size_t count)
{
    size_t at = 0;
    for (; at < text.size(); ++at)
        if (!isContinuation(text[at]) && count-- == 0)
            break;
    return text.substr(0, at);
}

} // namespace hearth::viewer
