// Draws a thumbnail of an image, and a picture of the error of its encoding, for reports.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/search/search.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hearth::texels
{

/// Longer side of a picture, in pixels.
inline constexpr uint32_t kPictureSide = 128;

/// Times the image's error that the brightest colour of its picture stands for.
inline constexpr double kPictureScale = 4;

/// Picture with red, green and blue of 8 bits, rows from top to bottom.
struct Picture
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<std::array<uint8_t, 3>> pixels{};
};

/// An image beside its error, of one size.
struct PicturePair
{
    Picture thumbnail{};
    /// RMS over the texels of mip 0 under a pixel, from some of their rows: black where exact, red at the
    /// error of the whole image, white from kPictureScale times that error on.
    Picture error{};
};

/// Draw an image and the error of its encoding. Cut-outs lie on grey squares; light is compressed to what a
/// screen shows.
PicturePair drawPictures(const PlainImage& image, const Encoding& encoding);

/// Place of a pair in a sheet: the error is right of the thumbnail, kPictureSide away.
struct SheetPlace
{
    uint32_t x = 0;
    uint32_t y = 0;
};

/// Return the place of a pair in the sheet of drawSheet.
SheetPlace findSheetPlace(size_t pair);

/// Draw all pairs into one picture; at least one.
Picture drawSheet(const std::vector<PicturePair>& pairs);

} // namespace hearth::texels
