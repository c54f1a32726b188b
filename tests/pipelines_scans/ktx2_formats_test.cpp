// KTX2 files in every format that devices sample, and their keys that turn and reorder texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/texels/decode_texels.h"
#include "pipelines/texture_files/ktx2_writer.h"
#include "tests/pipelines_scans/ktx2_builder.h"

#include <gtest/gtest.h>

#include <zlib.h>

#include <cmath>
#include <random>

namespace hearth::import
{

namespace
{

using namespace test;
using formats::DecodedTexel;
using formats::TexelCoding;
using formats::TexelFormatTraits;

constexpr uint32_t kWidth = 37, kHeight = 13, kMips = 3;

/// Return the channels of an image as they are, or the codes of 8 bits.
std::vector<uint16_t> getChannels(const DecodedImage& image)
{
    std::vector<uint16_t> channels(size_t{4} * image.width * image.height);
    for (size_t i = 0; i < channels.size(); ++i)
        if (image.type == ChannelType::unorm8)
            channels[i] = static_cast<uint16_t>(image.texels.at(i));
        else
            std::memcpy(&channels[i], &image.texels.at(2 * i), 2);
    return channels;
}

/// Return a float's nearest finite half.
uint16_t makeFinite(uint16_t half)
{
    const bool is_special = (half & 0x7C00) == 0x7C00;
    const bool is_nan = is_special && (half & 0x3FF) != 0;
    return is_nan ? uint16_t{0} : is_special ? static_cast<uint16_t>((half & 0x8000) | 0x7BFF) : half;
}

/// Return a decoded texel as images have it, by the sentences of the header.
DecodedTexel expectTexel(const TexelFormatTraits& traits, DecodedTexel texel)
{
    for (size_t c = 0; c < 4; ++c)
        if (traits.coding == TexelCoding::float_value)
            texel[c] = makeFinite(texel[c]);
        else if (traits.coding == TexelCoding::snorm && c < traits.channels)
            texel[c] = static_cast<uint16_t>(
                std::lround((static_cast<int16_t>(texel[c]) / 32767.0 + 1) / 2 * 65535));
    if (traits.channels == 1)
        texel[1] = texel[2] = texel[0];
    return texel;
}

std::vector<std::byte> randomMips(const TexelFormatTraits& traits, std::mt19937& random)
{
    uint64_t size = 0;
    for (uint32_t i = 0; i < kMips; ++i)
        size += formats::mipBytes(traits, kWidth >> i, kHeight >> i);
    std::vector<std::byte> mips(static_cast<size_t>(size));
    for (std::byte& byte : mips)
        byte = static_cast<std::byte>(random());
    return mips;
}

void checkFormat(const TexelFormatTraits& traits, bool compressed, std::mt19937& random)
{
    const std::vector<std::byte> mips = randomMips(traits, random);
    const std::vector<std::byte> file =
        texture_files::writeKtx2({&traits, kWidth, kHeight, kMips, mips}, "test", compressed);
    const auto image = decodeImage(file, "texture", {});
    ASSERT_TRUE(image.ok()) << formatMessage(image.error());
    ASSERT_EQ(image->width, kWidth);
    ASSERT_EQ(image->height, kHeight);
    EXPECT_EQ(image->transfer, traits.coding == TexelCoding::srgb ? Transfer::srgb : Transfer::linear);
    const bool is_float = traits.coding == TexelCoding::float_value;
    EXPECT_EQ(image->isFloat(), is_float);

    const auto first = std::span(mips).first(formats::mipBytes(traits, kWidth, kHeight));
    const std::vector<DecodedTexel> texels = formats::decodeMip(traits, kWidth, kHeight, first);
    const std::vector<uint16_t> channels = getChannels(*image);
    const double scale = image->type == ChannelType::unorm8 ? 257 : 1;
    for (size_t i = 0; i < texels.size(); ++i)
    {
        const DecodedTexel expected = expectTexel(traits, texels[i]);
        for (size_t c = 0; c < 4; ++c)
            ASSERT_EQ(channels[4 * i + c], std::lround(expected[c] / scale)) << i << " channel " << c;
    }
}

TEST(DecodeKtx2, readsEveryFormatOfDevices)
{
    std::mt19937 random(1);
    size_t count = 0;
    for (const TexelFormatTraits& traits : formats::detail::kTexelFormats)
        if (traits.vulkan_format != 0)
        {
            SCOPED_TRACE(traits.name);
            checkFormat(traits, count % 2 == 1, random);
            ++count;
        }
    EXPECT_GT(count, 70u);
}

/// Return the channels of one texel.
std::vector<uint16_t> readTexel(uint32_t vk_format, uint64_t low, size_t size, uint64_t high = 0)
{
    Ktx2 ktx;
    ktx.vk_format = vk_format;
    ktx.width = ktx.height = 1;
    Bytes bytes;
    append(bytes, low, std::min<size_t>(size, 8));
    append(bytes, high, size - bytes.size());
    ktx.levels = {bytes};
    ktx.uncompressed = {size};
    const auto image = decode(ktx.file());
    EXPECT_TRUE(image.ok()) << vk_format << ": " << formatMessage(image.error());
    return image.ok() ? getChannels(*image) : std::vector<uint16_t>();
}

TEST(DecodeKtx2, readsPackedTexels)
{
    using Channels = std::vector<uint16_t>;
    EXPECT_EQ(readTexel(2, 0x1F83, 2), (Channels{0x11, 0xFF, 0x88, 0x33}));
    EXPECT_EQ(readTexel(3, 0x1F83, 2), (Channels{0x88, 0xFF, 0x11, 0x33}));
    EXPECT_EQ(readTexel(4, 1 << 11 | 63 << 5 | 16, 2), (Channels{8, 255, 132, 255}));
    EXPECT_EQ(readTexel(5, 1 << 11 | 62 << 5 | 16, 2), (Channels{132, 251, 8, 255}));
    EXPECT_EQ(readTexel(6, 31 << 11 | 1 << 6 | 2 << 1 | 0, 2), (Channels{255, 8, 16, 0}));
    EXPECT_EQ(readTexel(7, 31 << 11 | 1 << 6 | 2 << 1 | 1, 2), (Channels{16, 8, 255, 255}));
    EXPECT_EQ(readTexel(8, 1 << 15 | 31 << 10 | 1 << 5 | 2, 2), (Channels{255, 8, 16, 255}));
    EXPECT_EQ(readTexel(1000470000, 1 << 15 | 31 << 10 | 1 << 5 | 2, 2), (Channels{16, 8, 255, 255}));
    EXPECT_EQ(readTexel(1000340000, 0x4321, 2), (Channels{0x33, 0x22, 0x11, 0x44}));
    EXPECT_EQ(readTexel(1000340001, 0x4321, 2), (Channels{0x11, 0x22, 0x33, 0x44}));
    EXPECT_EQ(readTexel(1000470001, 7, 1), (Channels{0, 0, 0, 7}));
    // 10 bits: 341 of 1023 is a third, as is 1 of 3
    EXPECT_EQ(readTexel(58, 1u << 30 | 341u << 20 | 1023u << 10 | 1, 4), (Channels{21845, 65535, 64, 21845}));
    EXPECT_EQ(readTexel(64, 1u << 30 | 341u << 20 | 1023u << 10 | 1, 4), (Channels{64, 65535, 21845, 21845}));
}

TEST(DecodeKtx2, readsSignedNumbersAsNormalMapsHaveThem)
{
    using Channels = std::vector<uint16_t>;
    EXPECT_EQ(readTexel(38, 0x0080'817F, 4), (Channels{65535, 0, 0, 32768})) << "-128 is -1, 0 is the middle";
    EXPECT_EQ(readTexel(17, 0x017F, 2), (Channels{65535, 33026, 0, 65535}));
    EXPECT_EQ(readTexel(92, 0x0000'8000'8001'7FFF, 8), (Channels{65535, 0, 0, 32768}));
}

TEST(DecodeKtx2, readsSmallFloats)
{
    using Channels = std::vector<uint16_t>;
    const uint16_t one = halfFromFloat(1);
    // red 1, green 2^-14 times 1/64, blue 0.5
    EXPECT_EQ(readTexel(122, 0x3C0 | 1u << 11 | 0x1C0u << 22, 4),
              (Channels{one, 0x10, halfFromFloat(0.5f), one}));
    EXPECT_EQ(readTexel(122, 0x7C0 | 0x7FFu << 11, 4), (Channels{0x7BFF, 0, 0, one})) << "infinity, NaN";
    EXPECT_EQ(readTexel(97, 0x3C00'FC00'7E00'C000, 8), (Channels{0xC000, 0, 0xFBFF, one}));
    EXPECT_EQ(readTexel(76, 0x4000, 2), (Channels{0x4000, 0x4000, 0x4000, one}));
}

TEST(DecodeKtx2, unpacksZlib)
{
    Ktx2 ktx;
    const Bytes texels(16, 77);
    const auto pack = [&](size_t count)
    {
        uLongf size = 64;
        Bytes packed(size);
        EXPECT_EQ(::compress(packed.data(), &size, texels.data(), count), Z_OK);
        packed.resize(size);
        return packed;
    };
    const Bytes packed = pack(16);
    ktx.scheme = 3;
    ktx.levels = {packed};
    EXPECT_EQ(getTexel(*decode(ktx.file()), 1, 1), (Rgba8{77, 77, 77, 77}));
    Bytes longer = packed, shorter = packed;
    longer.push_back(0);
    shorter.pop_back();
    for (const Bytes& damaged : {longer, shorter, pack(15)})
    {
        ktx.levels = {damaged};
        const auto image = decode(ktx.file());
        ASSERT_FALSE(image.ok()) << damaged.size();
        EXPECT_EQ(image.error().issue, Issue::image_malformed);
    }
}

/// Texture of 2 x 2 texels whose channels are 0 to 15.
Ktx2 countingTexture()
{
    Ktx2 ktx;
    for (size_t i = 0; i < 16; ++i)
        ktx.levels[0][i] = static_cast<uint8_t>(i);
    return ktx;
}

TEST(DecodeKtx2, turnsTexelsByTheirOrientation)
{
    const auto first = [](const char* orientation)
    {
        Ktx2 ktx = countingTexture();
        ktx.addText("KTXorientation", orientation);
        return getTexel(*decode(ktx.file()), 0, 0)[0];
    };
    EXPECT_EQ(first("rd"), 0);
    EXPECT_EQ(first("ru"), 8);
    EXPECT_EQ(first("ld"), 4);
    EXPECT_EQ(first("lu"), 12);
    for (const char* wrong : {"", "r", "rdi", "dr", "xd"})
    {
        Ktx2 ktx;
        ktx.addText("KTXorientation", wrong);
        EXPECT_EQ(decode(ktx.file()).error().issue, Issue::image_malformed) << wrong;
    }
}

TEST(DecodeKtx2, appliesTheSwizzle)
{
    Ktx2 ktx = countingTexture();
    ktx.addText("KTXswizzle", "b01r");
    EXPECT_EQ(getTexel(*decode(ktx.file()), 1, 0), (Rgba8{6, 0, 255, 4}));

    Ktx2 red = countingTexture();
    red.vk_format = 9;
    red.levels[0].resize(4);
    red.uncompressed = {4};
    red.addText("KTXswizzle", "000r");
    EXPECT_EQ(getTexel(*decode(red.file()), 1, 1), (Rgba8{0, 0, 0, 3})) << "grey only without a swizzle";

    for (const char* wrong : {"", "rgb", "rgbaa", "rgbx"})
    {
        Ktx2 damaged;
        damaged.addText("KTXswizzle", wrong);
        EXPECT_EQ(decode(damaged.file()).error().issue, Issue::image_malformed) << wrong;
    }
}

TEST(DecodeKtx2, dividesPremultipliedColoursByAlpha)
{
    Ktx2 ktx;
    ktx.flags = 1;
    ktx.levels[0] = {64, 32, 1, 128, 10, 0, 0, 0, 200, 100, 50, 255, 90, 3, 2, 85};
    const auto image = decode(ktx.file());
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(getTexel(*image, 0, 0), (Rgba8{128, 64, 2, 128}));
    EXPECT_EQ(getTexel(*image, 1, 0), (Rgba8{10, 0, 0, 0})) << "no alpha: as it is";
    EXPECT_EQ(getTexel(*image, 0, 1), (Rgba8{200, 100, 50, 255}));
    EXPECT_EQ(getTexel(*image, 1, 1), (Rgba8{255, 9, 6, 85})) << "more than alpha is at most 1";
}

TEST(DecodeKtx2, tellsTheTransferFunction)
{
    const auto transfer = [](uint8_t number)
    {
        Ktx2 ktx;
        ktx.transfer = number;
        return decode(ktx.file())->transfer;
    };
    EXPECT_EQ(transfer(0), Transfer::unsaid);
    EXPECT_EQ(transfer(1), Transfer::linear);
    EXPECT_EQ(transfer(2), Transfer::srgb);
}

} // namespace

} // namespace hearth::import
