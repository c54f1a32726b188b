// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/partitions.h"

#include <algorithm>

namespace hearth::texels
{

namespace
{

using Points = std::array<Rgb, 16>;

/// Return the points of colours, or of their differences from their own gray.
Points makePoints(const Block8& block, const ColorWeights& weights, bool has_gray)
{
    Points points;
    const int32_t weight_sum = weights[0] + weights[1] + weights[2];
    for (size_t t = 0; t < 16; ++t)
    {
        int32_t gray = 0;
        for (size_t c = 0; c < 3; ++c)
            gray += weights[c] * block[t][c];
        for (size_t c = 0; c < 3; ++c)
            points[t][c] = 4 * block[t][c] - (has_gray ? 0 : 4 * gray / weight_sum);
    }
    return points;
}

int32_t distance2(const Rgb& a, const Rgb& b, const ColorWeights& weights)
{
    int32_t sum = 0;
    for (size_t c = 0; c < 3; ++c)
        sum += weights[c] * (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

size_t findFarthest(const Points& points, const Rgb& from, const ColorWeights& weights)
{
    size_t farthest = 0;
    int32_t greatest = -1;
    for (size_t t = 0; t < 16; ++t)
        if (const int32_t distance = distance2(points[t], from, weights); distance > greatest)
        {
            greatest = distance;
            farthest = t;
        }
    return farthest;
}

/// Return the mean of the points of a mask that is not 0.
Rgb findMean(const Points& points, TexelMask mask)
{
    Rgb sum{};
    int32_t count = 0;
    for (size_t t = 0; t < 16; ++t)
        if ((mask >> t & 1) != 0)
        {
            ++count;
            for (size_t c = 0; c < 3; ++c)
                sum[c] += points[t][c];
        }
    return {sum[0] / count, sum[1] / count, sum[2] / count};
}

/// Return the points that are nearer to the first of two.
TexelMask findNearer(const Points& points, const std::array<Rgb, 2>& centres, const ColorWeights& weights)
{
    TexelMask mask = 0;
    for (size_t t = 0; t < 16; ++t)
        if (distance2(points[t], centres[0], weights) <= distance2(points[t], centres[1], weights))
            mask |= 1u << t;
    return mask;
}

/// Two points far from each other: the farthest from the mean, and the farthest from that one.
std::array<Rgb, 2> findExtremes(const Points& points, const ColorWeights& weights)
{
    const size_t first = findFarthest(points, findMean(points, kAllTexels), weights);
    return {points[first], points[findFarthest(points, points[first], weights)]};
}

/// Return a division by two means; 0 if all points are equal.
TexelMask findTwoMeans(const Points& points, std::array<Rgb, 2> centres, const ColorWeights& weights)
{
    TexelMask mask = 0;
    for (int round = 0; round < 4; ++round)
    {
        const TexelMask next = findNearer(points, centres, weights);
        if (next == mask || next == 0 || next == kAllTexels)
            break;
        mask = next;
        centres = {findMean(points, mask), findMean(points, kAllTexels & ~mask)};
    }
    return mask;
}

void addPartition(TexelMask mask, PartitionList& list)
{
    if (mask == 0 || mask == kAllTexels)
        return;
    for (const TexelMask known : list)
        if (known == mask || known == (kAllTexels & ~mask))
            return;
    list.masks[list.count++] = mask;
}

/// Add the divisions between neighbours in the direction of two extremes.
void addSplits(const Points& points, const std::array<Rgb, 2>& extremes, const ColorWeights& weights,
               PartitionList& list)
{
    std::array<std::pair<int32_t, size_t>, 16> order; // place along the direction, texel
    for (size_t t = 0; t < 16; ++t)
        order[t] = {distance2(points[t], extremes[0], weights) - distance2(points[t], extremes[1], weights),
                    t};
    std::sort(order.begin(), order.end());
    TexelMask mask = 0;
    for (size_t t = 0; t + 1 < 16; ++t)
    {
        mask |= 1u << order[t].second;
        if (order[t].first != order[t + 1].first)
            addPartition(mask, list);
    }
}

} // namespace

PartitionList listPartitions(const Block8& block, const ColorWeights& weights, Effort effort)
{
    PartitionList list;
    for (const bool has_gray : {true, false})
    {
        const Points points = makePoints(block, weights, has_gray);
        const std::array<Rgb, 2> extremes = findExtremes(points, weights);
        addPartition(findTwoMeans(points, extremes, weights), list);
        if (effort == Effort::high)
            addSplits(points, extremes, weights, list);
    }
    return list;
}

} // namespace hearth::texels
