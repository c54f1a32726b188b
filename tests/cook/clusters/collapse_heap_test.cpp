// Compares the heap of edge collapses with a sorted set.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/collapse_heap.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace
{

using namespace hearth::clusters;

TEST(CollapseHeap, givesTheCheapestFirstAsASortedSetDoes)
{
    std::mt19937 random(7);
    CollapseHeap heap;
    std::set<std::tuple<float, uint32_t, uint32_t>> expected; // cost, position, version
    for (uint32_t i = 0; i < 20000; ++i)
    {
        // the heap grows and shrinks to nothing several times; there are few distinct costs, so position_id
        // breaks ties
        const bool grows = i / 2000 % 2 == 0;
        if (expected.empty() || random() % 4 != (grows ? 0u : 1u) * (random() % 4))
        {
            const auto cost = static_cast<float>(random() % 16) * 0.125f;
            const uint32_t position = i * 0x9E3779B1u;
            heap.push({cost, PositionId{position}, PositionId{position ^ 1}, i});
            expected.insert({cost, position, i});
        }
        if (!expected.empty() && (!grows || random() % 2 == 0))
        {
            const auto [cost, position, version] = *expected.begin();
            expected.erase(expected.begin());
            ASSERT_EQ(heap.front().cost(), cost);
            const HeapEntry entry = heap.pop();
            ASSERT_EQ(entry.cost(), cost);
            ASSERT_EQ(entry.position(), PositionId{position});
            ASSERT_EQ(entry.target(), PositionId{position ^ 1});
            ASSERT_EQ(entry.version(), version);
        }
        ASSERT_EQ(heap.empty(), expected.empty());
    }
}

TEST(CollapseHeap, knowsOneZeroAndOrdersAllMagnitudes)
{
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kMinFloat = std::numeric_limits<float>::denorm_min();
    CollapseHeap heap;
    const auto push = [&](float cost, uint32_t position) {
        heap.push({cost, PositionId{position}, PositionId{0}, 0});
    };
    push(kInfinity, 0);
    push(1e30f, 1);
    push(kMinFloat, 2);
    push(-0.0f, 4);
    push(0.0f, 3);
    for (const uint32_t position : {3u, 4u, 2u, 1u, 0u})
        EXPECT_EQ(heap.pop().position(), PositionId{position});
    EXPECT_TRUE(heap.empty());
}

} // namespace
