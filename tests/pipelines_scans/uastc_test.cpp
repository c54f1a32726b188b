// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/basis_uastc.h"
#include "tests/pipelines_scans/ktx2_builder.h"
#include "tests/pipelines_scans/uastc_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hearth::import
{

namespace
{

using namespace test;

using Patterns = std::array<uint8_t, 16>;

Patterns makePatterns(uint32_t seed, uint32_t count)
{
    Patterns pattern{};
    for (uint32_t i = 0; i < 16; ++i)
        pattern[i] = static_cast<uint8_t>(astcPartition(seed, count, i % 4, i / 4));
    return pattern;
}

TEST(UastcPatterns, ofTwoPartsAreThoseOfBc7)
{
    // BC7's patterns 0 to 15, 17 to 26, 29, 32, 33 and 52: bit i is the subset of texel i
    constexpr std::array<uint16_t, 30> kBc7 = {0xCCCC, 0x8888, 0xEEEE, 0xECC8, 0xC880, 0xFEEC, 0xFEC8, 0xEC80,
                                               0xC800, 0xFFEC, 0xFE80, 0xE800, 0xFFE8, 0xFF00, 0xFFF0, 0xF000,
                                               0x008E, 0x7100, 0x08CE, 0x008C, 0x7310, 0x3100, 0x8CCE, 0x088C,
                                               0x3110, 0x6666, 0x0FF0, 0xAAAA, 0xF0F0, 0xC936};
    ASSERT_EQ(uastcSeeds(2).size(), kBc7.size());
    for (size_t i = 0; i < kBc7.size(); ++i)
    {
        uint32_t bits = 0;
        const Patterns pattern = makePatterns(uastcSeeds(2)[i], 2);
        for (uint32_t texel = 0; texel < 16; ++texel)
            bits |= static_cast<uint32_t>(pattern[texel]) << texel;
        // ASTC may number the two subsets in the other order
        EXPECT_TRUE(bits == kBc7[i] || bits == (kBc7[i] ^ 0xFFFFu)) << i;
    }
}

TEST(UastcPatterns, areDistinctAndHaveAllTheirParts)
{
    for (const auto& [mode, parts] : {std::pair{2u, 2u}, std::pair{3u, 3u}, std::pair{7u, 2u}})
    {
        std::set<Patterns> distinct;
        for (const uint16_t seed : uastcSeeds(mode))
        {
            const Patterns pattern = makePatterns(seed, parts);
            EXPECT_EQ(std::set<uint8_t>(pattern.begin(), pattern.end()).size(), parts);
            distinct.insert(pattern);
        }
        EXPECT_EQ(distinct.size(), uastcSeeds(mode).size());
    }
}

/// Return endpoints of only 0 and 255, selected by `highs`, as the stored values that represent them in each
/// range: with trits and quints the lowest bit mirrors the range, so 1 is its top.
std::vector<uint32_t> makeExtremeEndpoints(uint32_t levels, const std::vector<bool>& highs)
{
    std::vector<uint32_t> values;
    for (const bool high : highs)
        values.push_back(!high ? 0 : getDigitBase(levels) == 1 ? levels - 1 : 1);
    return values;
}

bool highWeight(uint32_t texel, bool anchor, uint32_t plane)
{
    return !anchor && (texel * 7 + texel / 4 + plane) % 3 != 0;
}

TEST(DecodeUastc, readsEveryMode)
{
    for (const UastcLayout& layout : kUastcLayouts)
    {
        SCOPED_TRACE("mode " + std::to_string(layout.mode));
        UastcBits out;
        out.putCode(layout.code);
        out.put(0x2A5A5A, layout.hints); // hints for other formats are ignored here
        const uint32_t pattern = layout.subsets > 1 ? 9 : 0;
        out.put(pattern, layout.pattern_bits);
        const uint32_t channel = layout.channel_bits > 0 ? 1 : 3;
        out.put(channel, layout.channel_bits);

        // the first endpoint is low in some channels and high in others
        const auto firstIsHigh = [](uint32_t subset, uint32_t component)
        { return (subset + component) % 2 != 0; };
        std::vector<bool> highs;
        for (uint32_t subset = 0; subset < layout.subsets; ++subset)
            for (uint32_t component = 0; component < layout.components; ++component)
            {
                highs.push_back(firstIsHigh(subset, component));
                highs.push_back(!firstIsHigh(subset, component));
            }
        putEndpoints(out, layout.levels, makeExtremeEndpoints(layout.levels, highs));

        const Patterns parts =
            layout.subsets == 1 ? Patterns{} : makePatterns(uastcSeeds(layout.mode)[pattern], layout.subsets);
        const auto isAnchor = [&](uint32_t texel)
        { return std::find(parts.begin(), parts.end(), parts[texel]) == parts.begin() + texel; };
        for (uint32_t texel = 0; texel < 16; ++texel)
            for (uint32_t plane = 0; plane < layout.planes; ++plane)
                out.put(highWeight(texel, isAnchor(texel), plane) ? 31 : 0,
                        layout.weight_bits - (isAnchor(texel) ? 1 : 0));
        EXPECT_EQ(out.used(), layout.bits);

        DecodedImage image{4, 4, ChannelType::unorm8, std::vector<std::byte>(64)};
        ASSERT_TRUE(decodeUastc(std::as_bytes(std::span(out.block())), false, image));
        for (uint32_t texel = 0; texel < 16; ++texel)
            for (uint32_t c = 0; c < 4; ++c)
            {
                const uint32_t component = layout.components == 2 ? (c == 3 ? 1 : 0) : c;
                const bool high_weight =
                    highWeight(texel, isAnchor(texel), layout.planes == 2 && c == channel ? 1 : 0);
                const bool high =
                    component >= layout.components || firstIsHigh(parts[texel], component) != high_weight;
                EXPECT_EQ(getTexel(image, texel % 4, texel / 4)[c], high ? 255 : 0)
                    << "texel " << texel << " channel " << c;
            }
    }
}

Bytes solidBlock(const Rgba8& texel)
{
    UastcBits out;
    out.putCode(kUastcSolidCode);
    for (const uint8_t channel : texel)
        out.put(channel, 8);
    return out.block();
}

TEST(DecodeUastc, readsSolidBlocksAndInterpolates)
{
    DecodedImage image{4, 4, ChannelType::unorm8, std::vector<std::byte>(64)};
    const Bytes solid = solidBlock({1, 2, 3, 4});
    ASSERT_TRUE(decodeUastc(std::as_bytes(std::span(solid)), true, image));
    EXPECT_EQ(getTexel(image, 3, 3), (Rgba8{1, 2, 3, 4}));

    // mode 18: endpoints of 5 bits, weights of 5 bits
    UastcBits out;
    out.put(9, 4);
    out.put(0, 15);
    for (const uint32_t value : {0u, 31u, 10u, 10u, 31u, 0u})
        out.put(value, 5);
    for (uint32_t texel = 0; texel < 16; ++texel)
        out.put(texel * 2, texel == 0 ? 4 : 5);
    ASSERT_TRUE(decodeUastc(std::as_bytes(std::span(out.block())), false, image));
    EXPECT_EQ(getTexel(image, 0, 0), (Rgba8{0, 82, 255, 255}));
    // weight 16 of 31 becomes 34 of 64 (33 by its bits, and ASTC adds one beyond the middle):
    // 65535 * 34 / 64 = 135.99 * 256
    EXPECT_EQ(getTexel(image, 0, 2), (Rgba8{135, 82, 120, 255}));
}

Ktx2 uastcFile(const Bytes& blocks, uint32_t width, uint32_t height)
{
    Ktx2 ktx;
    ktx.vk_format = 0;
    ktx.model = 166;
    ktx.channels = {3};
    ktx.width = width;
    ktx.height = height;
    ktx.levels = {blocks};
    ktx.uncompressed = {blocks.size()};
    return ktx;
}

TEST(DecodeUastc, readsWholeFilesAndRefusesDamage)
{
    Bytes blocks = solidBlock({10, 20, 30, 40});
    const Bytes second = solidBlock({50, 60, 70, 80});
    blocks.insert(blocks.end(), second.begin(), second.end());
    const auto image = decode(uastcFile(blocks, 8, 4).file());
    ASSERT_TRUE(image.ok()) << image.error().detail;
    EXPECT_EQ(getTexel(*image, 3, 3), (Rgba8{10, 20, 30, 40}));
    EXPECT_EQ(getTexel(*image, 4, 0), (Rgba8{50, 60, 70, 80}));

    const auto getIssue = [](const Ktx2& ktx) { return decode(ktx.file()).error().issue; };
    EXPECT_EQ(getIssue(uastcFile(blocks, 12, 4)), Issue::image_malformed);
    EXPECT_EQ(getIssue(uastcFile(blocks, 7, 4)), Issue::image_malformed);
    blocks[16] = 0x45; // the only prefix code without a mode
    EXPECT_EQ(getIssue(uastcFile(blocks, 8, 4)), Issue::image_malformed);
    blocks[16] = 0x1D; // mode 2 with pattern 31; there are only 30
    blocks[18] = 0xFF;
    blocks[19] = 0xFF;
    EXPECT_EQ(getIssue(uastcFile(blocks, 8, 4)), Issue::image_malformed);
}

} // namespace

} // namespace hearth::import
