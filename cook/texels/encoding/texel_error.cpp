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

uint16_t difference(uint16_t a, uint16_t b)
{
    return static_cast<uint16_t>(std::max(a, b) - std::min(a, b));
}

/// Eight numbers, of the channels of two texels.
using Words = uint32_t __attribute__((vector_size(32)));

/// Return the differences without their signs.
Halves subtract(Halves a, Halves b)
{
    return a > b ? a - b : b - a;
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
        addCodes(plain, stored, [](const DecodedTexel& texel) { return texel; });
}

template <typename Codes>
void ErrorSum::addCodes(std::span<const DecodedTexel> plain, std::span<const DecodedTexel> stored,
                        const Codes& codes)
{
    // Halves of the squares are summed in 32 bits, those of all channels of two texels at a time.
    constexpr size_t kMaxRun = 1u << 16;
    using Pair = std::array<DecodedTexel, 2>;
    for (size_t begin = 0; begin < plain.size(); begin += kMaxRun)
    {
        const size_t end = std::min(begin + kMaxRun, plain.size());
        Words low{}, high{};
        const auto addPair = [&](const Pair& a, const Pair& b)
        {
            const Halves differences = subtract(std::bit_cast<Halves>(a), std::bit_cast<Halves>(b));
            const Words wide = __builtin_convertvector(differences, Words);
            const Words squares = wide * wide;
            low += squares & 0xFFFF;
            high += squares >> 16;
        };
        size_t i = begin;
        for (; i + 1 < end; i += 2)
            addPair(Pair{codes(plain[i]), codes(plain[i + 1])}, Pair{codes(stored[i]), codes(stored[i + 1])});
        if (i < end)
            addPair(Pair{codes(plain[i])}, Pair{codes(stored[i])});
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
    return codeDifference(role, channels, plain, stored) / kRange;
}

uint32_t codeDifference(ImageRole role, Channels channels, const DecodedTexel& plain,
                        const DecodedTexel& stored)
{
    const bool is_cutout = role == ImageRole::cutout;
    const DecodedTexel a = is_cutout ? weightByAlpha(plain) : plain;
    const DecodedTexel b = is_cutout ? weightByAlpha(stored) : stored;
    // a mask in place of a branch lets processors take four channels at a time
    std::array<uint16_t, 4> differences;
    for (uint32_t c = 0; c < 4; ++c)
        differences[c] = static_cast<uint16_t>(difference(a[c], b[c]) & (has(channels, c) ? 0xFFFF : 0));
    return std::max(std::max(differences[0], differences[1]), std::max(differences[2], differences[3]));
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
