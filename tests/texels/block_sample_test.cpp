// Estimates from sampled blocks beside full counts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/block_sample.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace hearth::texels
{

namespace
{

constexpr size_t kBlocks = 4096, kWanted = 128;

/// Errors of blocks, and what is expected of them.
struct Blocks
{
    std::vector<double> errors;
    std::vector<float> expected;
};

/// Make blocks of which one in a hundred has nearly all of the error. The errors of equal expectations differ
/// by up to a factor of 4.
Blocks concentrateErrors(uint32_t seed)
{
    std::mt19937 random(seed);
    const auto draw = [&] { return static_cast<double>(random() >> 8) / (1 << 24); };
    Blocks blocks;
    for (size_t i = 0; i < kBlocks; ++i)
    {
        const double expected = (draw() < 0.01 ? 1000 : 1) * (0.5 + draw());
        blocks.expected.push_back(static_cast<float>(expected));
        blocks.errors.push_back(expected * std::exp2(2 * draw()));
    }
    return blocks;
}

/// Estimate the sum of the errors, as a part of it.
double estimateSum(std::span<const SampledBlock> sample, std::span<const double> errors)
{
    double sum = 0;
    for (const SampledBlock& one : sample)
        sum += one.weight * errors[one.block];
    return sum / std::accumulate(errors.begin(), errors.end(), 0.0);
}

/// Mean of estimates as parts of what was to be estimated, and the root of the mean square of their errors.
struct Quality
{
    double mean = 0, deviation = 0;
};

template <typename Expected>
Quality judgeEstimates(size_t count, const Expected& expected)
{
    Quality quality;
    for (size_t trial = 0; trial < count; ++trial)
    {
        const Blocks blocks = concentrateErrors(static_cast<uint32_t>(trial));
        const std::vector<SampledBlock> sample = BlockSampler(expected(blocks)).sample(kWanted);
        EXPECT_LE(sample.size(), kWanted);
        const double estimate = estimateSum(sample, blocks.errors);
        quality.mean += estimate / static_cast<double>(count);
        quality.deviation += (estimate - 1) * (estimate - 1) / static_cast<double>(count);
    }
    quality.deviation = std::sqrt(quality.deviation);
    return quality;
}

TEST(BlockSample, estimatesAreUnbiasedWhereFewBlocksHaveTheError)
{
    const size_t count = test::trials(400);
    const Quality weighted = judgeEstimates(count, [](const Blocks& blocks) { return blocks.expected; });
    // .05 a trial: a mean of 400 is off by .0025
    EXPECT_NEAR(weighted.mean, 1, 0.2 / std::sqrt(static_cast<double>(count)));
    EXPECT_LT(weighted.deviation, 0.06);
    // as many blocks that are chosen alike see one or two of those with the error
    const Quality even =
        judgeEstimates(count, [](const Blocks&) { return std::vector<float>(kBlocks, 1.0f); });
    EXPECT_GT(even.deviation, 0.5);
}

TEST(BlockSample, whatIsProportionalToExpectationsIsExact)
{
    const Blocks blocks = concentrateErrors(3);
    const std::vector<SampledBlock> sample = BlockSampler(blocks.expected).sample(kWanted);
    const std::vector<double> expected(blocks.expected.begin(), blocks.expected.end());
    EXPECT_NEAR(estimateSum(sample, expected), 1, 1e-9);
    for (size_t i = 0; i < sample.size(); ++i)
    {
        EXPECT_GE(sample[i].weight, 1);
        EXPECT_TRUE(i == 0 || sample[i - 1].block < sample[i].block);
    }
}

TEST(BlockSample, allBlocksStandForThemselvesIfTheyAreFew)
{
    const std::vector<float> expected{0.5f, 2, 0.25f};
    EXPECT_EQ(BlockSampler(expected).sample(3), (std::vector<SampledBlock>{{0, 1}, {1, 1}, {2, 1}}));
    EXPECT_EQ(BlockSampler(expected).sample(8).size(), 3u);
    EXPECT_TRUE(BlockSampler({}).sample(8).empty());
    EXPECT_EQ(BlockSampler(std::vector<float>{0, 3, 0}).sample(2), (std::vector<SampledBlock>{{1, 1}}));
}

} // namespace

} // namespace hearth::texels
