// Tests that every texel of a TIFF arrives as its file has it, whatever the layout of the file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_images/images_fixture.h"

#include "formats/base/half.h"

#include <bit>
#include <cmath>

namespace hearth::test
{

namespace
{

constexpr auto kTiff = images::Format::tiff;

/// Return an image of 5 x 3 texels with samples that all differ, in its lower `bits`.
TiffImage makeImage(uint32_t channel_count, uint32_t bits = 8)
{
    TiffImage image{.width = 5, .height = 3, .bits = bits, .samples = {}, .channel_count = channel_count};
    image.photometric = channel_count < 3 ? 1 : 2;
    const uint64_t mask = (uint64_t{1} << bits) - 1;
    for (uint64_t i = 0; i < 15 * channel_count; ++i)
        image.samples.push_back((i * 4021 + 17) & mask);
    return image;
}

/// Return what is expected of grey or RGB, with or without alpha.
Numbers expectedTexels(const TiffImage& image, bool has_alpha)
{
    const uint32_t colors = image.channel_count - (has_alpha ? 1 : 0);
    Numbers texels;
    for (size_t i = 0; i < image.samples.size(); i += image.channel_count)
    {
        for (uint32_t c = 0; c < 3; ++c)
            texels.push_back(static_cast<uint32_t>(image.samples[i + std::min(c, colors - 1)]));
        texels.push_back(has_alpha ? static_cast<uint32_t>(image.samples[i + colors])
                                   : (1u << image.bits) - 1);
    }
    return texels;
}

TEST(TiffImages, keepTheirNumbers)
{
    for (const bool is_big_endian : {false, true})
        for (const uint32_t bits : {8u, 16u})
            for (const uint32_t channels : {1u, 2u, 3u, 4u})
            {
                SCOPED_TRACE(std::to_string(bits) + " bits, channels " + std::to_string(channels));
                TiffImage image = makeImage(channels, bits);
                const bool has_alpha = channels % 2 == 0;
                if (has_alpha)
                    image.extra = {2};
                expectTexels(kTiff, makeTiff({image}, is_big_endian), expectedTexels(image, has_alpha));
            }
}

TEST(TiffImages, mayBeTiledOrPlanar)
{
    for (const bool is_tiled : {false, true})
        for (const bool is_planar : {false, true})
        {
            TiffImage image = makeImage(3, 16);
            image.is_tiled = is_tiled;
            image.is_planar = is_planar;
            image.width = 35;
            image.height = 18;
            image.samples.clear();
            for (uint64_t i = 0; i < 35 * 18 * 3; ++i)
                image.samples.push_back(i * 31 & 0xFFFF);
            expectTexels(kTiff, makeTiff({image}), expectedTexels(image, false));
        }
}

TEST(TiffImages, areTheFirstOfTheFile)
{
    const TiffImage first = makeImage(3);
    TiffImage mip = first;
    mip.width = 1;
    mip.height = 1;
    mip.samples = {1, 2, 3};
    expectTexels(kTiff, makeTiff({first, mip}), expectedTexels(first, false));
}

TEST(TiffImages, loseTheAlphaThatMultipliesThem)
{
    TiffImage image{.width = 256, .height = 1, .bits = 8, .samples = {}, .channel_count = 4};
    image.extra = {1};
    Numbers expected;
    for (uint32_t alpha = 0; alpha < 256; ++alpha)
    {
        const uint32_t colors[3] = {0, alpha / 2, alpha};
        for (const uint32_t color : colors)
        {
            image.samples.push_back(color);
            const double straight = alpha == 0 ? color : color * 255.0 / alpha;
            expected.push_back(static_cast<uint32_t>(std::floor(straight + 0.5)));
        }
        image.samples.push_back(alpha);
        expected.push_back(alpha);
    }
    expectTexels(kTiff, makeTiff({image}), expected);
}

TEST(TiffImages, sayWhichChannelsAreNotKept)
{
    TiffImage image = makeImage(4);
    image.extra = {0};
    Numbers expected = expectedTexels(image, true);
    for (size_t i = 3; i < expected.size(); i += 4)
        expected[i] = 255;
    expectTexels(kTiff, makeTiff({image}), expected, {"W1305 channels beside the image are not kept: 1"});
}

TEST(TiffImages, mayHaveFewBits)
{
    TiffImage image{.width = 5, .height = 1, .bits = 1, .photometric = 1, .samples = {0, 1, 1, 0, 1}};
    image.channel_count = 1;
    const auto expect = [&](const Numbers& grey)
    {
        Numbers expected;
        for (const uint32_t value : grey)
            expected.insert(expected.end(), {value, value, value, 255});
        expectTexels(kTiff, makeTiff({image}), expected);
    };
    expect({0, 255, 255, 0, 255});
    image.photometric = 0;
    expect({255, 0, 0, 255, 0});
    image.bits = 4;
    image.photometric = 1;
    image.samples = {0, 1, 7, 8, 15};
    expect({0, 17, 119, 136, 255});
    image.bits = 8;
    image.photometric = 0;
    expect({255, 254, 248, 247, 240});
}

TEST(TiffImages, mayHaveAPalette)
{
    TiffImage image{.width = 3, .height = 1, .bits = 8, .photometric = 3, .samples = {2, 0, 255}};
    image.channel_count = 1;
    for (uint32_t c = 0; c < 3; ++c)
        for (uint32_t i = 0; i < 256; ++i)
            image.palette.push_back((c == 0 ? i : c == 1 ? 255 - i : i / 2) * 257);
    expectTexels(kTiff, makeTiff({image}), {2, 253, 1, 255, 0, 255, 0, 255, 255, 0, 127, 255});
}

TEST(TiffImages, keepFloatsAsHalves)
{
    TiffImage image{.width = 2, .height = 1, .bits = 32, .sample_format = 3, .samples = {}};
    Numbers expected;
    for (const float value : {0.1f, -2.5f, 1e9f, std::nanf(""), 0.0f, 65504.0f})
    {
        image.samples.push_back(std::bit_cast<uint32_t>(value));
        expected.push_back(halfFromFloat(value));
        if (expected.size() % 4 == 3)
            expected.push_back(halfFromFloat(1));
    }
    expectTexels(kTiff, makeTiff({image}), expected,
                 {"W1306 its channels have 32 bits, 16 are kept, as floats"});
    image.bits = 16;
    for (size_t i = 0; i < image.samples.size(); ++i)
        image.samples[i] = 0x3000 + i;
    expectTexels(kTiff, makeTiff({image}), {0x3000, 0x3001, 0x3002, 0x3C00, 0x3003, 0x3004, 0x3005, 0x3C00});
}

TEST(TiffImages, ofSignedNumbersAreRefused)
{
    TiffImage image = makeImage(3, 16);
    image.sample_format = 2;
    expectRefused(kTiff, makeTiff({image}), Issue::image_unsupported, "channels of type int16 are not read");
}

TEST(TiffImages, areTurnedAsTheirOrientationSays)
{
    // texel (x, y) is 10 y + x: the corner where row 0 and column 0 meet, and the ends of both
    struct Corners
    {
        uint32_t top_left, top_right, bottom_left;
    };
    constexpr Corners kExpected[] = {{0, 2, 10}, {2, 0, 12},  {12, 10, 2}, {10, 12, 0},
                                     {0, 10, 2}, {10, 0, 12}, {12, 2, 10}, {2, 12, 0}};
    TiffImage image{.width = 3, .height = 2, .photometric = 1, .samples = {0, 1, 2, 10, 11, 12}};
    image.channel_count = 1;
    for (uint32_t orientation = 1; orientation <= 8; ++orientation)
    {
        SCOPED_TRACE(orientation);
        image.orientation = orientation;
        const auto decoded = decode(kTiff, makeTiff({image}));
        ASSERT_TRUE(decoded.ok()) << formatMessage(decoded.error());
        EXPECT_EQ(decoded->width, orientation < 5 ? 3u : 2u);
        const Numbers texels = listChannels(*decoded);
        const Corners& expected = kExpected[orientation - 1];
        EXPECT_EQ(texels[0], expected.top_left);
        EXPECT_EQ(texels[4 * (decoded->width - 1)], expected.top_right);
        EXPECT_EQ(texels[4 * decoded->width * (decoded->height - 1)], expected.bottom_left);
    }
}

TEST(TiffImages, ofInkBecomeRgb)
{
    const Notes guess{"W1307 it is CMYK without a usable ICC profile: its colours are a guess"};
    for (const uint32_t bits : {8u, 16u})
    {
        TiffImage image = makeImage(4, bits);
        image.photometric = 5;
        const double max = (1 << bits) - 1;
        Numbers expected;
        for (size_t i = 0; i < image.samples.size(); i += 4)
        {
            for (size_t c = 0; c < 3; ++c)
            {
                const double light = (1 - static_cast<double>(image.samples[i + c]) / max) *
                                     (1 - static_cast<double>(image.samples[i + 3]) / max);
                expected.push_back(static_cast<uint32_t>(std::floor(light * max + 0.5)));
            }
            expected.push_back(static_cast<uint32_t>(max));
        }
        expectTexels(kTiff, makeTiff({image}), expected, guess);
    }
}

TEST(TiffImages, areCheckedAgainstTheLimits)
{
    const std::string file = makeTiff({makeImage(3)});
    import::ImportLimits limits;
    limits.max_image_texels = 14;
    const auto image = decode(kTiff, file, {}, limits);
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().issue, Issue::input_too_large) << formatMessage(image.error());
    EXPECT_EQ(image.error().detail,
              "the image is 5 x 3 texels; at most 14 in all and 16384 on a side are read");
}

} // namespace

} // namespace hearth::test
