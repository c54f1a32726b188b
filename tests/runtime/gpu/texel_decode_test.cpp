// Tests decoders of compressed texels against what the first graphics device fetches.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/texels/bc_decoder.h"
#include "tests/runtime/gpu/texel_fetcher.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

/// Set bits of a block, the lowest first.
void setBits(std::span<std::byte> block, size_t first, size_t count, size_t value)
{
    for (size_t i = first; i < first + count; ++i, value >>= 1)
    {
        const auto bit = static_cast<std::byte>(1u << i % 8);
        block[i / 8] = (value & 1u) != 0 ? block[i / 8] | bit : block[i / 8] & ~bit;
    }
}

/// Fill block `number` of many with random bits. Each mode occurs with each partition.
void fillBlock(const TexelFormatTraits& traits, size_t number, std::mt19937& random,
               std::span<std::byte> block)
{
    for (std::byte& byte : block)
        byte = static_cast<std::byte>(random() & 255u);
    const bool is_bc6h = traits.coding == TexelCoding::float_value;
    if (is_bc6h)
    {
        // 32 values of 5 bits, of which 14 modes and 4 reserved ones differ
        setBits(block, 0, 5, number % 32);
        setBits(block, 77, 5, number / 32 % 32);
    }
    else if (traits.format == TexelFormat::bc7_unorm || traits.format == TexelFormat::bc7_srgb)
    {
        const size_t mode = number % 9; // 8 is reserved
        setBits(block, 0, mode + 1, mode < 8 ? size_t{1} << mode : 0);
        if (mode < 8)
            setBits(block, mode + 1, 6, number / 9 % 64);
    }
    else if (random() % 4 == 0) // endpoints that are equal or extreme
        for (size_t i = 0; i < block.size(); i += 8)
            for (size_t j = 0; j < 4; ++j)
                block[i + j] = std::array{std::byte{0}, std::byte{0x80}, std::byte{0x81}, std::byte{0x7F},
                                          std::byte{0xFF}}[random() % 5];
}

/// Return the value of a channel that a shader should get.
double expectedValue(TexelCoding coding, size_t channel, uint16_t value)
{
    switch (coding)
    {
    case TexelCoding::float_value:
        return double{floatFromHalf(value)};
    case TexelCoding::snorm:
        return static_cast<int16_t>(value) / 32767.0;
    default:
    {
        const double code = value / 65535.0;
        if (coding == TexelCoding::unorm || channel == 3)
            return code;
        return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    }
    }
}

/// Return the largest difference, of 1, that lavapipe's decoders of BC1 to BC5 may have to ours: see
/// formats/texels/bc_decoder.cpp. Those of BC6H and BC7 are exact.
double allowedDifference(const TexelFormatTraits& traits, size_t channel)
{
    switch (traits.format)
    {
    case TexelFormat::bc4_unorm:
    case TexelFormat::bc5_unorm:
        return 1.61 / 255;
    case TexelFormat::bc4_snorm:
    case TexelFormat::bc5_snorm:
        return 1.81 / 127;
    case TexelFormat::bc6h_ufloat:
    case TexelFormat::bc6h_sfloat:
        return 0;
    case TexelFormat::bc7_unorm:
    case TexelFormat::bc7_srgb:
        return 1e-6;
    default:
        // a code is up to 2.28 of 255 in linear light, to which lavapipe converts approximately
        if (channel == 3)
            return 2.001 / 255;
        return (traits.coding == TexelCoding::srgb ? 2.33 : 1.001) / 255;
    }
}

/// Compare a decoded block with fetched texels.
/// texels  first texel of the block; rows of `width`
void compareBlock(const TexelFormatTraits& traits, std::span<const std::byte> block,
                  std::span<const std::array<float, 4>> texels, uint32_t width)
{
    std::array<DecodedTexel, 16> decoded;
    decodeBcBlock(traits, block, decoded);
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < 4; ++c)
        {
            const double expected = expectedValue(traits.coding, c, decoded[t][c]);
            const double fetched = double{texels[t / 4 * width + t % 4][c]};
            if (expected == fetched || (std::isnan(expected) && std::isnan(fetched)))
                continue;
            ASSERT_LE(std::abs(expected - fetched), allowedDifference(traits, c))
                << traits.name << ", mode bits " << std::to_integer<int>(block[0]) << ", texel " << t
                << ", channel " << c << ", expected " << expected;
        }
}

} // namespace

TEST(TexelDecode, bcEqualsTheDevice)
{
    auto created = TexelFetcher::create();
    ASSERT_TRUE(created.ok()) << formatMessage(created.error());
    TexelFetcher& fetcher = **created;
    constexpr uint32_t kWidth = 256; // 4096 blocks
    std::mt19937 random(5);
    for (const TexelFormatTraits& traits : formats::detail::kTexelFormats)
    {
        if (traits.family != TexelFamily::bc || !fetcher.supports(traits))
            continue;
        std::vector<std::byte> blocks(mipBytes(traits, kWidth, kWidth));
        const auto block = [&](size_t i)
        { return std::span(blocks).subspan(i * traits.block_bytes, traits.block_bytes); };
        const size_t count = blocks.size() / traits.block_bytes;
        for (size_t i = 0; i < count; ++i)
            fillBlock(traits, i, random, block(i));
        const auto texels = fetcher.fetch(traits, kWidth, kWidth, blocks);
        ASSERT_TRUE(texels.ok()) << formatMessage(texels.error());
        for (size_t i = 0; i < count && !HasFatalFailure(); ++i)
        {
            const size_t first = i / (kWidth / 4) * 4 * kWidth + i % (kWidth / 4) * 4;
            compareBlock(traits, block(i), std::span(*texels).subspan(first), kWidth);
        }
    }
    EXPECT_EQ(fetcher.messages(), std::vector<std::string>{});
}

} // namespace hearth::test
