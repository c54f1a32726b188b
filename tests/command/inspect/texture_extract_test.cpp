// Textures that extract writes as KTX2 have the texels of the pack, by the fields of the specification.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/extract_texture.h"

#include "formats/texels/decode_texels.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_pack.h"

#include <cstring>
#include <gtest/gtest.h>

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
