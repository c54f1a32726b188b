// Textures that extract writes as KTX2 have the texels of the pack, by the fields of the specification.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_texture.h"

#include "formats/base/half.h"
#include "formats/pack/decode_image.h"
#include "formats/texels/swizzle.h"
#include "pipelines/import/images/decode.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_pack.h"

#include <cstring>
#include <gtest/gtest.h>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

template <typename T>
T readField(const std::string& file, size_t at)
{
    T value{};
    EXPECT_LE(at + sizeof(value), file.size());
    std::memcpy(&value, file.data() + at, sizeof(value));
    return value;
}

/// Return the bytes of a level that is not compressed: entry `level` of the level index, at byte 80.
std::string readLevel(const std::string& file, size_t level)
{
    return file.substr(readField<uint64_t>(file, 80 + 24 * level),
                       readField<uint64_t>(file, 88 + 24 * level));
}

std::string toText(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class ExtractTexture : public ::testing::Test
{
protected:
    /// Write a pack whose second image is ASTC, 7 x 5 texels, with two mips.
    ExtractTexture()
    {
        PackModel model = smallPack();
        ImageRecord& image = model.images[1];
        image.width = 7;
        image.height = 5;
        image.mip_count = 2;
        image.format = static_cast<uint32_t>(astcFormat(TexelFormat::astc_unorm, 4));
        image.swizzle[1] = static_cast<uint8_t>(Swizzle::alpha);
        image.swizzle[2] = static_cast<uint8_t>(Swizzle::one);
        model.image_data[1].clear();
        for (uint8_t i = 0; i < 48; ++i) // two blocks, and one; void extents of a colour are simplest
            model.image_data[1].push_back(std::byte{kVoidExtent[i % 16]});
        mips_ = model.image_data[1];
        const AlignedBytes file = model.bytes();
        folder_.write("a.hearth", toText(file.span()));
    }

    /// Give the second image random blocks of a format, write the pack, and return the image.
    ImageRecord writeImage(PackModel& model, const TexelFormatTraits& traits, std::mt19937& random)
    {
        ImageRecord& image = model.images[1];
        image.width = 21;
        image.height = 10;
        image.mip_count = 2;
        image.format = static_cast<uint32_t>(traits.format);
        mips_.resize(mipBytes(traits, 21, 10) + mipBytes(traits, 10, 5));
        for (std::byte& byte : mips_)
            byte = static_cast<std::byte>(random());
        model.image_data[1] = mips_;
        const AlignedBytes file = model.bytes();
        folder_.write("a.hearth", toText(file.span()));
        return image;
    }

    Status extract(command::TextureExtraction extraction)
    {
        return command::extractTexture(folder_ / "a.hearth", extraction, folder_ / "a.ktx2");
    }

    static constexpr uint8_t kVoidExtent[16] = {0xFC, 0xFD, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                                                0x00, 0x40, 0x00, 0x80, 0x00, 0xC0, 0x00, 0x20};
    Sandbox folder_;
    std::vector<std::byte> mips_;
};

} // namespace

TEST_F(ExtractTexture, writesTheBlocksOfAllMips)
{
    ASSERT_TRUE(extract({.texture = "glow.exr"}).ok());
    const std::string file = folder_.read("a.ktx2");
    EXPECT_EQ(file.substr(1, 6), "KTX 20");
    EXPECT_EQ(readField<uint32_t>(file, 12), 165u) << "VK_FORMAT_ASTC_6x6_UNORM_BLOCK";
    EXPECT_EQ(readField<uint32_t>(file, 20), 7u);
    EXPECT_EQ(readField<uint32_t>(file, 24), 5u);
    EXPECT_EQ(readField<uint32_t>(file, 40), 2u) << "levels";
    EXPECT_EQ(readField<uint32_t>(file, 44), 0u) << "no supercompression";
    EXPECT_EQ(readLevel(file, 0), toText(std::span(mips_).first(32)));
    EXPECT_EQ(readLevel(file, 1), toText(std::span(mips_).last(16)));
    EXPECT_NE(file.find("KTXswizzle"), std::string::npos);
    EXPECT_NE(file.find("ra1a"), std::string::npos);
}

TEST_F(ExtractTexture, decodesToWhatShadersRead)
{
    ASSERT_TRUE(extract({.texture = "1", .is_decoded = true}).ok());
    const std::string file = folder_.read("a.ktx2");
    EXPECT_EQ(readField<uint32_t>(file, 12), 37u) << "VK_FORMAT_R8G8B8A8_UNORM";
    const std::string texel{'\x40', '\x20', '\xFF', '\x20'};
    for (size_t i = 0; i < 7 * 5; ++i)
        EXPECT_EQ(readLevel(file, 0).substr(4 * i, 4), texel) << i;
    EXPECT_EQ(readLevel(file, 1).size(), 3u * 2 * 4);
    EXPECT_EQ(file.find("KTXswizzle"), std::string::npos);
}

/// Return channel `at` of an image, as decoders of texels have it: finite halves, or numbers of 16 bits.
uint16_t readChannel(const import::DecodedImage& image, size_t at)
{
    uint16_t channel = 0;
    if (image.type == import::ChannelType::unorm8)
        return static_cast<uint16_t>(static_cast<uint16_t>(image.texels[at]) * 257);
    std::memcpy(&channel, image.texels.data() + 2 * at, sizeof(channel));
    return channel;
}

/// Check that an imported image has the finest mip of a pack's, as shaders read it.
void checkTexels(const import::DecodedImage& image, const ImageRecord& record,
                 std::span<const std::byte> mips)
{
    const TexelFormatTraits& traits = *findTexelFormat(record.format);
    const bool is_float = traits.coding == TexelCoding::float_value;
    const std::vector<DecodedTexel> texels = decodeImageMip(record, mips, 0);
    ASSERT_EQ(image.texels.size(), texels.size() * image.texelBytes());
    for (size_t i = 0; i < texels.size(); ++i)
    {
        const DecodedTexel expected = applySwizzle(texels[i], record.swizzle, is_float ? kHalfOne : 0xFFFF);
        for (size_t c = 0; c < 4; ++c)
            if (is_float)
                ASSERT_EQ(readChannel(image, 4 * i + c), halfFromFloat(floatFromHalf(expected[c]))) << i;
            else // ASTC is read with 8 bits
                ASSERT_NEAR(readChannel(image, 4 * i + c), expected[c],
                            image.type == import::ChannelType::unorm8 ? 128 : 0)
                    << i;
    }
}

TEST_F(ExtractTexture, isReadBackInEveryFormat)
{
    PackModel model = smallPack();
    model.images[1].swizzle[0] = static_cast<uint8_t>(Swizzle::green);
    model.images[1].swizzle[2] = static_cast<uint8_t>(Swizzle::red);
    std::mt19937 random(3);
    size_t count = 0;
    for (const TexelFormatTraits& traits : detail::kTexelFormats)
    {
        if (!isPackFormat(static_cast<uint32_t>(traits.format)))
            continue;
        SCOPED_TRACE(traits.name);
        const ImageRecord record = writeImage(model, traits, random);
        ASSERT_TRUE(extract({.texture = "1", .is_compressed = count++ % 2 == 1}).ok());
        const std::string file = folder_.read("a.ktx2");
        const auto image = import::decodeImage(std::as_bytes(std::span(file)), "a.ktx2", {});
        ASSERT_TRUE(image.ok()) << formatMessage(image.error());
        EXPECT_EQ(image->transfer == import::Transfer::srgb, traits.coding == TexelCoding::srgb);
        ASSERT_NO_FATAL_FAILURE(checkTexels(*image, record, mips_));
    }
    EXPECT_EQ(count, 64u);
}

TEST_F(ExtractTexture, saysTheNearestName)
{
    const Status status = extract({.texture = "glow.exf"});
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::usage);
    EXPECT_NE(status.error().detail.find("did you mean \"glow.exr\"?"), std::string::npos)
        << status.error().detail;
    EXPECT_FALSE(folder_.has("a.ktx2"));
    EXPECT_FALSE(extract({.texture = "2"}).ok()) << "the pack has two";
}

} // namespace hearth::test
