// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/texels/decode_texels.h"
#include "tests/pipelines_scans/dds_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace hearth::import
{

namespace
{

using namespace test;
using formats::DecodedTexel;
using Channels = std::array<uint16_t, 4>;

DecodedImage decodeGood(const Dds& dds)
{
    auto image = decode(dds.file());
    EXPECT_TRUE(image.ok()) << formatMessage(image.error());
    return image.ok() ? std::move(image).value() : DecodedImage{};
}

/// Return texel (0, 0), as it is stored: codes of 8 or 16 bits, or halves.
Channels firstTexel(const Dds& dds)
{
    const DecodedImage image = decodeGood(dds);
    Channels channels{};
    for (size_t c = 0; c < 4 && !image.texels.empty(); ++c)
        if (image.type == ChannelType::unorm8)
            channels[c] = static_cast<uint16_t>(image.texels[c]);
        else
            std::memcpy(&channels[c], &image.texels[2 * c], 2);
    return channels;
}

/// Return the texel of a legacy format of one texel.
Channels readMasked(uint32_t flags, uint32_t bits, std::array<uint32_t, 4> masks, uint32_t value)
{
    Dds dds;
    dds.width = dds.height = 1;
    dds.format_flags = flags;
    dds.bits = bits;
    dds.masks = masks;
    dds.texels.clear();
    append(dds.texels, value, bits / 8);
    return firstTexel(dds);
}

TEST(DecodeDds, readsMasks)
{
    constexpr uint32_t kRgb = 0x40, kRgba = 0x41, kGrey = 0x20000, kGreyAlpha = 0x20001, kAlpha = 2;
    EXPECT_EQ(readMasked(kRgba, 32, {0xFF0000, 0xFF00, 0xFF, 0xFF000000}, 0x04030201),
              (Channels{3, 2, 1, 4}));
    EXPECT_EQ(readMasked(kRgb, 32, {0xFF0000, 0xFF00, 0xFF, 0xFF000000}, 0x04030201),
              (Channels{3, 2, 1, 255}))
        << "without its flag, the mask of alpha does not count";
    EXPECT_EQ(readMasked(kRgb, 32, {0xFF, 0xFF00, 0xFF0000, 0}, 0x04030201), (Channels{1, 2, 3, 255}));
    EXPECT_EQ(readMasked(kRgb, 24, {0xFF0000, 0xFF00, 0xFF, 0}, 0x030201), (Channels{3, 2, 1, 255}));
    EXPECT_EQ(readMasked(kRgb, 16, {0xF800, 0x7E0, 0x1F, 0}, 1 << 11 | 63 << 5 | 16),
              (Channels{8, 255, 132, 255}));
    EXPECT_EQ(readMasked(kRgba, 16, {0x7C00, 0x3E0, 0x1F, 0x8000}, 31 << 10 | 1 << 5 | 2),
              (Channels{255, 8, 16, 0}));
    EXPECT_EQ(readMasked(kRgba, 16, {0xF00, 0xF0, 0xF, 0xF000}, 0x4321), (Channels{0x33, 0x22, 0x11, 0x44}));
    EXPECT_EQ(readMasked(kRgb, 8, {0xE0, 0x1C, 0x03, 0}, 0xE0 | 1), (Channels{255, 0, 85, 255}));
    EXPECT_EQ(readMasked(kGrey, 8, {0xFF, 0, 0, 0}, 77), (Channels{77, 77, 77, 255}));
    EXPECT_EQ(readMasked(kGreyAlpha, 16, {0xFF, 0, 0, 0xFF00}, 0x9907), (Channels{7, 7, 7, 0x99}));
    EXPECT_EQ(readMasked(kGreyAlpha, 8, {0x0F, 0, 0, 0xF0}, 0x94), (Channels{0x44, 0x44, 0x44, 0x99}));
    EXPECT_EQ(readMasked(kGrey, 16, {0xFFFF, 0, 0, 0}, 1234), (Channels{1234, 1234, 1234, 65535}));
    EXPECT_EQ(readMasked(kAlpha, 8, {0, 0, 0, 0xFF}, 77), (Channels{0, 0, 0, 77}));
    EXPECT_EQ(readMasked(kRgb, 32, {0xFFFF, 0xFFFF0000, 0, 0}, 2000u << 16 | 1000),
              (Channels{1000, 2000, 0, 65535}));
    EXPECT_EQ(readMasked(kRgba, 32, {0x3FF, 0xFFC00, 0x3FF00000, 0xC0000000}, 1u << 30 | 341u << 20 | 1),
              (Channels{64, 0, 21845, 21845}));
}

TEST(DecodeDds, readsRowsFromTopToBottom)
{
    Dds dds;
    dds.width = 3; // rows of 9 bytes: without padding
    dds.bits = 24;
    dds.format_flags = 0x40;
    dds.texels.clear();
    for (uint8_t i = 0; i < 18; ++i)
        dds.texels.push_back(i);
    const DecodedImage image = decodeGood(dds);
    EXPECT_EQ(getTexel(image, 2, 0), (Rgba8{8, 7, 6, 255}));
    EXPECT_EQ(getTexel(image, 0, 1), (Rgba8{11, 10, 9, 255}));
}

TEST(DecodeDds, readsNumbersOfFormats)
{
    const auto read = [](uint32_t code, const std::vector<uint32_t>& words, size_t size)
    {
        Dds dds = Dds::withCode("DX10", {});
        dds.code = code;
        dds.width = dds.height = 1;
        for (const uint32_t word : words)
            append(dds.texels, word, size);
        return firstTexel(dds);
    };
    const uint16_t one = halfFromFloat(1), half = halfFromFloat(0.5f), two = halfFromFloat(2);
    constexpr uint32_t kOne = 0x3F800000, kHalf = 0x3F000000, kTwo = 0x40000000;
    EXPECT_EQ(read(111, {half}, 2), (Channels{half, half, half, one}));
    EXPECT_EQ(read(112, {half, two}, 2), (Channels{half, two, 0, one}));
    EXPECT_EQ(read(113, {half, two, one, half}, 2), (Channels{half, two, one, half}));
    EXPECT_EQ(read(114, {kHalf}, 4), (Channels{half, half, half, one}));
    EXPECT_EQ(read(115, {kHalf, kTwo}, 4), (Channels{half, two, 0, one}));
    EXPECT_EQ(read(116, {kHalf, kTwo, kOne, kHalf}, 4), (Channels{half, two, one, half}));
    EXPECT_EQ(read(36, {1, 2000, 30000, 40000}, 2), (Channels{1, 2000, 30000, 40000}));
    EXPECT_EQ(read(110, {0x7FFF, 0x8001, 0, 0x7FFF}, 2), (Channels{65535, 0, 32768, 65535}));
}

/// Check that a file of 7 x 5 texels has those of a format of blocks.
void checkBlocks(const std::function<Dds(Bytes)>& make, const char* name)
{
    SCOPED_TRACE(name);
    const formats::TexelFormatTraits& traits = *formats::findTexelFormat(name);
    Bytes blocks(static_cast<size_t>(formats::mipBytes(traits, 7, 5)));
    for (size_t i = 0; i < blocks.size(); ++i)
        blocks[i] = static_cast<uint8_t>(i * i * 37 + 11 * i + 5);
    Dds dds = make(blocks);
    dds.width = 7;
    dds.height = 5;
    const DecodedImage image = decodeGood(dds);
    const std::vector<DecodedTexel> texels =
        formats::decodeMip(traits, 7, 5, std::as_bytes(std::span(blocks)));
    ASSERT_EQ(image.texels.size(), texels.size() * image.texelBytes());
    // of the other formats, ktx2_formats_test compares the channels
    if (image.type != ChannelType::unorm8)
        return;
    for (size_t i = 0; i < texels.size(); ++i)
        for (size_t c = 0; c < 4; ++c)
            ASSERT_EQ(static_cast<uint8_t>(image.texels[4 * i + c]), std::lround(texels[i][c] / 257.0)) << i;
}

TEST(DecodeDds, readsBlocks)
{
    for (const auto& [code, name] : {std::pair{"DXT1", "bc1-rgba-unorm"},
                                     {"DXT3", "bc2-unorm"},
                                     {"DXT5", "bc3-unorm"},
                                     {"ATI1", "bc4-unorm"},
                                     {"BC4U", "bc4-unorm"},
                                     {"BC4S", "bc4-snorm"},
                                     {"ATI2", "bc5-unorm"},
                                     {"BC5U", "bc5-unorm"},
                                     {"BC5S", "bc5-snorm"}})
        checkBlocks([&](Bytes blocks) { return Dds::withCode(code, std::move(blocks)); }, name);
    const std::pair<uint32_t, const char*> formats[] = {
        {71, "bc1-rgba-unorm"}, {72, "bc1-rgba-srgb"}, {74, "bc2-unorm"},   {75, "bc2-srgb"},
        {77, "bc3-unorm"},      {78, "bc3-srgb"},      {80, "bc4-unorm"},   {81, "bc4-snorm"},
        {83, "bc5-unorm"},      {84, "bc5-snorm"},     {95, "bc6h-ufloat"}, {96, "bc6h-sfloat"},
        {98, "bc7-unorm"},      {99, "bc7-srgb"}};
    for (const auto& [number, name] : formats)
    {
        checkBlocks([&](Bytes blocks) { return Dds::withDxgi(number, std::move(blocks)); }, name);
        const bool is_srgb = std::string_view(name).ends_with("srgb");
        EXPECT_EQ(decodeGood(Dds::withDxgi(number, Bytes(16))).transfer,
                  is_srgb ? Transfer::srgb : Transfer::unsaid);
    }
}

TEST(DecodeDds, readsPlainFormatsOfDxgi)
{
    const auto read = [](uint32_t format, Bytes texel)
    {
        Dds dds = Dds::withDxgi(format, std::move(texel));
        dds.width = dds.height = 1;
        return firstTexel(dds);
    };
    const uint16_t one = halfFromFloat(1);
    EXPECT_EQ(read(28, {1, 2, 3, 4}), (Channels{1, 2, 3, 4}));
    EXPECT_EQ(read(29, {1, 2, 3, 4}), (Channels{1, 2, 3, 4}));
    EXPECT_EQ(read(87, {1, 2, 3, 4}), (Channels{3, 2, 1, 4}));
    EXPECT_EQ(read(88, {1, 2, 3, 4}), (Channels{3, 2, 1, 255}));
    EXPECT_EQ(read(91, {1, 2, 3, 4}), (Channels{3, 2, 1, 4}));
    EXPECT_EQ(read(93, {1, 2, 3, 4}), (Channels{3, 2, 1, 255}));
    EXPECT_EQ(read(61, {9}), (Channels{9, 9, 9, 255}));
    EXPECT_EQ(read(65, {9}), (Channels{0, 0, 0, 9}));
    EXPECT_EQ(read(49, {9, 8}), (Channels{9, 8, 0, 255}));
    EXPECT_EQ(read(51, {0x7F, 0x01}), (Channels{65535, 33026, 0, 65535}));
    EXPECT_EQ(read(56, {1, 2}), (Channels{513, 513, 513, 65535}));
    EXPECT_EQ(read(35, {1, 2, 3, 4}), (Channels{513, 1027, 0, 65535}));
    EXPECT_EQ(read(11, {1, 2, 3, 4, 5, 6, 7, 8}), (Channels{513, 1027, 1541, 2055}));
    EXPECT_EQ(read(10, {0, 0x3C, 0, 0, 0, 0x3C, 0, 0}), (Channels{one, 0, one, 0}));
    EXPECT_EQ(read(85, {16, 0}), (Channels{0, 0, 132, 255}));
    EXPECT_EQ(read(86, {16, 0x80}), (Channels{0, 0, 132, 255}));
    EXPECT_EQ(read(115, {0x21, 0x43}), (Channels{0x33, 0x22, 0x11, 0x44}));
    EXPECT_EQ(read(24, {1, 0, 0, 0x40}), (Channels{64, 0, 0, 21845}));
    EXPECT_EQ(read(26, {0xC0, 3, 0, 0}), (Channels{one, 0, 0, one}));
    EXPECT_EQ(read(67, {0, 1, 0, 0x80}), (Channels{one, 0, 0, one}))
        << "mantissa 256 of 512, exponent 16 - 15";
}

TEST(DecodeDds, makesAlphaOpacity)
{
    Dds dds = Dds::withDxgi(28, {64, 32, 1, 128, 1, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0});
    const auto read = [&](uint32_t alpha_mode)
    {
        dds.dx10->alpha_mode = alpha_mode;
        return firstTexel(dds);
    };
    EXPECT_EQ(read(1), (Channels{64, 32, 1, 128}));
    EXPECT_EQ(read(2), (Channels{128, 64, 2, 128})) << "premultiplied";
    EXPECT_EQ(read(3), (Channels{64, 32, 1, 255})) << "opaque";
    EXPECT_TRUE(decodeGood(dds).notes.empty());
    EXPECT_EQ(read(4), (Channels{64, 32, 1, 255})) << "custom";
    ASSERT_EQ(decodeGood(dds).notes.size(), 1u);
    EXPECT_EQ(decodeGood(dds).notes[0].issue, Issue::image_alpha);

    // alpha 8 of 15, and both colours red, 8 of 31
    Bytes block(8, 0x88);
    const Bytes red = {0x00, 0x40, 0x00, 0x40, 0, 0, 0, 0};
    block.insert(block.end(), red.begin(), red.end());
    for (const char* code : {"DXT3", "DXT5"})
        EXPECT_EQ(firstTexel(Dds::withCode(code, block))[0], 66) << code;
    EXPECT_EQ(firstTexel(Dds::withCode("DXT2", block)), (Channels{124, 0, 0, 136}));
    EXPECT_EQ(firstTexel(Dds::withCode("DXT4", block)), (Channels{124, 0, 0, 136}));
}

TEST(DecodeDds, refusesWhatIsNoImage)
{
    struct Case
    {
        const char* name;
        std::function<void(Dds&)> change;
        Issue issue;
        const char* part;
    };
    const Issue malformed = Issue::image_malformed, unsupported = Issue::image_unsupported;
    const Case cases[] = {
        {"cube", [](Dds& d) { d.caps2 = 0xFE00; }, unsupported, "face"},
        {"volume", [](Dds& d) { d.caps2 = 0x200000; }, unsupported, "slice"},
        {"cube of Direct3D 10", [](Dds& d) { d.dx10->flags = 4; }, unsupported, "face"},
        {"volume of Direct3D 10", [](Dds& d) { d.dx10->dimension = 4; }, unsupported, "slice"},
        {"line", [](Dds& d) { d.dx10->dimension = 2; }, unsupported, "dimension 2"},
        {"array", [](Dds& d) { d.dx10->layers = 3; }, unsupported, "3 layers"},
        {"no type", [](Dds& d) { d.dx10->format = 27; }, unsupported, "DXGI format 27"},
        {"code", [](Dds& d) { d.code = 1; }, unsupported, "code 1"},
        {"palette", [](Dds& d) { d.format_flags = 0x20; }, unsupported, "palette"},
        {"no width", [](Dds& d) { d.width = 0; }, malformed, "0 x 2"},
        {"too large", [](Dds& d) { d.width = d.height = ~0u; }, Issue::input_too_large, "4294967295"},
        {"short", [](Dds& d) { d.width = d.height = 8192; }, malformed, "ends before"},
        {"bits", [](Dds& d) { d.format_flags = 0x40, d.bits = 12; }, malformed, "12 bits"},
        {"no masks", [](Dds& d) { d.format_flags = 0x40, d.bits = 32; }, malformed, "no channel"},
        {"split mask",
         [](Dds& d) {
             d.format_flags = 0x40, d.bits = 32, d.masks = {5, 0, 0, 0};
         },
         malformed, "masks"},
        {"long mask",
         [](Dds& d) {
             d.format_flags = 0x40, d.bits = 32, d.masks = {0x1FFFF, 0, 0, 0};
         },
         malformed, "masks"},
        {"mask beyond the texel",
         [](Dds& d) {
             d.format_flags = 0x40, d.bits = 8, d.masks = {0x100, 0, 0, 0};
         },
         malformed, "masks"},
    };
    ASSERT_TRUE(decode(Dds::withDxgi(28, Bytes(16)).file()).ok());
    for (const Case& c : cases)
    {
        Dds dds = Dds::withDxgi(28, Bytes(16));
        c.change(dds);
        const auto image = decode(dds.file());
        ASSERT_FALSE(image.ok()) << c.name;
        EXPECT_EQ(image.error().issue, c.issue) << c.name;
        EXPECT_NE(image.error().detail.find(c.part), std::string::npos) << image.error().detail;
    }
}

} // namespace

} // namespace hearth::import
