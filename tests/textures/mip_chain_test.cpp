// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/mip_chain.h"

#include "cook/textures/srgb.h"
#include "formats/base/half.h"
#include "formats/base/math.h"
#include "tests/textures/texture_test_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <span>

#include <tbb/global_control.h>

namespace hearth::textures
{

namespace
{

using namespace test;
using formats::ImageRecord;
using formats::TexelFormat;

constexpr std::array<std::array<uint32_t, 2>, 8> kSizes = {
    {{1, 1}, {1, 7}, {64, 1}, {5, 3}, {17, 33}, {64, 64}, {100, 60}, {1, 1025}}};

double linearMean(const std::vector<Rgba8>& texels, size_t channel)
{
    double sum = 0;
    for (const Rgba8& texel : texels)
        sum += double{SrgbTables::get().linear(texel[channel])};
    return sum / static_cast<double>(texels.size());
}

double mean(const std::vector<Rgba8>& texels, size_t channel)
{
    double sum = 0;
    for (const Rgba8& texel : texels)
        sum += texel[channel];
    return sum / static_cast<double>(texels.size());
}

TEST(MipChain, endsAtOneTexelAndKeepsTheFinest)
{
    for (const auto& [width, height] : kSizes)
    {
        ImageRecord image = makeRecord(width, height);
        image.mip_count = fullMipCount(width, height);
        const std::vector<std::byte> texels = randomBytes(size_t{width} * height * 4, 1);
        const std::vector<std::byte> chain = buildMipChain(image, texels);
        ASSERT_EQ(chain.size(), formats::mipOffset(image, image.mip_count));
        EXPECT_EQ(formats::mipExtent(image, image.mip_count - 1).width, 1u);
        EXPECT_EQ(formats::mipExtent(image, image.mip_count - 1).height, 1u);
        EXPECT_TRUE(std::equal(texels.begin(), texels.end(), chain.begin()));
    }
}

TEST(MipChain, constantStaysConstant)
{
    const auto check = [](ImageRecord image, Rgba8 texel)
    {
        for (const auto& [width, height] : kSizes)
        {
            image.width = width;
            image.height = height;
            ASSERT_EQ(
                buildMipChain(image, filled(width, height, texel)),
                filled(static_cast<uint32_t>(formats::mipOffset(image, fullMipCount(width, height)) / 4), 1,
                       texel));
        }
    };
    check(makeRecord(1, 1), {200, 3, 77, 255});
    check(makeRecord(1, 1), {200, 3, 77, 1});
    check(makeRecord(1, 1), {200, 3, 77, 0});
    check(makeRecord(1, 1, TexelFormat::rgba8_unorm), {1, 254, 128, 9});
    check(makeRecord(1, 1, TexelFormat::rgba8_unorm, formats::kImageNormalMap), {128, 128, 255, 255});
    check(makeRecord(1, 1, TexelFormat::rgba8_srgb, formats::kImageAlphaTested), {10, 20, 30, 255});
    check(makeRecord(1, 1, TexelFormat::rgba8_srgb, formats::kImageAlphaTested), {10, 20, 30, 128});
    check(makeRecord(1, 1, TexelFormat::rgba8_srgb, formats::kImageAlphaTested), {10, 20, 30, 127});
}

TEST(MipChain, blackAndWhiteAverageInLinearLight)
{
    std::vector<std::byte> texels = filled(2, 1, {0, 0, 0, 255});
    std::fill(texels.begin() + 4, texels.end(), std::byte{255});
    const ImageRecord color = makeRecord(2, 1);
    EXPECT_EQ(decodeMip(color, buildMipChain(color, texels), 1)[0], (Rgba8{188, 188, 188, 255}));
    const ImageRecord data = makeRecord(2, 1, TexelFormat::rgba8_unorm);
    EXPECT_EQ(decodeMip(data, buildMipChain(data, texels), 1)[0], (Rgba8{128, 128, 128, 255}));
}

/// Return texels of random channels of 16 bits; alpha from `min_alpha` up.
std::vector<std::byte> randomWide(size_t texels, uint32_t seed, uint32_t min_alpha = 0)
{
    std::mt19937 random(seed);
    std::vector<uint16_t> channels(texels * 4);
    for (size_t i = 0; i < channels.size(); ++i)
        channels[i] =
            static_cast<uint16_t>(i % 4 == 3 ? min_alpha + random() % (65536 - min_alpha) : random());
    const auto bytes = std::as_bytes(std::span(channels));
    return {bytes.begin(), bytes.end()};
}

uint16_t wideChannel(std::span<const std::byte> bytes, size_t at)
{
    uint16_t value;
    std::memcpy(&value, bytes.data() + at * 2, sizeof(value));
    return value;
}

TEST(MipChain, dataKeepSixteenBits)
{
    ImageRecord image = makeRecord(4, 4, TexelFormat::rgba16_unorm);
    image.mip_count = 3;
    const std::vector<std::byte> texels = randomWide(16, 1);
    const std::vector<std::byte> chain = buildMipChain(image, texels);
    ASSERT_EQ(chain.size(), (16u + 4u + 1u) * 8u);
    EXPECT_TRUE(std::equal(texels.begin(), texels.end(), chain.begin())) << "nothing is lost";
    for (size_t channel = 0; channel < 4; ++channel)
    {
        double sum = 0;
        for (size_t texel = 0; texel < 16; ++texel)
            sum += wideChannel(texels, texel * 4 + channel);
        EXPECT_NEAR(wideChannel(chain, 20 * 4 + channel), sum / 16, 0.51) << channel;
    }
}

TEST(MipChain, dataMayKeepEightBitsOfSixteen)
{
    const ImageRecord image = makeRecord(4, 4, TexelFormat::rgba16_unorm);
    ImageRecord cooked = makeRecord(4, 4, TexelFormat::rgba8_unorm);
    cooked.mip_count = 3;
    for (uint32_t seed = 0; seed < 20; ++seed)
    {
        const std::vector<std::byte> texels = randomWide(16, seed);
        const std::vector<std::byte> chain = buildMipChain(image, texels, 8);
        ASSERT_EQ(chain.size(), (16u + 4u + 1u) * 4u);
        for (size_t i = 0; i < 64; ++i)
            ASSERT_EQ(std::to_integer<long>(chain[i]), std::lround(wideChannel(texels, i) / 257.0));
        const Rgba8 last = decodeMip(cooked, chain, 2)[0];
        for (size_t channel = 0; channel < 4; ++channel)
        {
            double sum = 0;
            for (size_t texel = 0; texel < 16; ++texel)
                sum += wideChannel(texels, texel * 4 + channel);
            EXPECT_EQ(last[channel], std::lround(sum / 16 / 257));
        }
    }
}

TEST(MipChain, normalsKeepSixteenBits)
{
    // directions that differ by less than a step of 8 bits: their mean lies between
    ImageRecord image = makeRecord(2, 1, TexelFormat::rgba16_unorm, formats::kImageNormalMap);
    image.mip_count = 2;
    const std::array<uint16_t, 8> channels{32968, 32768, 65535, 65535, 33068, 32768, 65535, 65535};
    std::vector<std::byte> texels(16);
    std::memcpy(texels.data(), channels.data(), 16);
    const std::vector<std::byte> chain = buildMipChain(image, texels);
    for (size_t i = 0; i < channels.size(); ++i)
        EXPECT_NEAR(wideChannel(chain, i), channels[i], 1);
    EXPECT_NEAR(wideChannel(chain, 8), 33018, 1);
    EXPECT_NEAR(wideChannel(chain, 9), 32768, 1);
    EXPECT_NEAR(wideChannel(chain, 10), 65534, 1);
}

TEST(MipChain, normalsOfAnyLengthBecomeTheSame)
{
    ImageRecord image = makeRecord(2, 1, TexelFormat::rgba16_unorm, formats::kImageNormalMap);
    image.mip_count = 2;
    const double direction[] = {0.48, -0.36, 0.8};
    for (const double length : {0.7, 0.9, 1.0, 1.1, 1.2})
    {
        std::array<uint16_t, 8> channels;
        for (size_t i = 0; i < 8; ++i)
            channels[i] = i % 4 == 3
                              ? uint16_t{65535}
                              : static_cast<uint16_t>(std::lround((direction[i % 4] * length + 1) * 32767.5));
        std::vector<std::byte> texels(16);
        std::memcpy(texels.data(), channels.data(), 16);
        const std::vector<std::byte> chain = buildMipChain(image, texels);
        for (size_t i = 0; i < 12; ++i)
            if (i % 4 != 3)
                EXPECT_NEAR(wideChannel(chain, i), (direction[i % 4] + 1) * 32767.5, 2) << length;
    }
}

TEST(MipChain, normalsThatPointInwardsLieOnTheSurface)
{
    ImageRecord image = makeRecord(1, 1, TexelFormat::rgba8_unorm, formats::kImageNormalMap);
    image.mip_count = 1;
    const std::vector<std::byte> chain = buildMipChain(image, filled(1, 1, {255, 128, 0, 255}));
    EXPECT_EQ(decodeMip(image, chain, 0)[0], (Rgba8{255, 128, 128, 255}));
}

TEST(MipChain, mipsOfColoursAreMadeFromAllSixteenBits)
{
    const auto linear = [](double code)
    { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); };
    const auto coded = [](double light)
    { return light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - 0.055; };
    const ImageRecord image = makeRecord(4, 4, TexelFormat::rgba16_srgb);
    ImageRecord cooked = makeRecord(4, 4);
    cooked.mip_count = 3;
    int differences = 0; // of the same from texels that were rounded to 8 bits first
    for (uint32_t seed = 0; seed < 40; ++seed)
    {
        const std::vector<std::byte> texels = randomWide(16, seed, 65535);
        const std::vector<std::byte> chain = buildMipChain(image, texels);
        ASSERT_EQ(chain.size(), (16u + 4u + 1u) * 4u);
        for (size_t i = 0; i < 64; ++i)
            ASSERT_EQ(std::to_integer<long>(chain[i]), std::lround(wideChannel(texels, i) / 257.0));
        const std::vector<std::byte> rounded(chain.begin(), chain.begin() + 64);
        const Rgba8 early = decodeMip(cooked, buildMipChain(cooked, rounded), 2)[0];
        const Rgba8 last = decodeMip(cooked, chain, 2)[0];
        for (size_t channel = 0; channel < 3; ++channel)
        {
            double sum = 0;
            for (size_t texel = 0; texel < 16; ++texel)
                sum += linear(wideChannel(texels, texel * 4 + channel) / 65535.0);
            EXPECT_EQ(last[channel], std::lround(coded(sum / 16) * 255));
            differences += last[channel] != early[channel] ? 1 : 0;
        }
        EXPECT_EQ(last[3], 255);
    }
    EXPECT_GT(differences, 0) << "else rounding first would do";
}

TEST(MipChain, cutOutsOfSixteenBitsKeepTheirArea)
{
    const ImageRecord image = makeRecord(64, 64, TexelFormat::rgba16_srgb, formats::kImageAlphaTested);
    ImageRecord cooked = makeRecord(64, 64);
    cooked.mip_count = fullMipCount(64, 64);
    const std::vector<std::byte> texels = randomWide(64 * 64, 3);
    const std::vector<std::byte> chain = buildMipChain(image, texels);
    for (uint32_t mip = 0; mip < 4; ++mip)
    {
        const std::vector<Rgba8> cooked_texels = decodeMip(cooked, chain, mip);
        const auto passing = std::count_if(cooked_texels.begin(), cooked_texels.end(),
                                           [](const Rgba8& texel) { return texel[3] >= 128; });
        EXPECT_NEAR(static_cast<double>(passing) / static_cast<double>(cooked_texels.size()), 0.5, 0.03)
            << mip;
    }
}

TEST(MipChain, oddSizesWeightByArea)
{
    // five texels become two: each covers two and a half
    std::vector<std::byte> texels = filled(5, 1, {0, 0, 0, 0});
    for (size_t i = 0; i < 5; ++i)
        texels[i * 4] = static_cast<std::byte>(i * 50);
    const ImageRecord image = makeRecord(5, 1, TexelFormat::rgba8_unorm);
    const std::vector<Rgba8> mip = decodeMip(image, buildMipChain(image, texels), 1);
    ASSERT_EQ(mip.size(), 2u);
    EXPECT_EQ(mip[0][0], 40);  // (0 + 50 + 0.5 * 100) / 2.5
    EXPECT_EQ(mip[1][0], 160); // (0.5 * 100 + 150 + 200) / 2.5
}

TEST(MipChain, keepsTheEnergy)
{
    for (const auto& [width, height] : kSizes)
    {
        const ImageRecord image = makeRecord(width, height);
        std::vector<std::byte> texels = randomBytes(size_t{width} * height * 4, width * 31 + height);
        for (size_t at = 3; at < texels.size(); at += 4)
            texels[at] = std::byte{255};
        const std::vector<std::byte> chain = buildMipChain(image, texels);
        for (size_t channel = 0; channel < 3; ++channel)
        {
            const double finest = linearMean(decodeMip(image, chain, 0), channel);
            for (uint32_t mip = 1; mip < fullMipCount(width, height); ++mip)
                // half a step of 8 bits, where the curve is steepest
                EXPECT_NEAR(linearMean(decodeMip(image, chain, mip), channel), finest, 0.5 / 255 * 2.3);
        }
    }
}

TEST(MipChain, keepsTheMeanOfDataAndAlpha)
{
    const ImageRecord image = makeRecord(61, 37, TexelFormat::rgba8_unorm);
    const std::vector<std::byte> chain = buildMipChain(image, randomBytes(61 * 37 * 4, 5));
    for (size_t channel = 0; channel < 4; ++channel)
        for (uint32_t mip = 1; mip < fullMipCount(61, 37); ++mip)
            EXPECT_NEAR(mean(decodeMip(image, chain, mip), channel),
                        mean(decodeMip(image, chain, 0), channel), 0.5);
}

TEST(MipChain, whatIsTransparentDoesNotBleed)
{
    // green leaves on transparent black
    std::vector<std::byte> texels = filled(8, 8, {0, 0, 0, 0});
    for (size_t i = 0; i < 64; i += 3)
        std::copy_n(filled(1, 1, {30, 200, 40, 255}).begin(), 4,
                    texels.begin() + static_cast<std::ptrdiff_t>(i * 4));
    const ImageRecord image = makeRecord(8, 8);
    const std::vector<std::byte> chain = buildMipChain(image, texels);
    for (uint32_t mip = 1; mip < 4; ++mip)
        for (const Rgba8& texel : decodeMip(image, chain, mip))
        {
            if (texel[3] == 0)
                continue;
            EXPECT_EQ((Rgba8{texel[0], texel[1], texel[2], 0}), (Rgba8{30, 200, 40, 0}));
        }
    EXPECT_NEAR(decodeMip(image, chain, 3)[0][3], 255.0 * 22 / 64, 1);
}

TEST(MipChain, whereAllIsTransparentTheColourIsThePlainMean)
{
    std::vector<std::byte> texels = filled(2, 1, {0, 0, 0, 0});
    texels[4] = std::byte{255};
    const ImageRecord image = makeRecord(2, 1);
    EXPECT_EQ(decodeMip(image, buildMipChain(image, texels), 1)[0], (Rgba8{188, 0, 0, 0}));
}

Float3 getDirection(const Rgba8& texel)
{
    const auto component = [](uint8_t value) { return static_cast<float>(value) / 127.5f - 1; };
    return {component(texel[0]), component(texel[1]), component(texel[2])};
}

TEST(MipChain, normalsAreDirectionsAndUnit)
{
    const ImageRecord image = makeRecord(33, 20, TexelFormat::rgba8_unorm, formats::kImageNormalMap);
    const std::vector<std::byte> chain = buildMipChain(image, randomBytes(33 * 20 * 4, 9));
    for (uint32_t mip = 1; mip < fullMipCount(33, 20); ++mip)
        for (const Rgba8& texel : decodeMip(image, chain, mip))
            EXPECT_NEAR(length(getDirection(texel)), 1, 0.01);
}

TEST(MipChain, normalsThatLeanApartMeetInTheMiddle)
{
    // 45 degrees to the left and to the right, the left one with a shorter vector: length must not matter
    std::vector<std::byte> texels = filled(2, 1, {128 + 90, 128, 128 + 90, 255});
    const Rgba8 left = {128 - 45, 128, 128 + 45, 255};
    for (size_t c = 0; c < 4; ++c)
        texels[4 + c] = std::byte{left[c]};
    const ImageRecord image = makeRecord(2, 1, TexelFormat::rgba8_unorm, formats::kImageNormalMap);
    const Float3 direction = getDirection(decodeMip(image, buildMipChain(image, texels), 1)[0]);
    EXPECT_NEAR(direction.x, 0, 0.01);
    EXPECT_NEAR(direction.z, 1, 0.01);
}

TEST(MipChain, opposedNormalsGiveTheFlatOne)
{
    std::vector<std::byte> texels = filled(2, 1, {255, 127, 127, 255});
    texels[4] = std::byte{0};
    texels[5] = texels[6] = std::byte{128};
    const ImageRecord image = makeRecord(2, 1, TexelFormat::rgba8_unorm, formats::kImageNormalMap);
    EXPECT_EQ(decodeMip(image, buildMipChain(image, texels), 1)[0], (Rgba8{128, 128, 255, 255}));
}

TEST(MipChain, floatImagesKeepTheirRange)
{
    const std::array<uint16_t, 8> half = {halfFromFloat(60000), halfFromFloat(0.25f), halfFromFloat(-1),
                                          halfFromFloat(1),     halfFromFloat(0),     halfFromFloat(0.75f),
                                          halfFromFloat(-2),    halfFromFloat(0)};
    std::vector<std::byte> texels(sizeof(half));
    std::memcpy(texels.data(), half.data(), sizeof(half));
    const std::vector<std::byte> chain = buildMipChain(makeRecord(2, 1, TexelFormat::rgba16_float), texels);
    ASSERT_EQ(chain.size(), 24u);
    std::array<uint16_t, 4> mip;
    std::memcpy(mip.data(), chain.data() + 16, sizeof(mip));
    EXPECT_EQ(floatFromHalf(mip[0]), 30000);
    EXPECT_EQ(floatFromHalf(mip[1]), 0.5f);
    EXPECT_EQ(floatFromHalf(mip[2]), -1.5f);
    EXPECT_EQ(floatFromHalf(mip[3]), 0.5f);
}

TEST(MipChain, sameBytesForAnyNumberOfThreads)
{
    const ImageRecord image = makeRecord(301, 203, TexelFormat::rgba8_srgb, formats::kImageAlphaTested);
    const std::vector<std::byte> texels = randomBytes(301 * 203 * 4, 3);
    std::vector<std::vector<std::byte>> chains;
    for (const size_t threads : {1u, 2u, 7u})
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        chains.push_back(buildMipChain(image, texels));
    }
    EXPECT_EQ(chains[0], chains[1]);
    EXPECT_EQ(chains[0], chains[2]);
}

} // namespace

} // namespace hearth::textures
