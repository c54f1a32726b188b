// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/texel_error.h"

#include "formats/base/assert.h"
#include "formats/base/double3.h"
#include "formats/base/half.h"
#include "formats/codecs/vector16.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hearth::texels
{

using namespace formats;

namespace
{

constexpr double kRange = 65535;
constexpr uint32_t kMaxMeasuredMips = 4;
constexpr uint32_t kMinMeasuredSide = 64;

/// Return the angle between two directions; exact for small ones, where an arc cosine is not.
double angleBetween(const DecodedTexel& plain, const DecodedTexel& stored)
{
    const Double3 a = directionFromXy(plain), b = directionFromXy(stored);
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Return the channels of a texel with colours times alpha.
DecodedTexel weightByAlpha(const DecodedTexel& texel)
{
    const auto weigh = [&](uint16_t channel)
    { return static_cast<uint16_t>((uint32_t{channel} * texel[3] + 32767) / 65535); };
    return {weigh(texel[0]), weigh(texel[1]), weigh(texel[2]), texel[3]};
}

/// Eight numbers, of the channels of two texels.
using Words = uint32_t __attribute__((vector_size(32)));

/// Hand over the differences of texels, two at a time: their channels, without signs, with the number of the
/// first. A second one beyond the last has none.
/// codes  tells the four numbers of a texel whose differences count
template <typename Codes, typename Handle>
void subtractPairs(std::span<const DecodedTexel> plain, std::span<const DecodedTexel> stored,
                   const Codes& codes, const Handle& handle)
{
    using Pair = std::array<DecodedTexel, 2>;
    const auto subtract = [](const Pair& x, const Pair& y)
    {
        const auto a = std::bit_cast<Halves>(x), b = std::bit_cast<Halves>(y);
        return Halves(a > b ? a - b : b - a);
    };
    size_t i = 0;
    for (; i + 1 < plain.size(); i += 2)
        handle(i, subtract({codes(plain[i]), codes(plain[i + 1])}, {codes(stored[i]), codes(stored[i + 1])}));
    if (i < plain.size())
        handle(i, subtract({codes(plain[i])}, {codes(stored[i])}));
}

DecodedTexel keepCodes(const DecodedTexel& texel)
{
    return texel;
}

/// Write the larger of a and b into a.
void raise(Halves& a, Halves b)
{
    a = a > b ? a : b;
}

double stops(uint16_t half)
{
    return std::log2(1 + std::max(0.0, double{floatFromHalf(half)}));
}

} // namespace

Double3 directionFromXy(const DecodedTexel& texel)
{
    const double x = texel[0] / kRange * 2 - 1, y = texel[1] / kRange * 2 - 1;
    const Double3 direction{x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))};
    return direction * (1 / length(direction));
}

void ErrorSum::add(std::span<const DecodedTexel> plain, std::span<const DecodedTexel> stored)
{
    HEARTH_ASSERT(plain.size() == stored.size());
    count_ += plain.size();
    if (role_ == ImageRole::normal)
        for (size_t i = 0; i < plain.size(); ++i)
        {
            const double angle = angleBetween(plain[i], stored[i]);
            real_[0] += angle * angle;
        }
    else if (role_ == ImageRole::light)
        for (size_t i = 0; i < plain.size(); ++i)
            for (uint32_t c = 0; c < 3; ++c)
            {
                const double difference = stops(plain[i][c]) - stops(stored[i][c]);
                real_[c] += difference * difference;
            }
    else if (role_ == ImageRole::cutout)
        addCodes(plain, stored, weightByAlpha);
    else
        addCodes(plain, stored, keepCodes);
}

template <typename Codes>
void ErrorSum::addCodes(std::span<const DecodedTexel> plain, std::span<const DecodedTexel> stored,
                        const Codes& codes)
{
    // halves of the squares are summed in 32 bits
    constexpr size_t kMaxRun = 1u << 16;
    for (size_t begin = 0; begin < plain.size(); begin += kMaxRun)
    {
        const size_t count = std::min(kMaxRun, plain.size() - begin);
        Words low{}, high{};
        const auto addSquares = [&](size_t, Halves differences)
        {
            const Words wide = __builtin_convertvector(differences, Words);
            const Words squares = wide * wide;
            low += squares & 0xFFFF;
            high += squares >> 16;
        };
        subtractPairs(plain.subspan(begin, count), stored.subspan(begin, count), codes, addSquares);
        for (uint32_t c = 0; c < 4; ++c)
            if (has(channels_, c))
                whole_[c] += uint64_t{low[c]} + low[c + 4] + ((uint64_t{high[c]} + high[c + 4]) << 16);
    }
}

void ErrorSum::add(const ErrorSum& other)
{
    count_ += other.count_;
    for (uint32_t c = 0; c < 4; ++c)
    {
        whole_[c] += other.whole_[c];
        real_[c] += other.real_[c];
    }
}

std::array<double, 4> ErrorSum::meanSquares() const
{
    std::array<double, 4> means{};
    for (uint32_t c = 0; c < 4; ++c)
        means[c] =
            (static_cast<double>(whole_[c]) / (kRange * kRange) + real_[c]) / static_cast<double>(count_);
    return means;
}

double combineMips(ImageRole role, Channels channels, std::span<const ErrorSum> mips)
{
    std::vector<std::array<double, 4>> squares;
    for (const ErrorSum& mip : mips)
        if (mip.count() > 0)
            squares.push_back(mip.meanSquares());
    return combineMips(role, channels, squares);
}

double combineMips(ImageRole role, Channels channels, std::span<const std::array<double, 4>> mips)
{
    std::array<double, 4> means{};
    for (const std::array<double, 4>& mip : mips)
        for (uint32_t c = 0; c < 4; ++c)
            means[c] += mip[c] / static_cast<double>(mips.size());
    if (role == ImageRole::normal)
        return std::sqrt(means[0]);
    if (role == ImageRole::data)
        return std::sqrt(*std::max_element(means.begin(), means.end()));
    const auto counted = role == ImageRole::light ? kRgb : channels;
    return std::sqrt((means[0] + means[1] + means[2] + means[3]) / std::max(std::popcount(counted), 1));
}

double texelError(ImageRole role, Channels channels, const DecodedTexel& plain, const DecodedTexel& stored)
{
    if (role == ImageRole::normal)
        return angleBetween(plain, stored);
    if (role == ImageRole::light)
    {
        double error = 0;
        for (uint32_t c = 0; c < 3; ++c)
            error = std::max(error, std::abs(stops(plain[c]) - stops(stored[c])));
        return error;
    }
    uint16_t difference = 0;
    findCodeDifferences(role, channels, {&plain, 1}, {&stored, 1}, {&difference, 1});
    return difference / kRange;
}

void findCodeDifferences(ImageRole role, Channels channels, std::span<const DecodedTexel> plain,
                         std::span<const DecodedTexel> stored, std::span<uint16_t> differences)
{
    HEARTH_ASSERT(plain.size() == stored.size() && plain.size() == differences.size());
    Halves counted{};
    for (uint32_t lane = 0; lane < kHalves; ++lane)
        counted[lane] = has(channels, lane % 4) ? 0xFFFF : 0;
    const auto keepLargest = [&](size_t i, Halves pair)
    {
        Halves largest = pair & counted;
        raise(largest, __builtin_shufflevector(largest, largest, 1, 0, 3, 2, 5, 4, 7, 6));
        raise(largest, __builtin_shufflevector(largest, largest, 2, 3, 0, 1, 6, 7, 4, 5));
        differences[i] = largest[0];
        if (i + 1 < differences.size())
            differences[i + 1] = largest[4];
    };
    if (role == ImageRole::cutout)
        subtractPairs(plain, stored, weightByAlpha, keepLargest);
    else
        subtractPairs(plain, stored, keepCodes, keepLargest);
}

uint32_t countMeasuredMips(const ImageRecord& image)
{
    uint32_t count = 1;
    while (count < std::min(kMaxMeasuredMips, image.mip_count) &&
           std::min(mipExtent(image, count).width, mipExtent(image, count).height) >= kMinMeasuredSide)
        ++count;
    return count;
}

} // namespace hearth::texels
