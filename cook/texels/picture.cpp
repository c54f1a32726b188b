// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/picture.h"

#include "formats/base/half.h"
#include "formats/texels/decode_texels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace hearth::texels
{

using namespace formats;

namespace
{

// Pairs in a row of a sheet.
constexpr size_t kPairsAcross = 4;

using Pixel = std::array<uint8_t, 3>;

uint8_t toByte(double value)
{
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

/// Colours of errors as shares of the brightest: black, violet, red at a quarter, yellow, white.
Pixel mapError(double share)
{
    constexpr double kStops[][4] = {
        {0, 0, 0, 0}, {0.125, 0.25, 0.05, 0.35}, {0.25, 0.8, 0.1, 0.2}, {0.55, 1, 0.75, 0.1}, {1, 1, 1, 1}};
    const double at = std::clamp(share, 0.0, 1.0);
    size_t i = 1;
    while (kStops[i][0] < at)
        ++i;
    const double part = (at - kStops[i - 1][0]) / (kStops[i][0] - kStops[i - 1][0]);
    Pixel pixel;
    for (size_t c = 0; c < 3; ++c)
        pixel[c] = toByte(kStops[i - 1][c + 1] + part * (kStops[i][c + 1] - kStops[i - 1][c + 1]));
    return pixel;
}

/// Return the pixel of a thumbnail as a screen shows it.
/// is_light_square  a square behind what is not opaque
Pixel showTexel(const PlainImage& image, const DecodedTexel& texel, bool is_light_square)
{
    Pixel pixel;
    for (size_t c = 0; c < 3; ++c)
    {
        double value = texel[c] / 65535.0;
        if (image.role == ImageRole::light)
        {
            const double light = std::max(0.0, double{floatFromHalf(texel[c])});
            value = std::pow(light / (1 + light), 1 / 2.2);
        }
        if (image.role == ImageRole::cutout)
        {
            const double alpha = texel[3] / 65535.0;
            value = value * alpha + (is_light_square ? 0.6 : 0.45) * (1 - alpha);
        }
        pixel[c] = toByte(value);
    }
    return pixel;
}

/// Return the size of the pictures of an image.
MipExtent pictureExtent(const ImageRecord& image)
{
    const uint32_t side = std::max(image.width, image.height);
    if (side <= kPictureSide)
        return {image.width, image.height};
    const auto scale = [&](uint32_t length)
    { return std::max((length * kPictureSide + side / 2) / side, 1u); };
    return {scale(image.width), scale(image.height)};
}

/// Return the coarsest mip that is not smaller than a size.
uint32_t findMip(const ImageRecord& image, const MipExtent& size)
{
    uint32_t mip = 0;
    while (mip + 1 < image.mip_count && mipExtent(image, mip + 1).width >= size.width &&
           mipExtent(image, mip + 1).height >= size.height)
        ++mip;
    return mip;
}

Picture drawThumbnail(const PlainImage& image)
{
    const MipExtent size = pictureExtent(image.record);
    const uint32_t mip = findMip(image.record, size);
    const MipExtent extent = mipExtent(image.record, mip);
    Picture picture{.width = size.width, .height = size.height};
    for (uint32_t y = 0; y < size.height; ++y)
    {
        const auto row = static_cast<uint32_t>((2 * uint64_t{y} + 1) * extent.height / (2 * size.height));
        const std::vector<DecodedTexel> texels = decodeRows(image, mip, row, 1);
        for (uint32_t x = 0; x < size.width; ++x)
        {
            const size_t column = (2 * uint64_t{x} + 1) * extent.width / (2 * size.width);
            picture.pixels.push_back(showTexel(image, texels[column], ((x / 8 + y / 8) & 1) != 0));
        }
    }
    return picture;
}

/// Draw a row of an error's picture from the row of blocks under its middle.
void drawErrorRow(const PlainImage& image, const Encoding& encoding, double brightest, uint32_t y,
                  Picture& picture)
{
    const TexelFormatTraits& traits = *encoding.candidate.traits;
    const uint32_t width = image.record.width, height = image.record.height;
    const auto middle = static_cast<uint32_t>((2 * uint64_t{y} + 1) * height / (2 * picture.height));
    const uint32_t block_row = middle / traits.block_height;
    const uint32_t first = block_row * traits.block_height;
    const uint32_t rows = std::min<uint32_t>(traits.block_height, height - first);
    const auto row_bytes = static_cast<size_t>(formats::mipBytes(traits, width, 1));
    std::vector<DecodedTexel> stored(size_t{width} * rows);
    decodeBlockRow(traits, width, rows, std::span(encoding.texels).subspan(block_row * row_bytes, row_bytes),
                   stored);
    readStored(encoding.candidate, stored);
    const std::vector<DecodedTexel> plain = decodeRows(image, 0, first, rows);
    for (uint32_t x = 0; x < picture.width; ++x)
    {
        const size_t begin = size_t{x} * width / picture.width;
        const size_t end = std::max<size_t>((size_t{x} + 1) * width / picture.width, begin + 1);
        double sum = 0;
        for (size_t row = 0; row < rows; ++row)
            for (size_t column = begin; column < end; ++column)
            {
                const size_t i = row * width + column;
                const double error = texelError(image.role, image.channels, plain[i], stored[i]);
                sum += error * error;
            }
        const double rms = std::sqrt(sum / (static_cast<double>(end - begin) * rows));
        picture.pixels[size_t{y} * picture.width + x] = mapError(brightest > 0 ? rms / brightest : 0);
    }
}

void copyInto(const Picture& part, uint32_t left, uint32_t top, Picture& sheet)
{
    for (uint32_t y = 0; y < part.height; ++y)
        std::copy_n(part.pixels.begin() + static_cast<ptrdiff_t>(size_t{y} * part.width), part.width,
                    sheet.pixels.begin() + static_cast<ptrdiff_t>(size_t{top + y} * sheet.width + left));
}

} // namespace

PicturePair drawPictures(const PlainImage& image, const Encoding& encoding)
{
    PicturePair pair{.thumbnail = drawThumbnail(image)};
    pair.error = {.width = pair.thumbnail.width, .height = pair.thumbnail.height};
    pair.error.pixels.resize(pair.thumbnail.pixels.size());
    tbb::parallel_for(uint32_t{0}, pair.error.height,
                      [&](uint32_t y) {
                          drawErrorRow(image, encoding, kPictureScale * encoding.error.error, y, pair.error);
                      });
    return pair;
}

SheetPlace findSheetPlace(size_t pair)
{
    return {static_cast<uint32_t>(pair % kPairsAcross * 2 * kPictureSide),
            static_cast<uint32_t>(pair / kPairsAcross * kPictureSide)};
}

Picture drawSheet(const std::vector<PicturePair>& pairs)
{
    const size_t across = std::min(pairs.size(), kPairsAcross);
    const size_t down = (pairs.size() + kPairsAcross - 1) / kPairsAcross;
    Picture sheet{.width = static_cast<uint32_t>(across * 2 * kPictureSide),
                  .height = static_cast<uint32_t>(down * kPictureSide)};
    sheet.pixels.resize(size_t{sheet.width} * sheet.height);
    for (size_t i = 0; i < pairs.size(); ++i)
    {
        const SheetPlace place = findSheetPlace(i);
        copyInto(pairs[i].thumbnail, place.x, place.y, sheet);
        copyInto(pairs[i].error, place.x + kPictureSide, place.y, sheet);
    }
    return sheet;
}

} // namespace hearth::texels
