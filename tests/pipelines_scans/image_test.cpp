// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "pipelines/import/images/channels.h"
#include "pipelines/import/images/decode.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "tests/pipelines_scans/frozen_images.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

namespace hearth::import
{

namespace
{

using namespace hearth::test;

using Rgba8 = std::array<uint8_t, 4>;
using Bytes = std::vector<uint8_t>;

Result<DecodedImage> decode(const Bytes& bytes, const ImportLimits& limits = {})
{
    return decodeImage(std::as_bytes(std::span(bytes)), "image", limits);
}

DecodedImage decodeGood(const Bytes& bytes)
{
    auto image = decode(bytes);
    EXPECT_TRUE(image.ok()) << formatMessage(image.error());
    return image.ok() ? std::move(image).value() : DecodedImage{};
}

Rgba8 getTexel(const DecodedImage& image, size_t x, size_t y)
{
    Rgba8 texel{};
    std::memcpy(texel.data(), &image.texels.at((y * image.width + x) * 4), 4);
    return texel;
}

std::array<float, 4> getLight(const DecodedImage& image, size_t x, size_t y)
{
    std::array<uint16_t, 4> half{};
    std::memcpy(half.data(), &image.texels.at((y * image.width + x) * 8), 8);
    return {floatFromHalf(half[0]), floatFromHalf(half[1]), floatFromHalf(half[2]), floatFromHalf(half[3])};
}

Rgba8 pattern(size_t x, size_t y)
{
    return {static_cast<uint8_t>(x * 50), static_cast<uint8_t>(y * 100), static_cast<uint8_t>(200 - x * 30),
            static_cast<uint8_t>(255 - x * 20)};
}

template <typename Check>
void forEachTexel(const DecodedImage& image, Check check)
{
    ASSERT_EQ(image.width, 5u);
    ASSERT_EQ(image.height, 3u);
    for (size_t y = 0; y < 3; ++y)
        for (size_t x = 0; x < 5; ++x)
            check(x, y);
}

void expectNear(Rgba8 texel, Rgba8 expected, int tolerance)
{
    for (size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(texel[c], expected[c], tolerance);
}

/// Check that any shorter file is rejected, without reading past its end.
void expectRefusedWhenCut(const Bytes& bytes, size_t longest)
{
    ASSERT_TRUE(decode(bytes).ok());
    for (size_t size = 0; size <= longest; ++size)
    {
        const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        ASSERT_FALSE(decode(cut).ok()) << size;
    }
}

TEST(DecodePng, readsEveryKindAsRgba8)
{
    const DecodedImage rgba = decodeGood(kPngRgba8);
    forEachTexel(rgba, [&](size_t x, size_t y) { EXPECT_EQ(getTexel(rgba, x, y), pattern(x, y)); });
    const DecodedImage rgb16 = decodeGood(kPngRgb16Interlaced);
    forEachTexel(rgb16,
                 [&](size_t x, size_t y)
                 {
                     Rgba8 expected = pattern(x, y);
                     expected[3] = 255;
                     EXPECT_EQ(getTexel(rgb16, x, y), expected);
                 });
    const DecodedImage grey = decodeGood(kPngGrey8);
    const auto level = [](size_t y) { return static_cast<uint8_t>(y * 100); };
    forEachTexel(grey,
                 [&](size_t x, size_t y) {
                     EXPECT_EQ(getTexel(grey, x, y), (Rgba8{level(y), level(y), level(y), 255}));
                 });
    const DecodedImage palette = decodeGood(kPngPalette2);
    EXPECT_EQ(getTexel(palette, 0, 0), (Rgba8{10, 20, 30, 0}));
    EXPECT_EQ(getTexel(palette, 1, 0), (Rgba8{40, 50, 60, 128}));
    EXPECT_EQ(getTexel(palette, 3, 2), (Rgba8{100, 110, 120, 255}));
    EXPECT_EQ(getTexel(palette, 4, 1), (Rgba8{40, 50, 60, 128}));
}

std::array<uint16_t, 4> getWideTexel(const DecodedImage& image, size_t x, size_t y)
{
    std::array<uint16_t, 4> texel{};
    std::memcpy(texel.data(), &image.texels.at((y * image.width + x) * 8), 8);
    return texel;
}

TEST(DecodePng, keepsSixteenBitsThatSayMoreThanEight)
{
    const DecodedImage rgba = decodeGood(kPngRgba16);
    ASSERT_EQ(rgba.type, ChannelType::unorm16);
    const auto number = [](size_t value) { return static_cast<uint16_t>(value); };
    forEachTexel(rgba,
                 [&](size_t x, size_t y)
                 {
                     const std::array<uint16_t, 4> expected{number(1000 * x + 1), number(2000 * y + 2),
                                                            number(30000 + x + 3 * y), number(65535 - 7 * x)};
                     EXPECT_EQ(getWideTexel(rgba, x, y), expected);
                 });
    const DecodedImage grey = decodeGood(kPngGrey16);
    ASSERT_EQ(grey.type, ChannelType::unorm16);
    forEachTexel(
        grey,
        [&](size_t x, size_t y)
        {
            const uint16_t value = number(4000 * x + y);
            EXPECT_EQ(getWideTexel(grey, x, y), (std::array<uint16_t, 4>{value, value, value, 65535}));
        });
    EXPECT_EQ(decodeGood(kPngRgb16Interlaced).type, ChannelType::unorm8)
        << "its second bytes say nothing new";
    expectRefusedWhenCut(kPngRgba16, kPngRgba16.size() - 1);
}

TEST(Channels, areConvertedToTheNearestAndBack)
{
    DecodedImage wide{1, 4, ChannelType::unorm16, {}};
    const std::array<uint16_t, 16> channels{0,   128,   129,   257,   385,   386,   32767, 32768,
                                            514, 65535, 65406, 65407, 65278, 25700, 1,     65534};
    wide.texels.resize(sizeof(channels));
    std::memcpy(wide.texels.data(), channels.data(), sizeof(channels));
    const DecodedImage narrowed = narrow(wide);
    ASSERT_EQ(narrowed.texels.size(), channels.size());
    for (size_t i = 0; i < channels.size(); ++i)
        EXPECT_EQ(std::to_integer<long>(narrowed.texels[i]), std::lround(channels[i] * 255.0 / 65535.0))
            << channels[i];
    const DecodedImage widened = widen(narrowed);
    EXPECT_EQ(widened.type, ChannelType::unorm16);
    EXPECT_EQ(narrow(widened).texels, narrowed.texels);
    EXPECT_EQ(dropEmptyBits(widened).texels, narrowed.texels);
    EXPECT_EQ(dropEmptyBits(wide).texels, wide.texels);
    EXPECT_TRUE(hasAlpha(wide));
    EXPECT_FALSE(isGrey(wide));
    EXPECT_TRUE(isGrey(decodeGood(kPngGrey16)));
    EXPECT_FALSE(hasAlpha(decodeGood(kPngGrey16)));
    EXPECT_TRUE(isGrey(decodeGood(kPngGrey8)));
}

TEST(DecodePng, refusesCutAndDamagedFiles)
{
    expectRefusedWhenCut(kPngRgba8, kPngRgba8.size() - 1);
    // the header and the data have checksums: no bit may change
    for (size_t at = 0; at < kPngRgba8.size(); ++at)
    {
        Bytes damaged = kPngRgba8;
        damaged[at] ^= 0x10;
        EXPECT_FALSE(decode(damaged).ok()) << at;
    }
}

TEST(DecodeJpeg, readsBaselineProgressiveAndGrey)
{
    for (const Bytes& bytes : {kJpegBaseline, kJpegProgressive})
    {
        const DecodedImage image = decodeGood(bytes);
        forEachTexel(image,
                     [&](size_t x, size_t y) {
                         expectNear(getTexel(image, x, y), {180, 90, 40, 255}, 2);
                     });
    }
    const DecodedImage grey = decodeGood(kJpegGrey);
    forEachTexel(grey, [&](size_t x, size_t y) { expectNear(getTexel(grey, x, y), {77, 77, 77, 255}, 1); });
}

TEST(DecodeJpeg, convertsInkAsAdobeStoresIt)
{
    // 255 is no ink: 200 / 255 of red and 128 / 255 of what black leaves
    const DecodedImage image = decodeGood(kJpegCmyk);
    forEachTexel(image,
                 [&](size_t x, size_t y) {
                     expectNear(getTexel(image, x, y), {100, 50, 25, 255}, 2);
                 });
}

TEST(DecodeJpeg, refusesCutFiles)
{
    expectRefusedWhenCut(kJpegBaseline, kJpegBaseline.size() - 3); // libjpeg supplies a missing end marker
    expectRefusedWhenCut(kJpegProgressive, kJpegProgressive.size() - 3);
}

TEST(DecodeWebp, readsLosslessAndLossy)
{
    const DecodedImage lossless = decodeGood(kWebpLossless);
    forEachTexel(lossless, [&](size_t x, size_t y) { EXPECT_EQ(getTexel(lossless, x, y), pattern(x, y)); });
    const DecodedImage lossy = decodeGood(kWebpLossy);
    // chroma has half the resolution; alpha has no loss
    forEachTexel(lossy, [&](size_t x, size_t y) { EXPECT_EQ(getTexel(lossy, x, y)[3], pattern(x, y)[3]); });
}

TEST(DecodeWebp, refusesCutFiles)
{
    expectRefusedWhenCut(kWebpLossless, kWebpLossless.size() - 3);
    expectRefusedWhenCut(kWebpLossy, kWebpLossy.size() / 2);
}

/// A TGA of 2 x 2 texels; 24 bits and from the bottom left unless the header is changed.
Bytes tga(uint8_t type, uint8_t depth, uint8_t descriptor, const Bytes& body)
{
    Bytes bytes(18 + body.size());
    bytes[2] = type;
    bytes[12] = 2;
    bytes[14] = 2;
    bytes[16] = depth;
    bytes[17] = descriptor;
    std::copy(body.begin(), body.end(), bytes.begin() + 18);
    return bytes;
}

TEST(DecodeTga, readsAllFourOrigins)
{
    // the stored order is 1 2 3 4
    const Bytes body = {1, 2, 3, 4};
    const auto order = [&](uint8_t descriptor)
    {
        const DecodedImage image = decodeGood(tga(3, 8, descriptor, body));
        return std::array<int, 4>{getTexel(image, 0, 0)[0], getTexel(image, 1, 0)[0],
                                  getTexel(image, 0, 1)[0], getTexel(image, 1, 1)[0]};
    };
    EXPECT_EQ(order(0x00), (std::array{3, 4, 1, 2}));
    EXPECT_EQ(order(0x10), (std::array{4, 3, 2, 1}));
    EXPECT_EQ(order(0x20), (std::array{1, 2, 3, 4}));
    EXPECT_EQ(order(0x30), (std::array{2, 1, 4, 3}));
}

TEST(DecodeTga, readsColoursGreyMapsAndRuns)
{
    const DecodedImage rgb = decodeGood(tga(2, 24, 0x20, {3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}));
    EXPECT_EQ(getTexel(rgb, 0, 0), (Rgba8{1, 2, 3, 255}));
    EXPECT_EQ(getTexel(rgb, 1, 1), (Rgba8{10, 11, 12, 255}));
    const DecodedImage rgba = decodeGood(tga(10, 32, 0x28, {0x82, 3, 2, 1, 77, 0x00, 9, 8, 7, 0}));
    EXPECT_EQ(getTexel(rgba, 0, 1), (Rgba8{1, 2, 3, 77}));
    EXPECT_EQ(getTexel(rgba, 1, 1), (Rgba8{7, 8, 9, 0}));
    const DecodedImage rgb555 =
        decodeGood(tga(2, 16, 0x20, {0x00, 0x7C, 0xE0, 0x03, 0x1F, 0x00, 0x10, 0x42}));
    EXPECT_EQ(getTexel(rgb555, 0, 0), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(getTexel(rgb555, 1, 0), (Rgba8{0, 255, 0, 255}));
    EXPECT_EQ(getTexel(rgb555, 1, 1), (Rgba8{132, 132, 132, 255}));
    Bytes mapped = tga(1, 8, 0x20, {30, 20, 10, 60, 50, 40, 5, 6, 6, 5});
    mapped[1] = 1; // a map that starts at index 5, with two entries of 24 bits
    mapped[3] = 5;
    mapped[5] = 2;
    mapped[7] = 24;
    const DecodedImage image = decodeGood(mapped);
    EXPECT_EQ(getTexel(image, 0, 0), (Rgba8{10, 20, 30, 255}));
    EXPECT_EQ(getTexel(image, 1, 0), (Rgba8{40, 50, 60, 255}));
    mapped.back() = 7;
    EXPECT_EQ(decode(mapped).error().issue, Issue::image_malformed);
}

/// Return four texels of 32 bits with an alpha of 0, and an extension area that says what alpha means.
Bytes tgaWithAttributes(uint8_t type, const Bytes& body = {3, 2, 1, 0, 6, 5, 4, 0, 9, 8, 7, 0, 12, 11, 10, 0})
{
    Bytes bytes = tga(2, 32, 0x28, body);
    const auto area = static_cast<uint8_t>(bytes.size());
    bytes.resize(bytes.size() + 495);
    bytes[area] = 495 & 0xFF;
    bytes[area + 1] = 495 >> 8;
    bytes.back() = type;
    bytes.insert(bytes.end(), {area, 0, 0, 0, 0, 0, 0, 0});
    const std::string_view signature("TRUEVISION-XFILE.\0", 18);
    bytes.insert(bytes.end(), signature.begin(), signature.end());
    return bytes;
}

TEST(DecodeTga, ignoresAlphaThatTheExtensionAreaCallsUndefined)
{
    for (const uint8_t type : {uint8_t{0}, uint8_t{1}, uint8_t{2}})
    {
        const DecodedImage image = decodeGood(tgaWithAttributes(type));
        EXPECT_EQ(getTexel(image, 0, 0), (Rgba8{1, 2, 3, 255}));
        EXPECT_EQ(getTexel(image, 1, 1), (Rgba8{10, 11, 12, 255}));
        ASSERT_EQ(image.notes.size(), 1u);
        EXPECT_EQ(image.notes[0].issue, Issue::image_alpha);
        EXPECT_EQ(image.notes[0].text, "alpha is not opacity, as attributes type " + std::to_string(type) +
                                           " of the TGA's extension area says: it is not kept");
    }
    const Bytes opaque = {3, 2, 1, 255, 6, 5, 4, 255, 9, 8, 7, 255, 12, 11, 10, 255};
    EXPECT_TRUE(decodeGood(tgaWithAttributes(0, opaque)).notes.empty()) << "nothing is lost";
}

TEST(DecodeTga, keepsAlphaOtherwise)
{
    for (const uint8_t type : {uint8_t{3}, uint8_t{4}})
    {
        const DecodedImage image = decodeGood(tgaWithAttributes(type));
        EXPECT_EQ(getTexel(image, 0, 0), (Rgba8{1, 2, 3, 0}));
        EXPECT_TRUE(image.notes.empty());
    }
    Bytes outside = tgaWithAttributes(0); // an area that does not lie in the file
    outside[outside.size() - 26 + 3] = 0xFF;
    EXPECT_EQ(getTexel(decodeGood(outside), 0, 0), (Rgba8{1, 2, 3, 0}));
    Bytes none = tgaWithAttributes(0);
    none[none.size() - 26] = 0;
    EXPECT_EQ(getTexel(decodeGood(none), 0, 0), (Rgba8{1, 2, 3, 0}));
}

TEST(DecodeTga, refusesCutFilesAndNoTexels)
{
    expectRefusedWhenCut(tga(2, 24, 0x20, Bytes(12)), 18 + 11);
    expectRefusedWhenCut(tga(10, 24, 0x20, {0x80, 1, 2, 3, 0x02, 1, 2, 3, 4, 5, 6, 7, 8, 9}), 18 + 13);
    Bytes none = tga(2, 24, 0x20, Bytes(12));
    none[12] = 0;
    EXPECT_EQ(decode(none).error().issue, Issue::image_malformed);
}

void append(Bytes& bytes, uint32_t value, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        bytes.push_back(i < sizeof(value) ? static_cast<uint8_t>(value >> (8 * i)) : uint8_t{0});
}

/// A BMP with a header of 40 bytes.
Bytes bmp(uint32_t width, uint32_t height, uint32_t depth, uint32_t compression, const Bytes& before,
          const Bytes& texels)
{
    Bytes bytes = {'B', 'M'};
    append(bytes, 0, 8);
    append(bytes, static_cast<uint32_t>(54 + before.size()), 4);
    append(bytes, 40, 4);
    append(bytes, width, 4);
    append(bytes, height, 4);
    append(bytes, 1, 2);
    append(bytes, depth, 2);
    append(bytes, compression, 4);
    append(bytes, 0, 12);
    append(bytes, before.size() == 8 ? 2 : 0, 4); // two colours in a palette of eight bytes
    append(bytes, 0, 4);
    bytes.insert(bytes.end(), before.begin(), before.end());
    bytes.insert(bytes.end(), texels.begin(), texels.end());
    return bytes;
}

TEST(DecodeBmp, readsColoursPalettesAndBitFields)
{
    // rows from the bottom up, padded to four bytes
    const DecodedImage rgb = decodeGood(bmp(1, 2, 24, 0, {}, {3, 2, 1, 0, 6, 5, 4, 0}));
    EXPECT_EQ(getTexel(rgb, 0, 0), (Rgba8{4, 5, 6, 255}));
    EXPECT_EQ(getTexel(rgb, 0, 1), (Rgba8{1, 2, 3, 255}));
    const DecodedImage down =
        decodeGood(bmp(1, static_cast<uint32_t>(-2), 24, 0, {}, {3, 2, 1, 0, 6, 5, 4, 0}));
    EXPECT_EQ(getTexel(down, 0, 0), (Rgba8{1, 2, 3, 255}));
    const DecodedImage bits = decodeGood(bmp(3, 1, 1, 0, {30, 20, 10, 0, 60, 50, 40, 0}, {0xA0, 0, 0, 0}));
    EXPECT_EQ(getTexel(bits, 0, 0), (Rgba8{40, 50, 60, 255}));
    EXPECT_EQ(getTexel(bits, 1, 0), (Rgba8{10, 20, 30, 255}));
    Bytes masks;
    for (const uint32_t mask : {0xF800u, 0x07E0u, 0x001Fu})
        append(masks, mask, 4);
    const DecodedImage rgb565 = decodeGood(bmp(2, 1, 16, 3, masks, {0xE0, 0x07, 0x00, 0x80}));
    EXPECT_EQ(getTexel(rgb565, 0, 0), (Rgba8{0, 255, 0, 255}));
    EXPECT_EQ(getTexel(rgb565, 1, 0), (Rgba8{132, 0, 0, 255}));
}

TEST(DecodeBmp, refusesDamage)
{
    expectRefusedWhenCut(bmp(1, 2, 24, 0, {}, {3, 2, 1, 0, 6, 5, 4, 0}), 54 + 7);
    EXPECT_FALSE(decode(bmp(2, 1, 8, 0, {0, 0, 0, 0, 0, 0, 0, 0}, {0, 2, 0, 0})).ok()); // index 2 of 2
    EXPECT_FALSE(decode(bmp(0, 1, 24, 0, {}, {0, 0, 0, 0})).ok());
    EXPECT_FALSE(decode(bmp(1, 0x80000000, 24, 0, {}, {0, 0, 0, 0})).ok());
    EXPECT_FALSE(decode(bmp(1, 1, 7, 0, {}, {0, 0, 0, 0})).ok());
    EXPECT_EQ(decode(bmp(1, 1, 8, 1, {}, {0, 0, 0, 0})).error().issue, Issue::image_unsupported);
    EXPECT_EQ(decode(bmp(1, 1, 16, 3, Bytes(12), {0, 0, 0, 0})).error().issue, Issue::image_malformed);
}

Bytes hdr(const std::string& header, const Bytes& body)
{
    Bytes bytes(header.begin(), header.end());
    bytes.insert(bytes.end(), body.begin(), body.end());
    return bytes;
}

TEST(DecodeHdr, readsFlatOldAndNewRuns)
{
    const std::string header = "#?RADIANCE\n# c\nFORMAT=32-bit_rle_rgbe\n\n";
    const DecodedImage flat = decodeGood(hdr(header + "-Y 1 +X 2\n", {128, 64, 0, 129, 0, 0, 0, 0}));
    EXPECT_EQ(getLight(flat, 0, 0), (std::array<float, 4>{1, 0.5f, 0, 1}));
    EXPECT_EQ(getLight(flat, 1, 0), (std::array<float, 4>{0, 0, 0, 1}));
    // one texel, twice more, and 256 times more
    const DecodedImage old_runs =
        decodeGood(hdr(header + "-Y 1 +X 259\n", {128, 64, 32, 129, 1, 1, 1, 2, 1, 1, 1, 1}));
    EXPECT_EQ(getLight(old_runs, 258, 0), (std::array<float, 4>{1, 0.5f, 0.25f, 1}));
    const DecodedImage new_runs =
        decodeGood(hdr(header + "-Y 1 +X 8\n", {2, 2, 0, 8, 136, 128, 2, 64, 32, 134, 0, 136, 0, 136, 129}));
    EXPECT_EQ(getLight(new_runs, 0, 0), (std::array<float, 4>{1, 0.5f, 0, 1}));
    EXPECT_EQ(getLight(new_runs, 1, 0), (std::array<float, 4>{1, 0.25f, 0, 1}));
    EXPECT_EQ(getLight(new_runs, 7, 0), (std::array<float, 4>{1, 0, 0, 1}));
}

TEST(DecodeHdr, turnsWhatIsNotFromTheUpperLeft)
{
    const Bytes body = {128, 0, 0, 129, 0, 128, 0, 129}; // red, then green
    const auto first_is_red = [&](const std::string& resolution)
    { return getLight(decodeGood(hdr("#?RGBE\n\n" + resolution + "\n", body)), 0, 0)[0] == 1; };
    EXPECT_TRUE(first_is_red("-Y 1 +X 2"));
    EXPECT_FALSE(first_is_red("-Y 1 -X 2"));
    EXPECT_TRUE(first_is_red("-Y 2 +X 1"));
    EXPECT_FALSE(first_is_red("+Y 2 +X 1"));
    EXPECT_TRUE(first_is_red("+X 1 -Y 2"));
    EXPECT_FALSE(first_is_red("-X 2 -Y 1"));
}

TEST(DecodeHdr, dividesByTheExposure)
{
    const DecodedImage image =
        decodeGood(hdr("#?RGBE\nEXPOSURE=2\nEXPOSURE= 4\n\n-Y 1 +X 1\n", {128, 0, 0, 132}));
    EXPECT_EQ(getLight(image, 0, 0)[0], 1);
}

TEST(DecodeHdr, refusesDamage)
{
    const std::string good = "#?RADIANCE\n\n-Y 1 +X 8\n";
    expectRefusedWhenCut(hdr(good, Bytes(32, 9)), good.size() + 31);
    for (const char* resolution : {"-Y 1 +Y 8", "-Y 1", "-Y 1 +X 8 9", "-Y -1 +X 8", "Y 1 X 8", "-Y 1+X 8"})
        EXPECT_FALSE(decode(hdr(std::string("#?RADIANCE\n\n") + resolution + "\n", Bytes(64))).ok())
            << resolution;
    // a run over the end of the scanline, a run of nothing, and a run with nothing before it
    EXPECT_FALSE(decode(hdr(good, {2, 2, 0, 8, 137, 1})).ok());
    EXPECT_FALSE(decode(hdr(good, {2, 2, 0, 8, 0, 1})).ok());
    EXPECT_FALSE(decode(hdr(good, {1, 1, 1, 8})).ok());
    EXPECT_EQ(decode(hdr("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", Bytes(4))).error().issue,
              Issue::image_unsupported);
    EXPECT_FALSE(decode(hdr("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n", Bytes(4))).ok());
}

TEST(DecodeExr, readsCompressionsWindowsAndChroma)
{
    const DecodedImage zip = decodeGood(kExrZip);
    forEachTexel(zip,
                 [&](size_t x, size_t y)
                 {
                     EXPECT_EQ(getLight(zip, x, y),
                               (std::array<float, 4>{0.5f * static_cast<float>(x), static_cast<float>(y), 2,
                                                     0.25f * static_cast<float>(x)}));
                 });
    const DecodedImage dwaa = decodeGood(kExrDwaa);
    forEachTexel(dwaa, [&](size_t x, size_t y)
                 { EXPECT_NEAR(getLight(dwaa, x, y)[0], 0.5f * static_cast<float>(x), 0.1f); });
    const DecodedImage chroma = decodeGood(kExrChroma);
    EXPECT_EQ(chroma.width, 4u);
    EXPECT_NEAR(getLight(chroma, 3, 1)[0], 0.5f, 0.01f);
    EXPECT_NEAR(getLight(chroma, 3, 1)[2], 0.125f, 0.01f);
}

TEST(DecodeExr, theImageIsTheDataWindow)
{
    // the display window lies one to the left and one below
    const DecodedImage image = decodeGood(kExrPizWindow);
    ASSERT_EQ(image.width, 5u);
    ASSERT_EQ(image.height, 3u);
    forEachTexel(image,
                 [&](size_t x, size_t y)
                 {
                     EXPECT_EQ(getLight(image, x, y), (std::array<float, 4>{0.5f * static_cast<float>(x),
                                                                            static_cast<float>(y), 2, 1}));
                 });
}

TEST(DecodeExr, namesTheFileOnce)
{
    const Bytes cut(kExrZip.begin(), kExrZip.begin() + 20);
    const std::string name = "textures/sky.exr";
    const auto image = decodeImage(std::as_bytes(std::span(cut)), name, {});
    ASSERT_FALSE(image.ok());
    const std::string message = formatMessage(image.error());
    EXPECT_EQ(message.rfind(name), message.find(name)) << message;
    EXPECT_EQ(message.find("memory"), std::string::npos) << message;
    EXPECT_NE(message.find("the file ends too early"), std::string::npos) << message;
}

TEST(DecodeExr, refusesCutFiles)
{
    expectRefusedWhenCut(kExrZip, kExrZip.size() - 1);
    expectRefusedWhenCut(kExrPizWindow, kExrPizWindow.size() - 1);
}

TEST(DecodeImage, obeysTheLimits)
{
    ImportLimits limits;
    limits.max_image_texels = 14;
    for (const Bytes& bytes : {kPngRgba8, kJpegBaseline, kWebpLossless, kExrZip})
        EXPECT_EQ(decode(bytes, limits).error().issue, Issue::input_too_large);
    limits.max_image_texels = 15;
    EXPECT_TRUE(decode(kPngRgba8, limits).ok());
    limits.max_image_size = 4;
    EXPECT_EQ(decode(kPngRgba8, limits).error().issue, Issue::input_too_large);
    EXPECT_EQ(decode(hdr("#?RADIANCE\n\n-Y 1000000 +X 1000000\n", {})).error().issue, Issue::input_too_large);
    EXPECT_EQ(decode(bmp(100000, 100000, 24, 0, {}, {})).error().issue, Issue::input_too_large);
}

TEST(DecodeImage, namesFormatsThatItDoesNotRead)
{
    const auto getIssue = [](std::string_view start)
    { return decode(Bytes(start.begin(), start.end())).error().issue; };
    EXPECT_EQ(getIssue("GIF89a"), Issue::image_unsupported);
    EXPECT_EQ(getIssue("8BPS...."), Issue::image_unsupported);
    EXPECT_EQ(getIssue("hello"), Issue::image_malformed);
    EXPECT_EQ(getIssue(""), Issue::image_malformed);
}

TEST(LooksLikeImage, byContentOrName)
{
    const auto looks = [](const std::string& path, std::string_view content)
    { return looksLikeImage(path, std::as_bytes(std::span(content))); };
    EXPECT_TRUE(looks("a.PNG", ""));
    EXPECT_TRUE(looks("a.tga", ""));
    EXPECT_TRUE(looks("a.bin", "\x89PNG\r\n\x1A\n"));
    EXPECT_FALSE(looks("a.obj", "v 0 0 0\n"));
    EXPECT_FALSE(looks("a.obj", "BMW\n"));
    EXPECT_FALSE(looks("png", ""));
}

} // namespace

} // namespace hearth::import
