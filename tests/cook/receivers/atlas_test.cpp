// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/select/atlas.h"
#include "formats/texels/shared_exponent.h"
#include "tests/cook/receivers/random_receivers.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace
{

using namespace hearth;
using receivers::Atlas;
using receivers::AtlasOptions;
using test::RandomReceivers;

/// Colours of a texel by lamp, as stored.
using Stored = std::map<uint32_t, std::array<float, 3>>;

/// Read all texels of an atlas of RGB9E5 by FORMAT.md alone.
std::map<std::pair<uint32_t, uint32_t>, Stored> readTexels(const Atlas& atlas)
{
    std::map<std::pair<uint32_t, uint32_t>, Stored> texels;
    for (const formats::ReceiverBlockRecord& block : atlas.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            const uint32_t place = atlas.words[block.first_word + i];
            Stored stored;
            for (uint32_t c = 0; c < block.color_count; ++c)
                stored[block.lamps[c / 2] >> (c % 2 * 16) & 0xFFFF] = formats::decodeSharedExponent(
                    atlas.words[block.first_word + (c + 1) * block.texel_count + i]);
            EXPECT_TRUE(texels.emplace(std::pair(place % 16384, place / 16384), stored).second);
        }
    return texels;
}

TEST(ReceiverAtlas, holdsWhatWasChosenForEachTexel)
{
    const RandomReceivers scene(37, 21, 9, 1);
    const Atlas atlas = receivers::packAtlas(scene.baked(), {});
    auto texels = readTexels(atlas);
    EXPECT_EQ(texels.size(), atlas.record.texel_count);
    std::vector<receivers::KeptLight> kept;
    for (uint32_t y = 0; y < scene.height; ++y)
        for (uint32_t x = 0; x < scene.width; ++x)
        {
            if (!scene.isValid(x, y))
            {
                EXPECT_FALSE(texels.contains({x, y}));
                continue;
            }
            receivers::selectLights(scene.lightAt(x, y), true, {}, kept);
            const Stored& stored = texels.at({x, y});
            ASSERT_EQ(stored.size(), kept.size());
            for (const receivers::KeptLight& lamp : kept)
            {
                const double scale = double{atlas.record.scale};
                const double largest = std::max({lamp.color.x, lamp.color.y, lamp.color.z});
                EXPECT_NEAR(double{stored.at(lamp.lamp)[0]} * scale, lamp.color.x, 2e-3 * largest);
                EXPECT_NEAR(double{stored.at(lamp.lamp)[1]} * scale, lamp.color.y, 2e-3 * largest);
                EXPECT_NEAR(double{stored.at(lamp.lamp)[2]} * scale, lamp.color.z, 2e-3 * largest);
            }
        }
}

/// Texels say so where they do not keep a lamp with more than 2 % of their light, by its largest channel.
TEST(ReceiverAtlas, marksTexelsThatDropLamps)
{
    const RandomReceivers scene(40, 30, 9, 4);
    AtlasOptions options;
    options.select.max_colors = 3;
    const Atlas atlas = receivers::packAtlas(scene.baked(), options);
    size_t marked = 0;
    for (const formats::ReceiverBlockRecord& block : atlas.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            const uint32_t place = atlas.words[block.first_word + i];
            const std::span<const Float3> light = scene.lightAt(place & 16383, place >> 14 & 16383);
            Double3 sum{};
            double dropped = 0;
            for (uint32_t lamp = 0; lamp < light.size(); ++lamp)
            {
                const Double3 color = widen(light[lamp]);
                sum = sum + color;
                bool is_kept = false;
                for (uint32_t c = 0; c < block.color_count; ++c)
                    is_kept = is_kept || (block.lamps[c / 2] >> (c % 2 * 16) & 0xFFFF) == lamp;
                if (!is_kept)
                    dropped = std::max({dropped, color.x, color.y, color.z});
            }
            const bool drops = dropped > 0.02 * std::max({sum.x, sum.y, sum.z});
            ASSERT_EQ(place >> 28 & 1, drops ? 1u : 0u);
            marked += drops ? 1 : 0;
        }
    EXPECT_EQ(atlas.dropping_count, marked);
    EXPECT_GT(marked, 200u);
    EXPECT_EQ(receivers::packAtlas(scene.baked(), {}).dropping_count, 0u) << "12 of 9 lamps";
}

TEST(ReceiverAtlas, blocksShareLampsAndGroupInARepeatableOrder)
{
    const RandomReceivers scene(64, 64, 5, 2);
    const Atlas atlas = receivers::packAtlas(scene.baked(), {});
    uint32_t group = 0, blocks[4] = {};
    std::set<std::tuple<uint32_t, uint32_t, std::vector<uint32_t>>>
        partial; // blocks with fewer than 64 texels
    for (const formats::ReceiverBlockRecord& block : atlas.blocks)
    {
        EXPECT_GE(block.group, group);
        group = block.group;
        ++blocks[group];
        ASSERT_LE(block.texel_count, 64u);
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            const uint32_t place = atlas.words[block.first_word + i];
            EXPECT_EQ((place & 1) + 2 * (place >> 14 & 1), group);
        }
        // one at most of each group and set of lamps: the last
        const bool is_first =
            block.texel_count == 64 ||
            partial.emplace(group, block.color_count, std::vector<uint32_t>(block.lamps, block.lamps + 6))
                .second;
        EXPECT_TRUE(is_first);
    }
    for (uint32_t i = 0; i < 4; ++i)
        EXPECT_EQ(atlas.record.group_blocks[i], blocks[i]);
    EXPECT_EQ(receivers::packAtlas(scene.baked(), {}).words, atlas.words);
}

TEST(ReceiverAtlas, countsRecordsOfThreeAndTheLargestDroppedShare)
{
    const RandomReceivers scene(16, 16, 11, 3);
    const Atlas atlas = receivers::packAtlas(scene.baked(), {});
    uint64_t colors = 0, triples = 0;
    for (const auto& [place, stored] : readTexels(atlas))
    {
        colors += stored.size();
        triples += stored.size() / 3 + (stored.size() % 3 != 0);
    }
    EXPECT_EQ(atlas.color_count, colors);
    EXPECT_EQ(atlas.triple_count, triples);
    EXPECT_LE(atlas.largest_dropped, 0.02);
    EXPECT_GT(atlas.largest_dropped, 0);
}

TEST(ReceiverAtlas, rgbmIsScaledIntoItsRange)
{
    RandomReceivers scene(8, 8, 3, 4);
    for (Float3& light : scene.light)
        light = light * 1e5f;
    AtlasOptions options;
    options.codec = formats::ReceiverCodec::rgbm;
    const Atlas atlas = receivers::packAtlas(scene.baked(), options);
    EXPECT_EQ(std::log2(atlas.record.scale), std::floor(std::log2(atlas.record.scale)));
    float largest = 0, sum = 0;
    for (uint32_t y = 0; y < 8; ++y)
        for (uint32_t x = 0; x < 8; ++x, sum = 0)
            if (scene.isValid(x, y))
            {
                for (const Float3& light : scene.lightAt(x, y))
                    sum += light.x;
                largest = std::max(largest, sum);
            }
    EXPECT_LE(largest, 36 * atlas.record.scale * 1.001f);
    EXPECT_GT(largest, 9 * atlas.record.scale);
}

TEST(ReceiverAtlas, darknessHasNoRecords)
{
    RandomReceivers scene(8, 8, 3, 5);
    std::fill(scene.light.begin(), scene.light.end(), Float3{});
    const Atlas atlas = receivers::packAtlas(scene.baked(), {});
    EXPECT_TRUE(atlas.blocks.empty() && atlas.words.empty());
    EXPECT_EQ(atlas.record.scale, 1);
}

} // namespace
