// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/memory_shares.h"
#include "tests/runtime/pack/star_graph.h"

#include <gtest/gtest.h>
#include <random>

namespace hearth::test
{

namespace
{

using pack::MemoryShares;

TEST(MemoryShares, enoughForAllIsAllForBoth)
{
    const auto pages = makeStarGraph(10, 64, 20), textures = makeStarGraph(30, 100, 7);
    const uint64_t all = 10 + 64 * 20 + 30 + 100 * 7;
    const MemoryShares shares = divideMemory(all, pages, textures);
    EXPECT_EQ(shares.geometry, 10u + 64 * 20);
    EXPECT_EQ(shares.textures, 30u + 100 * 7);
    EXPECT_EQ(divideMemory(all + 500, pages, textures).textures, shares.textures) << "images need no more";
}

TEST(MemoryShares, tooLittleIsHalved)
{
    // beyond the 300 bytes that are always resident
    const MemoryShares shares = divideMemory(1300, makeStarGraph(100, 100, 30), makeStarGraph(200, 100, 10));
    EXPECT_EQ(shares.geometry, 100u + 500);
    EXPECT_EQ(shares.textures, 200u + 500);
}

TEST(MemoryShares, whatOneSideCannotUseIsForTheOther)
{
    const MemoryShares few_pages =
        divideMemory(100'000, makeStarGraph(0, 1000, 9), makeStarGraph(0, 1000, 10'000));
    EXPECT_EQ(few_pages.geometry, 9'000u);
    EXPECT_EQ(few_pages.textures, 91'000u);
    const MemoryShares few_textures =
        divideMemory(100'000, makeStarGraph(0, 1000, 10'000), makeStarGraph(0, 1000, 9));
    EXPECT_EQ(few_textures.textures, 9'000u);
    EXPECT_EQ(few_textures.geometry, 91'000u);
}

TEST(MemoryShares, neverExceedTheBudget)
{
    std::mt19937 random(1);
    const auto draw = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
    for (int i = 0; i < 1000; ++i)
    {
        const auto pages = makeStarGraph(draw(100), 1 + draw(100), draw(20));
        const auto textures = makeStarGraph(draw(100), 1 + draw(100), draw(20));
        const uint64_t budget = 200 + draw(3000);
        const MemoryShares shares = divideMemory(budget, pages, textures);
        EXPECT_EQ(shares.geometry + shares.textures, budget);
        EXPECT_GE(shares.geometry, pages.pinnedBytes());
        EXPECT_GE(shares.textures, textures.pinnedBytes());
    }
}

} // namespace

} // namespace hearth::test
