// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/receivers/receiver_light.h"
#include "tests/cook/receivers/random_receivers.h"

#include <gtest/gtest.h>

#include <bit>

namespace
{

using namespace hearth;
using pack::ReceiverLight;
using pack::ReceiverSchedule;
using test::RandomReceivers;

constexpr uint32_t kAllGroups = 15;

/// Decode a texel of E5B9G9R9 by the formula of Vulkan, in double.
Double3 decodeTexel(uint32_t word)
{
    const double step = std::pow(2.0, static_cast<double>(word >> 27) - 24);
    return Double3{static_cast<double>(word % 512), static_cast<double>(word / 512 % 512),
                   static_cast<double>(word / 262144 % 512)} *
           step;
}

/// Return the irradiance that the lamps give a texel, in double.
Double3 sumLamps(std::span<const Float3> light, std::span<const Float3> weights)
{
    Double3 sum{};
    for (size_t lamp = 0; lamp < light.size(); ++lamp)
        sum = sum + Double3{double{light[lamp].x} * double{weights[lamp].x},
                            double{light[lamp].y} * double{weights[lamp].y},
                            double{light[lamp].z} * double{weights[lamp].z}};
    return sum;
}

std::vector<Float3> randomWeights(size_t lamps, uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 2);
    std::vector<Float3> weights(lamps, Float3{1, 1, 1});
    for (size_t lamp = 1; lamp < lamps; ++lamp)
        weights[lamp] = {unit(random), unit(random), unit(random)};
    return weights;
}

/// Update all texels at once.
std::vector<uint32_t> updateAll(const receivers::Atlas& atlas, std::span<const Float3> weights)
{
    std::vector<uint32_t> texels(size_t{atlas.record.width} * atlas.record.height);
    pack::updateReceivers(atlas.tables(), weights, kAllGroups, texels);
    return texels;
}

TEST(ReceiverLight, allLampsAtOnceAreTheirSumWithinTheCodecs)
{
    const RandomReceivers scene(40, 30, 9, 1);
    for (const auto codec : {formats::ReceiverCodec::rgb9e5, formats::ReceiverCodec::rgbm})
    {
        receivers::AtlasOptions options;
        options.codec = codec;
        const receivers::Atlas atlas = receivers::packAtlas(scene.baked(), options);
        ReceiverLight light(atlas.tables());
        EXPECT_EQ(light.update(), kAllGroups);
        const std::vector<Float3> ones(9, Float3{1, 1, 1});
        // of the largest channel: what is stored, and once more RGB9E5 for the sum
        const double bound = (codec == formats::ReceiverCodec::rgb9e5 ? 0.002 : 0.0052) + 0.002;
        for (uint32_t y = 0; y < scene.height; ++y)
            for (uint32_t x = 0; x < scene.width; ++x)
            {
                const uint32_t word = light.texels()[y * scene.width + x];
                if (!scene.isValid(x, y))
                {
                    EXPECT_EQ(word, 0u);
                    continue;
                }
                const Double3 wanted = sumLamps(scene.lightAt(x, y), ones);
                const Double3 off = decodeTexel(word) * double{atlas.record.scale} - wanted;
                // colours of the lamps differ, so the largest channel of all is at most all of theirs
                double largest = 0;
                for (const Float3& lamp : scene.lightAt(x, y))
                    largest += double{std::max({lamp.x, lamp.y, lamp.z})};
                ASSERT_LE(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), bound * largest);
            }
    }
}

TEST(ReceiverLight, lampsKeepTheirOwnWeights)
{
    // six lamps that all are kept, weights by channel
    RandomReceivers scene(24, 24, 6, 2);
    for (size_t i = 0; i < scene.light.size(); ++i)
        scene.light[i] = scene.light[i] + Float3{0.5f, 0.5f, 0.5f};
    const receivers::Atlas atlas = receivers::packAtlas(scene.baked(), {});
    const std::vector<Float3> weights = randomWeights(6, 7);
    ReceiverLight light(atlas.tables());
    for (size_t lamp = 1; lamp < 6; ++lamp)
        light.setWeight(lamp, weights[lamp]);
    light.update();
    for (uint32_t y = 0; y < scene.height; ++y)
        for (uint32_t x = 0; x < scene.width; ++x)
            if (scene.isValid(x, y))
            {
                const Double3 wanted = sumLamps(scene.lightAt(x, y), weights);
                const Double3 off =
                    decodeTexel(light.texels()[y * scene.width + x]) * double{atlas.record.scale} - wanted;
                ASSERT_LE(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}),
                          0.004 * std::max({wanted.x, wanted.y, wanted.z}) * 2);
            }
}

TEST(ReceiverLight, moreThanThirtyOneLamps)
{
    const RandomReceivers scene(16, 16, 40, 3);
    const receivers::Atlas atlas = receivers::packAtlas(scene.baked(), {});
    std::vector<Float3> weights(40, Float3{1, 1, 1});
    const std::vector<uint32_t> on = updateAll(atlas, weights);
    weights[39] = {};
    const std::vector<uint32_t> off = updateAll(atlas, weights);
    EXPECT_NE(on, off);
}

TEST(ReceiverLight, fourPartialUpdatesAreOneFullUpdateBitForBit)
{
    const RandomReceivers scene(50, 33, 12, 4);
    const receivers::Atlas atlas = receivers::packAtlas(scene.baked(), {});
    const std::vector<Float3> before = randomWeights(12, 1), after = randomWeights(12, 2);
    const std::vector<uint32_t> full = updateAll(atlas, after);
    std::vector<uint32_t> texels = updateAll(atlas, before);
    for (const uint32_t groups : {2u, 8u, 1u, 8u, 4u}) // in any order, and twice
        pack::updateReceivers(atlas.tables(), after, groups, texels);
    EXPECT_EQ(texels, full);
    EXPECT_NE(updateAll(atlas, before), full);
}

TEST(ReceiverLight, updatesCostWhatTheirTexelsHave)
{
    const RandomReceivers scene(61, 44, 9, 6);
    const receivers::Atlas atlas = receivers::packAtlas(scene.baked(), {});
    for (uint32_t groups = 0; groups <= kAllGroups; ++groups)
    {
        constexpr uint32_t kUntouched = 0xDEADBEEF;
        std::vector<uint32_t> texels(size_t{61} * 44, kUntouched);
        pack::updateReceivers(atlas.tables(), randomWeights(9, 1), groups, texels);
        const auto written = texels.size() - static_cast<size_t>(std::ranges::count(texels, kUntouched));
        const pack::ReceiverCost cost = pack::countUpdate(atlas.tables(), groups);
        EXPECT_EQ(cost.texels, written) << groups;
        EXPECT_EQ(cost.written_bytes, 4 * written) << groups;
    }
    EXPECT_EQ(pack::countUpdate(atlas.tables(), 0), pack::ReceiverCost{});
    // all is the whole of the tables
    EXPECT_EQ(pack::countUpdate(atlas.tables(), kAllGroups).read_bytes,
              4 * atlas.words.size() + 40 * atlas.blocks.size() + 16 * atlas.lamps.size());
}

TEST(ReceiverLight, partialUpdatesLeaveOtherTexelsAlone)
{
    const RandomReceivers scene(24, 16, 6, 8);
    const receivers::Atlas atlas = receivers::packAtlas(scene.baked(), {});
    const std::vector<uint32_t> before = updateAll(atlas, randomWeights(6, 1));
    const std::vector<uint32_t> after = updateAll(atlas, randomWeights(6, 2));
    std::vector<uint32_t> texels = before;
    pack::updateReceivers(atlas.tables(), randomWeights(6, 2), 2, texels);
    for (uint32_t y = 0; y < scene.height; ++y)
        for (uint32_t x = 0; x < scene.width; ++x)
        {
            const size_t texel = y * scene.width + x;
            const bool is_due = x % 2 == 1 && y % 2 == 0;
            ASSERT_EQ(texels[texel], (is_due ? after : before)[texel]) << x << ", " << y;
        }
}

TEST(ReceiverLight, slowFadesEndWithAllTexelsAtTheLastWeights)
{
    const RandomReceivers scene(20, 20, 4, 5);
    const receivers::Atlas atlas = receivers::packAtlas(scene.baked(), {});
    ReceiverLight light(atlas.tables());
    light.update();
    std::vector<Float3> weights(4, Float3{1, 1, 1});
    for (int frame = 1; frame <= 20; ++frame)
    {
        weights[2] = Float3{1, 1, 1} * (1 - 0.009f * static_cast<float>(frame));
        light.setWeight(2, weights[2]);
        EXPECT_EQ(std::popcount(light.update()), 1);
    }
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_EQ(std::popcount(light.update()), 1);
    EXPECT_EQ(light.update(), 0u);
    const std::vector<uint32_t> full = updateAll(atlas, weights);
    EXPECT_TRUE(std::ranges::equal(light.texels(), full));
}

/// Schedule of two lamps whose texels have been updated.
ReceiverSchedule startSchedule()
{
    ReceiverSchedule schedule(2);
    EXPECT_EQ(schedule.nextGroups(), kAllGroups);
    return schedule;
}

TEST(ReceiverSchedule, nothingIsUpdatedWhenNothingChanges)
{
    ReceiverSchedule schedule = startSchedule();
    EXPECT_EQ(schedule.nextGroups(), 0u);
    schedule.setWeight(1, {1, 1, 1});
    EXPECT_EQ(schedule.nextGroups(), 0u);
    schedule.setWeight(1, {1, 1, 0.5f});
    EXPECT_EQ(schedule.nextGroups(), kAllGroups);
    EXPECT_EQ(schedule.nextGroups(), 0u);
}

TEST(ReceiverSchedule, largeChangesUpdateAllSmallOnesACheckerboardSmallerOnesAQuarter)
{
    ReceiverSchedule large = startSchedule();
    large.setWeight(0, {1, 1.09f, 1});
    EXPECT_EQ(large.nextGroups(), kAllGroups);
    EXPECT_EQ(large.nextGroups(), 0u);

    // texels (0, 0) and (1, 1), then (1, 0) and (0, 1): the reference implementation updates columns
    ReceiverSchedule middle = startSchedule();
    middle.setWeight(0, {1, 1, 0.95f});
    EXPECT_EQ(middle.nextGroups(), 1u | 8u);
    EXPECT_EQ(middle.nextGroups(), 2u | 4u);
    EXPECT_EQ(middle.nextGroups(), 0u);

    ReceiverSchedule small = startSchedule();
    small.setWeight(0, {1.03f, 1, 1});
    EXPECT_EQ(small.nextGroups(), 1u);
    EXPECT_EQ(small.nextGroups(), 8u);
    EXPECT_EQ(small.nextGroups(), 2u);
    EXPECT_EQ(small.nextGroups(), 4u);
    EXPECT_EQ(small.nextGroups(), 0u);
}

TEST(ReceiverSchedule, noTexelShowsWeightsThatAreFurtherOffThanTheFullThreshold)
{
    ReceiverSchedule schedule = startSchedule();
    std::array<float, 4> shown{1, 1, 1, 1};
    std::mt19937 random(9);
    std::uniform_real_distribution<float> step(-0.06f, 0.06f);
    float weight = 1;
    uint32_t updated = 0;
    for (int frame = 0; frame < 500; ++frame)
    {
        weight = std::max(0.0f, weight + step(random));
        schedule.setWeight(1, {weight, weight, weight});
        const uint32_t groups = schedule.nextGroups();
        updated += static_cast<uint32_t>(std::popcount(groups));
        for (uint32_t group = 0; group < 4; ++group)
        {
            if (groups >> group & 1)
                shown[group] = weight;
            ASSERT_LE(std::abs(shown[group] - weight), 0.08f);
        }
    }
    EXPECT_LT(updated, 1200u); // of 2000 if all were
}

TEST(ReceiverSchedule, pairsTakeTurnsWhileLampsKeepChanging)
{
    ReceiverSchedule schedule = startSchedule();
    uint32_t last = 0;
    for (int frame = 1; frame <= 10; ++frame)
    {
        schedule.setWeight(0, Float3{1, 1, 1} * (1 + 0.025f * static_cast<float>(frame)));
        const uint32_t groups = schedule.nextGroups();
        EXPECT_TRUE(frame <= 2 || groups == (last == 9u ? 6u : 9u)) << frame;
        last = groups;
    }
}

} // namespace
