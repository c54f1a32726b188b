// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/block_sample.h"

#include <algorithm>
#include <cmath>

namespace hearth::texels
{

namespace
{

/// Return the numbers of all blocks of which something is expected, the most first.
std::vector<uint64_t> sortBlocks(std::span<const float> expected)
{
    std::vector<uint64_t> order;
    for (uint64_t block = 0; block < expected.size(); ++block)
        if (expected[block] > 0)
            order.push_back(block);
    std::ranges::sort(order, [&](uint64_t a, uint64_t b)
                      { return expected[a] != expected[b] ? expected[a] > expected[b] : a < b; });
    return order;
}

} // namespace

std::vector<SampledBlock> sampleBlocks(std::span<const float> expected, size_t wanted, size_t before)
{
    const std::vector<uint64_t> order = sortBlocks(expected);
    double rest = 0;
    for (const uint64_t block : order)
        rest += double{expected[block]};
    std::vector<SampledBlock> sample;
    // a block whose share is a place or more is certain, and leaves its places to the others
    size_t next = 0;
    for (; next < order.size() && sample.size() < wanted; ++next)
    {
        const double value = expected[order[next]];
        if (order.size() > wanted && value * static_cast<double>(wanted - sample.size()) < rest)
            break;
        sample.push_back({order[next], 1});
        rest -= value;
    }

    // Blocks of like expectation lie beside each other, so each step stands for blocks of its kind. The place
    // wanders through the steps: a regular one would meet the same place of a pattern again and again.
    constexpr double kGolden = 0.6180339887498949;
    const size_t steps = next < order.size() ? wanted - sample.size() : 0;
    const double step = rest / static_cast<double>(steps);
    double end = 0;
    for (size_t i = 0; i < steps; ++i)
    {
        const double n = static_cast<double>(before + i + 1) * kGolden;
        const double place = (static_cast<double>(i) + n - std::floor(n)) * step;
        while (next + 1 < order.size() && end + double{expected[order[next]]} <= place)
            end += double{expected[order[next++]]};
        const double weight = step / double{expected[order[next]]};
        if (!sample.empty() && sample.back().block == order[next])
            sample.back().weight += weight;
        else
            sample.push_back({order[next], weight});
    }
    std::ranges::sort(sample, {}, &SampledBlock::block);
    return sample;
}

} // namespace hearth::texels
