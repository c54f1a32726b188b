// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "cook/textures/texture_statistics.h"

#include "cook/textures/mip_chain.h"
#include "tests/textures/texture_test_images.h"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace hearth::textures
{

namespace
{

using namespace test;
using namespace formats;
using Bytes = std::vector<std::byte>;

/// RGBA8 texels, each grey.
Bytes greys(std::initializer_list<std::pair<int, int>> values_and_alphas)
{
    Bytes bytes;
    for (const auto& [value, alpha] : values_and_alphas)
        for (const int channel : {value, value, value, alpha})
            bytes.push_back(static_cast<std::byte>(channel));
    return bytes;
}

ImageRecord withMips(ImageRecord image)
{
    image.mip_count = fullMipCount(image.width, image.height);
    return image;
}

} // namespace

TEST(MipError, isNothingForOneColour)
{
    const ImageRecord image = withMips(makeRecord(2, 2, TexelFormat::rgba8_unorm));
    const Bytes texels = greys({{7, 255}, {7, 255}, {7, 255}, {7, 255}});
    EXPECT_EQ(mipError(image, buildMipChain(image, texels), 1), 0);
    EXPECT_EQ(mipError(image, buildMipChain(image, randomBytes(2 * 2 * 4, 1)), 0), 0) << "the finest itself";
}

TEST(MipError, isTheDifferenceFromTheMean)
{
    // the mean is 100: each texel is 20 off in three of its four channels
    const ImageRecord image = withMips(makeRecord(2, 1, TexelFormat::rgba8_unorm));
    const Bytes texels = greys({{80, 255}, {120, 255}});
    EXPECT_NEAR(mipError(image, buildMipChain(image, texels), 1), 20.0 / 255 * std::sqrt(3.0 / 4), 1e-12);
}

TEST(MipError, doesNotSeeTheColourOfWhatIsCutAway)
{
    const ImageRecord image = withMips(makeRecord(2, 1, TexelFormat::rgba8_srgb));
    const auto error = [&](int hidden) {
        return mipError(image, buildMipChain(image, greys({{200, 255}, {hidden, 0}})), 1);
    };
    EXPECT_NEAR(error(0), error(255), 2e-3);
    EXPECT_GT(error(0), 0.4);
}

TEST(MipError, stretchesSizesThatAreNotEven)
{
    // slow reference: the whole of 5 x 3 on 2 x 1
    const ImageRecord image = withMips(makeRecord(5, 3, TexelFormat::rgba8_unorm));
    const Bytes chain = buildMipChain(image, randomBytes(5 * 3 * 4, 3));
    double sum = 0;
    for (size_t y = 0; y < 3; ++y)
        for (size_t x = 0; x < 5; ++x)
            for (size_t c = 0; c < 4; ++c)
            {
                const auto value = [&](size_t texel)
                { return std::to_integer<int>(chain[texel * 4 + c]) / 255.0; };
                const size_t half = x < 3 ? 15 : 16;
                sum += std::pow(value(y * 5 + x) - value(half), 2) / (15 * 4);
            }
    EXPECT_NEAR(mipError(image, chain, 1), std::sqrt(sum), 1e-12);
}

TEST(MipError, isMeasuredAgainstAllBitsOfTheSource)
{
    // grey of 100.25 steps of 8 bits, stored as 100; and without a loss
    ImageRecord image = withMips(makeRecord(1, 1, TexelFormat::rgba8_srgb));
    const auto error = [&](uint16_t grey)
    {
        const std::array<uint16_t, 4> texel{grey, grey, grey, 65535};
        Bytes imported(sizeof(texel));
        std::memcpy(imported.data(), texel.data(), sizeof(texel));
        ImageRecord wide = makeRecord(1, 1, TexelFormat::rgba16_srgb);
        return mipError(image, buildMipChain(wide, imported), 0, imported);
    };
    EXPECT_EQ(error(100 * 257), 0);
    EXPECT_NEAR(error(100 * 257 + 64), 64.0 / 65535 * std::sqrt(3.0 / 4), 1e-12);
}

TEST(MipError, ofSixteenBitsIsTheDifferenceFromTheMean)
{
    const ImageRecord image = withMips(makeRecord(2, 1, TexelFormat::rgba16_unorm));
    const std::array<uint16_t, 8> channels{1000, 1000, 1000, 65535, 1040, 1040, 1040, 65535};
    Bytes texels(sizeof(channels));
    std::memcpy(texels.data(), channels.data(), sizeof(channels));
    const Bytes chain = buildMipChain(image, texels);
    EXPECT_EQ(mipError(image, chain, 0), 0);
    EXPECT_NEAR(mipError(image, chain, 1), 20.0 / 65535 * std::sqrt(3.0 / 4), 1e-12);
}

TEST(TextureStatistics, sayWhatBecameOfAnImage)
{
    ImageStatistics image;
    image.name = "bark";
    image.uses = {{"Oak", "baseColor"}, {"", "emissive"}};
    image.image = withMips(makeRecord(4, 2, TexelFormat::rgba8_srgb));
    image.bytes = 44;
    image.stored_bytes = 40;
    image.error = 0;
    image.half_error = 0.01;
    const auto json = Json::parse(statisticsJson("tree.part", {&image, 1})).value();
    EXPECT_EQ(json["schema"], "hearth.textures/1");
    const auto& bark = json["images"][0];
    EXPECT_EQ(bark["name"], "bark");
    EXPECT_EQ(bark["uses"], Json::parse(R"([{"material": "Oak", "role": "baseColor"},
                                                     {"material": "", "role": "emissive"}])")
                                .value());
    EXPECT_EQ(bark["width"], 4);
    EXPECT_EQ(bark["mips"], 3);
    EXPECT_EQ(bark["format"], "rgba8-srgb");
    EXPECT_EQ(bark["content"], "color");
    EXPECT_EQ(bark["bytes_stored"], 40);
    EXPECT_TRUE(bark["error"]["psnr_db"].is_null()) << "nothing differs";
    EXPECT_NEAR(bark["half_size_error"]["psnr_db"].get<double>(), 40, 1e-9);
}

} // namespace hearth::textures
