// Tests the exchange of memory between the pool of pages and textures: whatever is late or fails, both
// never exceed the budget together, and moves end.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/memory_exchange.h"
#include "tests/runtime/pack/star_graph.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>
#include <random>

namespace hearth::test
{

namespace
{

using pack::ExchangeLayout;
using pack::MemoryExchange;

uint64_t poolBytes(const ExchangeLayout& layout, uint64_t moving_slots)
{
    return layout.pinned_page_bytes + (layout.fixed_slots + moving_slots) * layout.slot_bytes;
}

TEST(PlanExchange, isForBudgetsThatDoNotHoldEverything)
{
    const auto pages = makeStarGraph(1000, 100, 50), textures = makeStarGraph(2000, 500, 10);
    const pack::PoolParts parts{.count = 3, .max_slots = 1000};
    EXPECT_FALSE(pack::planExchange(13'000, pages, 100, textures, parts)) << "it holds everything";
    EXPECT_TRUE(pack::planExchange(12'999, pages, 100, textures, parts));
    EXPECT_FALSE(pack::planExchange(12'999, pages, 100, textures, {})) << "no part can be made";
    EXPECT_FALSE(pack::planExchange(3'000, pages, 100, textures, parts)) << "nothing moves";
    EXPECT_FALSE(pack::planExchange(9'000, makeStarGraph(1000, 100, 0), 100, textures, parts));
    EXPECT_FALSE(pack::planExchange(9'000, pages, 100, makeStarGraph(2000, 500, 0), parts));
}

TEST(PlanExchange, leavesEachSideAnEighthOrAllThatItCanUse)
{
    std::mt19937 random(1);
    const auto draw = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
    size_t planned = 0;
    for (int trial = 0; trial < 2000; ++trial)
    {
        const uint32_t slot = 64 * (1 + draw(8)), page_count = draw(300), mip_count = draw(40);
        const auto pages = makeStarGraph(draw(5000), slot, page_count);
        const auto textures = makeStarGraph(draw(5000), 1 + draw(4000), mip_count);
        const uint64_t pinned = pages.pinnedBytes() + textures.pinnedBytes();
        const uint64_t budget = pinned + draw(200'000);
        const pack::PoolParts parts{.count = 1 + draw(3), .max_slots = 20 + draw(200)};
        const auto layout = pack::planExchange(budget, pages, slot, textures, parts);
        if (!layout)
            continue;
        ++planned;
        const uint64_t moving = uint64_t{layout->granules} * layout->granule_slots;
        EXPECT_LE(layout->fixed_slots + moving, page_count);
        EXPECT_LE(moving, uint64_t{layout->parts} * layout->part_slots);
        EXPECT_LE(layout->part_slots, parts.max_slots);
        EXPECT_LE(layout->granules, 12u);
        EXPECT_LE(layout->start_granules, layout->granules);
        const uint64_t rest = budget - pinned;
        EXPECT_GE(budget - poolBytes(*layout, moving) - textures.pinnedBytes(),
                  std::min<uint64_t>(rest / 8, mip_count == 0 ? 0 : textures.sizeBytes(1) * mip_count));
        EXPECT_GE(uint64_t{layout->fixed_slots + 1} * slot,
                  std::min<uint64_t>(rest / 8, uint64_t{page_count} * slot));
    }
    EXPECT_GT(planned, 300u);
}

/// Memory of a device with an exchange. Slices take their time until they are free, textures until they
/// have shrunk, and some slices cannot be made.
class FakeMemory
{
public:
    FakeMemory(const ExchangeLayout& layout, std::mt19937& random)
        : exchange(layout), random_(random), parts_(layout.parts), textures_(exchange.textureBytes())
    {
        for (uint32_t part = 0; part < layout.parts; ++part)
            parts_[part] = exchange.slots(part);
    }

    void frame(float geometry_scale, float texture_scale, uint32_t failures_of_64)
    {
        for (uint32_t part = 0; part < parts_.size(); ++part)
            if (exchange.isClosing(part) && random_() % 4 == 0)
            {
                parts_[part] = 0;
                exchange.closed(part);
            }
        while (const auto opening = exchange.nextPart(textures_))
        {
            EXPECT_EQ(parts_[opening->part], 0u);
            EXPECT_LE(opening->slots, exchange.layout().part_slots);
            if (random_() % 64 < failures_of_64)
            {
                exchange.failed();
                break;
            }
            parts_[opening->part] = opening->slots;
            exchange.opened(*opening);
        }
        // textures fill what they may have, and leave what they may not have late
        if (textures_ <= exchange.textureBytes())
            textures_ += random_() % (exchange.textureBytes() - textures_ + 1);
        else if (random_() % 3 == 0)
            textures_ -= random_() % (textures_ - exchange.textureBytes() + 1);
        if (textures_ > exchange.textureBytes() && random_() % 16 == 0)
            textures_ = exchange.textureBytes();
        check();
        moves += exchange.update({geometry_scale, 100}, {texture_scale, 100}) ? 1u : 0u;
        check();
    }

    void check() const
    {
        uint64_t slots = 0;
        for (uint32_t part = 0; part < parts_.size(); ++part)
        {
            EXPECT_EQ(exchange.slots(part), parts_[part]);
            slots += parts_[part];
        }
        const ExchangeLayout& layout = exchange.layout();
        ASSERT_LE(poolBytes(layout, slots) + textures_, layout.budget_bytes);
        ASSERT_GE(exchange.textureBytes(), layout.pinned_texture_bytes);
        ASSERT_LE(exchange.demandSlots(), layout.fixed_slots + layout.granules * layout.granule_slots);
        if (exchange.isMoving())
            return;
        EXPECT_EQ(exchange.demandSlots(), layout.fixed_slots + slots);
        EXPECT_EQ(exchange.textureBytes(), layout.budget_bytes - poolBytes(layout, slots));
    }

    MemoryExchange exchange;
    size_t moves = 0;

private:
    std::mt19937& random_;
    std::vector<uint32_t> parts_; ///< slots that have memory
    uint64_t textures_;           ///< bytes in use
};

ExchangeLayout makeLayout(std::mt19937& random)
{
    const auto draw = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
    ExchangeLayout layout;
    layout.slot_bytes = 64 * (1 + draw(4));
    layout.fixed_slots = draw(20);
    layout.granule_slots = 1 + draw(5);
    layout.granules = 1 + draw(12);
    layout.start_granules = draw(layout.granules + 1);
    layout.parts = 1 + draw(3);
    const uint32_t moving = layout.granules * layout.granule_slots;
    const uint32_t min_slots = (moving + layout.parts - 1) / layout.parts;
    layout.part_slots = min_slots + draw(moving - min_slots + 1);
    layout.pinned_page_bytes = draw(1000);
    layout.pinned_texture_bytes = draw(1000);
    layout.budget_bytes = poolBytes(layout, moving) + layout.pinned_texture_bytes + draw(5000);
    return layout;
}

TEST(MemoryExchange, neverExceedsTheBudgetWhateverIsLateOrFails)
{
    std::mt19937 random(4);
    const auto scale = [&] { return random() % 3 == 0 ? 1.0f : 1 + static_cast<float>(random() % 64) / 16; };
    size_t moves = 0;
    for (size_t trial = 0; trial < trials(300) && !testing::Test::HasFailure(); ++trial)
    {
        SCOPED_TRACE(trial);
        FakeMemory memory(makeLayout(random), random);
        const uint32_t failures = random() % 2 == 0 ? 0 : 8;
        float geometry = 1, textures = 1;
        for (int frame = 0; frame < 2000; ++frame)
        {
            if (random() % 100 == 0)
            {
                geometry = scale();
                textures = scale();
            }
            memory.frame(geometry, textures, failures);
        }
        moves += memory.moves;
        for (int frame = 0; frame < 400; ++frame)
            memory.frame(1, 1, failures);
        EXPECT_TRUE(memory.exchange.atRest());
    }
    EXPECT_GT(moves, trials(1000));
}

TEST(MemoryExchange, closesNoMoreThanItMust)
{
    // two halves of a pool: a share that shrinks by a little leaves one of them
    ExchangeLayout layout{.budget_bytes = 100'000,
                          .pinned_page_bytes = 0,
                          .pinned_texture_bytes = 0,
                          .slot_bytes = 100,
                          .fixed_slots = 100,
                          .granule_slots = 50,
                          .granules = 12,
                          .start_granules = 12,
                          .parts = 3,
                          .part_slots = 300};
    MemoryExchange exchange(layout);
    EXPECT_EQ(exchange.slots(0), 300u);
    EXPECT_EQ(exchange.slots(1), 300u);
    const auto drive = [&](float geometry, float textures)
    {
        int rounds = 0;
        while (!exchange.update({geometry, 100}, {textures, 100}) && ++rounds < 100)
            continue;
        ASSERT_LT(rounds, 100);
    };
    drive(1, 1.3f);
    ASSERT_TRUE(exchange.isMoving());
    EXPECT_TRUE(exchange.isClosing(0) != exchange.isClosing(1)) << "one is enough";
    const uint32_t closing = exchange.isClosing(0) ? 0 : 1;
    EXPECT_FALSE(exchange.nextPart(0)) << "its memory is still there";
    exchange.closed(closing);
    const auto opening = exchange.nextPart(0);
    ASSERT_TRUE(opening);
    exchange.opened(*opening);
    EXPECT_FALSE(exchange.nextPart(0));
    EXPECT_FALSE(exchange.isMoving());
    const uint32_t before = exchange.demandSlots();
    EXPECT_EQ(before, layout.fixed_slots + 300 + opening->slots);
    EXPECT_LT(before, 700u);
    // geometry grows again: the part without memory takes it, and nothing is closed
    drive(3, 1);
    for (uint32_t part = 0; part < 3; ++part)
        EXPECT_FALSE(exchange.isClosing(part));
    EXPECT_EQ(exchange.demandSlots(), before) << "until the part is there";
    EXPECT_FALSE(exchange.nextPart(100'000 - before * 100)) << "textures still have their share";
    EXPECT_TRUE(exchange.nextPart(exchange.textureBytes()));
}

} // namespace

} // namespace hearth::test
