// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/bc/bc7_partitions.h"

#include "formats/texels/bptc_tables.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace hearth::texels
{

namespace
{

/// Sums over the texels of a subset: count, channels, products of channels; 0 behind them.
template <size_t kChannels>
using Moments = std::array<int32_t, kChannels == 3 ? 12 : 16>;

/// [subsets - 2][partition][subset - 1]: texels of a subset, a bit each.
constexpr auto kSubsetTexels = []
{
    std::array<std::array<std::array<uint16_t, 2>, 64>, 2> table{};
    for (uint32_t subsets = 2; subsets < 4; ++subsets)
        for (uint32_t p = 0; p < 64; ++p)
            for (uint32_t t = 0; t < 16; ++t)
                if (const uint32_t subset = formats::bptcSubset(subsets, p, t); subset > 0)
                {
                    uint16_t& texels = table[subsets - 2][p][subset - 1];
                    texels = static_cast<uint16_t>(texels | 1u << t);
                }
    return table;
}();

template <size_t kChannels>
Moments<kChannels> texelMoments(const std::array<std::array<int16_t, 16>, 4>& values, size_t texel)
{
    Moments<kChannels> moments{1};
    size_t next = 1;
    for (size_t i = 0; i < kChannels; ++i)
        moments[next++] = values[i][texel];
    for (size_t i = 0; i < kChannels; ++i)
        for (size_t j = 0; j <= i; ++j)
            moments[next++] = int32_t{values[i][texel]} * int32_t{values[j][texel]};
    return moments;
}

/// Return the sum of the squared distances of a subset's texels to their best line, approximately.
template <size_t kChannels>
int32_t distanceToLine(const Moments<kChannels>& moments)
{
    const int32_t count = moments[0];
    if (count < 2)
        return 0;
    std::array<std::array<int32_t, kChannels>, kChannels> matrix; // count times the covariance: up to 24 bits
    int32_t trace = 0;
    size_t next = 1 + kChannels;
    size_t largest = 0;
    for (size_t i = 0; i < kChannels; ++i)
    {
        for (size_t j = 0; j <= i; ++j)
            matrix[i][j] = matrix[j][i] = moments[next++] * count - moments[1 + i] * moments[1 + j];
        trace += matrix[i][i];
        largest = matrix[i][i] > matrix[largest][largest] ? i : largest;
    }
    // the row with the largest diagonal, times the matrix, is close to the line's direction. Fewer bits keep
    // all products within 32
    const int shift = std::max(0, static_cast<int>(std::bit_width(static_cast<uint32_t>(trace))) - 14);
    std::array<int32_t, kChannels> line{};
    for (size_t i = 0; i < kChannels; ++i)
        for (size_t j = 0; j < kChannels; ++j)
            line[i] += (matrix[i][j] >> shift) * (matrix[largest][j] >> shift);
    int32_t widest = 0;
    for (const int32_t component : line)
        widest = std::max(widest, std::abs(component));
    const int line_shift = std::max(0, static_cast<int>(std::bit_width(static_cast<uint32_t>(widest))) - 14);
    int64_t along = 0, length = 0;
    for (size_t i = 0; i < kChannels; ++i)
        line[i] >>= line_shift;
    for (size_t i = 0; i < kChannels; ++i)
    {
        int64_t product = 0;
        for (size_t j = 0; j < kChannels; ++j)
            product += int64_t{matrix[i][j]} * line[j];
        along += product * line[i];
        length += line[i] * line[i];
    }
    if (length == 0)
        return 0;
    // the reciprocal of the count, since a division takes long
    constexpr std::array<int64_t, 17> kReciprocals = []
    {
        std::array<int64_t, 17> table{};
        for (size_t n = 1; n < table.size(); ++n)
            table[n] = static_cast<int64_t>(65536 / n);
        return table;
    }();
    // indices of 3 bits leave about 1/49 of the variance along the line: among partitions into lines, the
    // shortest lines are best
    const int64_t variance = along / length;
    return static_cast<int32_t>(
        (trace - variance + (variance >> 6)) * kReciprocals[static_cast<size_t>(count)] >> 16);
}

template <size_t kChannels>
void rank(const std::array<std::array<int16_t, 16>, 4>& values, uint32_t subsets, uint32_t candidates,
          std::span<uint8_t> partitions)
{
    std::array<Moments<kChannels>, 16> moments;
    Moments<kChannels> all{};
    for (size_t t = 0; t < 16; ++t)
    {
        moments[t] = texelMoments<kChannels>(values, t);
        for (size_t i = 0; i < all.size(); ++i)
            all[i] += moments[t][i];
    }
    std::array<int32_t, 64> distances;
    size_t kept = 0;
    for (uint32_t p = 0; p < candidates; ++p)
    {
        std::array<Moments<kChannels>, 3> sums{all, {}, {}};
        for (uint32_t subset = 1; subset < subsets; ++subset)
        {
            for (uint32_t texels = kSubsetTexels[subsets - 2][p][subset - 1]; texels != 0;
                 texels &= texels - 1)
            {
                const auto texel = static_cast<size_t>(std::countr_zero(texels));
                for (size_t i = 0; i < all.size(); ++i)
                    sums[subset][i] += moments[texel][i];
            }
            for (size_t i = 0; i < all.size(); ++i)
                sums[0][i] -= sums[subset][i];
        }
        int32_t distance = 0;
        for (uint32_t subset = 0; subset < subsets; ++subset)
            distance += distanceToLine<kChannels>(sums[subset]);
        if (kept == partitions.size() && distance >= distances[kept - 1])
            continue;
        size_t at = kept < partitions.size() ? kept++ : kept - 1;
        for (; at > 0 && distances[at - 1] > distance; --at)
        {
            distances[at] = distances[at - 1];
            partitions[at] = partitions[at - 1];
        }
        distances[at] = distance;
        partitions[at] = static_cast<uint8_t>(p);
    }
}

} // namespace

void rankPartitions(const std::array<std::array<int16_t, 16>, 4>& values, size_t channels, uint32_t subsets,
                    uint32_t candidates, std::span<uint8_t> partitions)
{
    if (channels == 3)
        rank<3>(values, subsets, candidates, partitions);
    else
        rank<4>(values, subsets, candidates, partitions);
}

} // namespace hearth::texels
