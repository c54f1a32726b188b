// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/target.h"

#include "cook/texels/encoding/texel_error.h"
#include "formats/base/double3.h"
#include "formats/pack/image_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace hearth::texels
{

using namespace formats;

namespace
{

// Target of smooth texels where no seam shows.
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

constexpr double kCutoutGain = 6;     // dB
constexpr double kSmallColorGain = 3; // dB
constexpr uint32_t kMaxSmallSide = 256;

// Texels a side of the cells in which normals are compared: about as far as one bump hides errors of another.
constexpr uint32_t kSpreadSide = 8;

double decibels(double value)
{
    return std::pow(10.0, -value / 20);
}

double degrees(double value)
{
    return value * std::numbers::pi / 180;
}

template <typename T>
T pick(Effort quality, T draft, T normal, T high)
{
    return quality == Effort::draft ? draft : quality == Effort::normal ? normal : high;
}

/// Return the sum of squared angles between the normals of a cell and their mean, for small angles: twice
/// what the cosine lacks, which keeps large ones finite.
double sumSpread(std::span<const DecodedTexel> texels, uint32_t width, uint32_t begin, uint32_t end)
{
    Double3 sum{0, 0, 0};
    double count = 0;
    for (size_t row = 0; row < texels.size(); row += width)
        for (uint32_t x = begin; x < end; ++x)
        {
            sum = sum + directionFromXy(texels[row + x]);
            ++count;
        }
    return 2 * (count - length(sum));
}

} // namespace

double findNormalSpread(const PlainImage& image)
{
    const uint32_t width = image.record.width, height = image.record.height;
    const uint32_t rows = (height + kSpreadSide - 1) / kSpreadSide;
    std::vector<double> sums(rows);
    tbb::parallel_for(uint32_t{0}, rows,
                      [&](uint32_t row)
                      {
                          const uint32_t y = row * kSpreadSide;
                          const std::vector<DecodedTexel> texels =
                              decodeRows(image, 0, y, std::min(kSpreadSide, height - y));
                          for (uint32_t x = 0; x < width; x += kSpreadSide)
                              sums[row] += sumSpread(texels, width, x, std::min(x + kSpreadSide, width));
                      });
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    return std::sqrt(std::max(sum, 0.0) / static_cast<double>(uint64_t{width} * height));
}

Target findTarget(ImageRole role, Effort quality)
{
    switch (role)
    {
    case ImageRole::normal:
        return {degrees(pick(quality, 3.0, 1.5, 0.75)), kUnlimited};
    case ImageRole::data:
        return {decibels(pick(quality, 33.0, 36.0, 41.0)), kUnlimited};
    case ImageRole::light:
        return {pick(quality, 0.1, 0.05, 0.03), kUnlimited};
    default:
        return {decibels(pick(quality, 34.0, 39.0, 43.0)), decibels(pick(quality, 48.0, 53.0, 55.0))};
    }
}

Target findTarget(const PlainImage& image, Effort quality)
{
    Target target = findTarget(image.role, quality);
    const bool is_small = std::max(image.record.width, image.record.height) <= kMaxSmallSide;
    if (image.role == ImageRole::cutout)
        target.error *= decibels(kCutoutGain);
    else if (image.role == ImageRole::normal)
        target.error = std::clamp(findNormalSpread(image) / pick(quality, 4.0, 8.0, 16.0), target.error / 2,
                                  target.error);
    else if (isSrgb(image.record.format) && is_small)
        target.error *= decibels(kSmallColorGain);
    return target;
}

Target makeTarget(ImageRole role, Effort quality, double wanted)
{
    const Target usual = findTarget(role, quality);
    const double error = restoreImageError(role, wanted);
    return {error, usual.smooth * (error / usual.error)};
}

} // namespace hearth::texels
