// Tests that texels encoded in formats without compression decode to themselves, or to the nearest.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/plain_encoder.h"
#include "formats/texels/shared_exponent.h"

#include "formats/base/half.h"
#include "formats/texels/decode_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

std::vector<DecodedTexel> encodeAndDecode(const TexelFormatTraits& traits,
                                          const std::vector<DecodedTexel>& texels)
{
    std::vector<std::byte> bytes(texels.size() * traits.block_bytes);
    encodePlain(traits, texels, bytes);
    return decodeMip(traits, static_cast<uint32_t>(texels.size()), 1, bytes);
}

TEST(EncodePlain, keepsWhatAFormatHas)
{
    std::mt19937 random(1);
    size_t formats = 0;
    for (const TexelFormatTraits& traits : detail::kTexelFormats)
    {
        if (traits.family != TexelFamily::plain)
            continue;
        SCOPED_TRACE(traits.name);
        std::vector<std::byte> bytes(size_t{1000} * traits.block_bytes);
        for (std::byte& byte : bytes)
            byte = static_cast<std::byte>(random());
        const std::vector<DecodedTexel> texels = decodeMip(traits, 1000, 1, bytes);
        EXPECT_EQ(encodeAndDecode(traits, texels), texels);
        ++formats;
    }
    EXPECT_EQ(formats, 8u);
}

TEST(EncodePlain, roundsToTheNearest)
{
    std::vector<DecodedTexel> texels;
    for (uint32_t code = 0; code < 65536; ++code)
        texels.push_back({static_cast<uint16_t>(code), 0, 0, 0xFFFF});
    const std::vector<DecodedTexel> decoded = encodeAndDecode(texelTraits(TexelFormat::r8_unorm), texels);
    for (size_t i = 0; i < texels.size(); ++i)
        ASSERT_LE(std::abs(int{decoded[i][0]} - int{texels[i][0]}), 128) << i; // half a step of 257

    // a mantissa of 9 bits for the largest channel: steps of at most 1/256 of it
    texels.clear();
    for (uint16_t half = 0x0400; half < 0x7BFF; half = static_cast<uint16_t>(half + 7))
        texels.push_back({half, static_cast<uint16_t>(half / 2), 0, kHalfOne});
    const std::vector<DecodedTexel> shared = encodeAndDecode(texelTraits(TexelFormat::rgb9e5_float), texels);
    for (size_t i = 0; i < texels.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(floatFromHalf(shared[i][c]), floatFromHalf(texels[i][c]),
                        floatFromHalf(texels[i][0]) / 511)
                << i;
}

TEST(EncodeSharedExponent, hasAnUpperAndALowerEnd)
{
    EXPECT_EQ(decodeSharedExponent(encodeSharedExponent({65408, 1e9, -1})),
              (std::array{65408.0f, 65408.0f, 0.0f}));
    const TexelFormatTraits& traits = texelTraits(TexelFormat::rgb9e5_float);
    const uint16_t largest_half = 0x7BFF;
    EXPECT_EQ(floatFromHalf(encodeAndDecode(traits, {{largest_half, 0, 0, kHalfOne}})[0][0]), 65408)
        << "rounding up has no exponent left";
    const double step = std::ldexp(1.0, -24);
    EXPECT_EQ(decodeSharedExponent(encodeSharedExponent({step, 0.4 * step, 511 * step})),
              (std::array{static_cast<float>(step), 0.0f, static_cast<float>(511 * step)}));
}

} // namespace

} // namespace hearth::test
