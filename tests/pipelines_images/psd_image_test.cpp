// Tests that the composite of a Photoshop file arrives as the file has it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_images/images_fixture.h"

#include "formats/base/half.h"

#include <bit>
#include <cmath>

namespace hearth::test
{

namespace
{

constexpr auto kPsd = images::Format::psd;
constexpr uint32_t kWidth = 40, kHeight = 3;

/// Return an image with samples of `bits` bits, and runs of equal ones.
PsdImage makeImage(uint32_t mode, uint32_t channel_count, uint32_t depth = 8)
{
    PsdImage image{.width = kWidth, .height = kHeight, .depth = depth, .mode = mode, .samples = {}};
    image.channel_count = channel_count;
    for (uint64_t i = 0; i < kWidth * kHeight * channel_count; ++i)
        image.samples.push_back(((i % 40 < 20 ? i / 7 : i) * 4021 + 17) & ((uint64_t{1} << depth) - 1));
    return image;
}

/// Return the sample of a channel of texel `i`.
uint32_t sampleAt(const PsdImage& image, size_t channel, size_t i)
{
    return static_cast<uint32_t>(image.samples[channel * kWidth * kHeight + i]);
}

TEST(PsdImages, keepTheirNumbers)
{
    for (const bool is_packed : {false, true})
        for (const bool is_big : {false, true})
            for (const uint32_t depth : {8u, 16u})
                for (const uint32_t mode : {1u, 3u})
                {
                    PsdImage image = makeImage(mode, mode, depth);
                    image.is_packed = is_packed;
                    image.is_big = is_big;
                    image.has_composite = true;
                    Numbers expected;
                    for (size_t i = 0; i < kWidth * kHeight; ++i)
                        for (uint32_t c = 0; c < 4; ++c)
                            expected.push_back(c == 3 ? (1u << depth) - 1
                                                      : sampleAt(image, std::min(c, mode - 1), i));
                    expectTexels(kPsd, makePsd(image), expected);
                }
}

TEST(PsdImages, loseTheWhiteBehindThem)
{
    // the composite of a layer with colour c and alpha a on white: c a + 255 (1 - a)
    PsdImage image{.width = 256, .height = 1, .channel_count = 4, .samples = {}, .has_transparency = true};
    Numbers expected(4 * 256);
    image.samples.resize(4 * 256);
    for (uint32_t alpha = 0; alpha < 256; ++alpha)
        for (uint32_t c = 0; c < 4; ++c)
        {
            const uint32_t color = c * 90;
            const double composite = (color * alpha + 255.0 * (255 - alpha)) / 255;
            const auto stored = static_cast<uint32_t>(std::floor(composite + 0.5));
            image.samples[c * 256 + alpha] = c == 3 ? alpha : stored;
            const double straight = (stored - 255.0 + alpha) * 255 / std::max(alpha, 1u);
            expected[4 * alpha + c] =
                c == 3 ? alpha : static_cast<uint32_t>(std::floor(std::clamp(straight, 0.0, 255.0) + 0.5));
        }
    expectTexels(kPsd, makePsd(image), expected);
    EXPECT_NEAR(expected[4 * 200 + 1], 90u, 1); // the layer's colour, but for the composite's rounding
    EXPECT_EQ(expected[4 * 255 + 2], 180u);
}

TEST(PsdImages, sayWhichChannelsAreNotKept)
{
    PsdImage image = makeImage(1, 3);
    Numbers expected;
    for (size_t i = 0; i < kWidth * kHeight; ++i)
        expected.insert(expected.end(),
                        {sampleAt(image, 0, i), sampleAt(image, 0, i), sampleAt(image, 0, i), 255});
    expectTexels(kPsd, makePsd(image), expected, {"W1305 channels beside the image are not kept: 2"});
}

TEST(PsdImages, keepFloatsAsHalves)
{
    PsdImage image = makeImage(3, 3, 32);
    Numbers expected;
    for (size_t i = 0; i < image.samples.size(); ++i)
        image.samples[i] = std::bit_cast<uint32_t>(static_cast<float>(i) * 0.37f - 3);
    for (size_t i = 0; i < kWidth * kHeight; ++i)
        for (size_t c = 0; c < 4; ++c)
            expected.push_back(c == 3 ? 0x3C00u : halfFromFloat(std::bit_cast<float>(sampleAt(image, c, i))));
    expectTexels(kPsd, makePsd(image), expected, {"W1306 its channels have 32 bits, 16 are kept, as floats"});
}

TEST(PsdImages, mayHaveAPaletteOrBits)
{
    PsdImage indexed = makeImage(2, 1);
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 256; ++i)
            indexed.palette += static_cast<char>(c == 0 ? i : c == 1 ? 255 - i : i / 2);
    Numbers expected;
    for (const uint64_t index : indexed.samples)
    {
        const auto i = static_cast<uint32_t>(index);
        expected.insert(expected.end(), {i, 255 - i, i / 2, 255});
    }
    expectTexels(kPsd, makePsd(indexed), expected);

    PsdImage bitmap{.width = 10, .height = 1, .depth = 1, .mode = 0, .channel_count = 1};
    bitmap.samples = {0b10100000, 0b01000000};
    expected.clear();
    for (const uint32_t grey : {0u, 255u, 0u, 255u, 255u, 255u, 255u, 255u, 255u, 0u})
        expected.insert(expected.end(), {grey, grey, grey, 255});
    expectTexels(kPsd, makePsd(bitmap), expected);
}

TEST(PsdImages, ofInkBecomeRgbAndKeepTheirAlpha)
{
    // stored as light: 255 is no ink
    PsdImage image = makeImage(4, 5);
    image.has_transparency = true;
    for (size_t i = 0; i < kWidth * kHeight; ++i)
        image.samples[4 * kWidth * kHeight + i] = 255;
    Numbers expected;
    for (size_t i = 0; i < kWidth * kHeight; ++i)
        for (size_t c = 0; c < 4; ++c)
            expected.push_back(c == 3 ? 255u
                                      : (sampleAt(image, c, i) * sampleAt(image, 3, i) * 2 + 255) / 510);
    const Notes guess{"W1307 it is CMYK without a usable ICC profile: its colours are a guess"};
    expectTexels(kPsd, makePsd(image), expected, guess);

    // full cyan of alpha 51 on white: light 255 - 51 in the red channel
    PsdImage cyan{
        .width = 1, .height = 1, .mode = 4, .channel_count = 5, .samples = {204, 255, 255, 255, 51}};
    cyan.has_transparency = true;
    expectTexels(kPsd, makePsd(cyan), {0, 255, 255, 51}, guess);
}

TEST(PsdImages, areRefusedWithTheRemedy)
{
    PsdImage image = makeImage(3, 3);
    image.has_composite = false;
    expectRefused(kPsd, makePsd(image), Issue::image_unsupported,
                  "it has no composite image: save it with 'Maximise compatibility'");
    expectRefused(kPsd, makePsd(makeImage(9, 3)), Issue::image_unsupported, "convert it to RGB");
    std::string file = makePsd(makeImage(3, 3));
    file[5] = 3;
    expectRefused(kPsd, file, Issue::image_unsupported, "version 3 is not read");
    file[5] = 1;
    file.pop_back();
    expectRefused(kPsd, file, Issue::image_malformed, "the file ends too early");
}

} // namespace

} // namespace hearth::test
