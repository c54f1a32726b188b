// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/block_sample.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hearth::texels
{

BlockSampler::BlockSampler(std::span<const float> expected)
{
    HEARTH_ASSERT(expected.size() <= std::numeric_limits<uint32_t>::max());
    // bits of positive floats have their order: whole numbers sort faster than what they point at
    std::vector<uint64_t> keys;
    keys.reserve(expected.size());
    for (size_t block = 0; block < expected.size(); ++block)
        if (expected[block] > 0)
            keys.push_back(uint64_t{~std::bit_cast<uint32_t>(expected[block])} << 32 | block);
    std::ranges::sort(keys);
    blocks_.reserve(keys.size());
    expected_.reserve(keys.size());
    for (const uint64_t key : keys)
    {
        blocks_.push_back(static_cast<uint32_t>(key));
        expected_.push_back(expected[blocks_.back()]);
    }
}

std::vector<SampledBlock> BlockSampler::sample(size_t wanted, size_t before) const
{
    double rest = 0;
    for (const float value : expected_)
        rest += double{value};
    std::vector<SampledBlock> sample;
    // a block whose share is a place or more is certain, and leaves its places to the others
    size_t next = 0;
    for (; next < blocks_.size() && sample.size() < wanted; ++next)
    {
        const double value = expected_[next];
        if (blocks_.size() > wanted && value * static_cast<double>(wanted - sample.size()) < rest)
            break;
        sample.push_back({blocks_[next], 1});
        rest -= value;
    }

    // Blocks of like expectation lie beside each other, so each step stands for blocks of its kind. The place
    // wanders through the steps: a regular one would meet the same place of a pattern again and again.
    constexpr double kGolden = 0.6180339887498949;
    const size_t steps = next < blocks_.size() ? wanted - sample.size() : 0;
    const double step = rest / static_cast<double>(steps);
    double end = 0;
    for (size_t i = 0; i < steps; ++i)
    {
        const double n = static_cast<double>(before + i + 1) * kGolden;
        const double place = (static_cast<double>(i) + n - std::floor(n)) * step;
        while (next + 1 < blocks_.size() && end + double{expected_[next]} <= place)
            end += double{expected_[next++]};
        const double weight = step / double{expected_[next]};
        if (!sample.empty() && sample.back().block == blocks_[next])
            sample.back().weight += weight;
        else
            sample.push_back({blocks_[next], weight});
    }
    std::ranges::sort(sample, {}, &SampledBlock::block);
    return sample;
}

} // namespace hearth::texels
