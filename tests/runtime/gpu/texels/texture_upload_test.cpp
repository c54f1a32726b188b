// Textures of every format of packs show what our decoders say, at any size, as the device samples them or
// decoded at load.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/decode_texels.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <algorithm>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

/// Unlit quad that fills the view with an image.
class TextureUpload : public GpuTest
{
protected:
    /// Draw the whole image, without filtering where it is magnified.
    Image drawImage(const ImageRecord& image, const std::vector<std::byte>& mips)
    {
        load(image, mips);
        const auto scene = upload(*pack_, {.decode_textures = true});
        decoded_ = scene->decoded_textures;
        return draw(*scene, {.position = {0, 0, 2.4f}, .target = {}}, {.width = 64, .height = 64});
    }

    void load(const ImageRecord& image, const std::vector<std::byte>& mips)
    {
        pack_.reset(); // it reads from the scene
        TestScene& test = test_.emplace();
        MaterialRecord material = plainMaterial();
        material.flags = kMaterialUnlit;
        material.base_color = {1, 1, 1, 1};
        material.base_color_texture = makeTextureRef(test.addImage(image, mips));
        material.base_color_texture.nearest = 1;
        test.addInstance(test.addMesh(withMaterial(makeQuad(2, 2), test.addMaterial(material))), Affine3{});
        pack_ = test.build();
    }

    std::optional<TestScene> test_;
    std::optional<PackView> pack_;
    uint32_t decoded_ = 0;
};

ImageRecord makeRecord(TexelFormat format, uint32_t width, uint32_t height, uint32_t mip_count)
{
    ImageRecord image{};
    image.width = width;
    image.height = height;
    image.mip_count = mip_count;
    image.format = static_cast<uint32_t>(format);
    return image;
}

/// Return random bytes; of ASTC blocks of one random colour, since most bits are no legal block.
std::vector<std::byte> randomTexels(const ImageRecord& image, uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<std::byte> bytes(static_cast<size_t>(mipOffset(image, image.mip_count)));
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random() & 0xFFu);
    constexpr uint8_t kVoidExtent[] = {0xFC, 0xFD, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
    if (findTexelFormat(image.format)->family == TexelFamily::astc)
        for (size_t block = 0; block < bytes.size(); block += 16)
            std::memcpy(bytes.data() + block, kVoidExtent, sizeof(kVoidExtent));
    return bytes;
}

/// Return the image without compression, as its decoder gives it.
std::pair<ImageRecord, std::vector<std::byte>> decodeImage(const ImageRecord& image,
                                                           std::span<const std::byte> mips)
{
    const TexelFormatTraits& traits = *findTexelFormat(image.format);
    ImageRecord plain = image;
    const bool is_float = traits.coding == TexelCoding::float_value;
    plain.format = static_cast<uint32_t>(is_float                             ? TexelFormat::rgba16_float
                                         : traits.coding == TexelCoding::srgb ? TexelFormat::rgba8_srgb
                                                                              : TexelFormat::rgba8_unorm);
    std::vector<std::byte> bytes;
    size_t at = 0;
    for (uint32_t mip = 0; mip < image.mip_count; ++mip)
    {
        const MipExtent extent = mipExtent(image, mip);
        const auto size = static_cast<size_t>(mipBytes(traits, extent.width, extent.height));
        for (const DecodedTexel& texel :
             decodeMip(traits, extent.width, extent.height, mips.subspan(at, size)))
            for (const uint16_t channel : texel)
            {
                bytes.push_back(static_cast<std::byte>(is_float ? channel & 0xFF : narrowUnorm(channel)));
                if (is_float)
                    bytes.push_back(static_cast<std::byte>(channel >> 8));
            }
        at += size;
    }
    return {plain, bytes};
}

int largestDifference(const Image& a, const Image& b)
{
    int largest = 0;
    for (size_t i = 0; i < a.color.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(channel(a.color[i], c) - channel(b.color[i], c)));
    return largest;
}

TEST_F(TextureUpload, everyFormatShowsItsTexels)
{
    constexpr std::pair<uint32_t, uint32_t> kSizes[] = {{67, 131}, {1, 1}, {5, 3}, {12, 40}};
    for (uint32_t format = 0; format < kTexelFormatEnd; ++format)
    {
        const TexelFormatTraits* const traits = findTexelFormat(format);
        // random bits of floats are mostly no colours: infinities, or what the tone curve turns white; and of
        // 16 bits more are seen than of 8
        if (!isPackFormat(format) || traits->coding == TexelCoding::float_value ||
            traits->format == TexelFormat::rgba16_unorm)
            continue;
        SCOPED_TRACE(traits->name);
        const auto [width, height] = kSizes[format % std::size(kSizes)];
        const ImageRecord image = makeRecord(traits->format, width, height, 2 - (width == 1));
        const std::vector<std::byte> mips = randomTexels(image, format);
        const Image shown = drawImage(image, mips);
        const bool is_decoded = decoded_ > 0;
        EXPECT_EQ(is_decoded,
                  !renderer().device().texel_formats[format] && traits->family != TexelFamily::plain);
        const auto [plain, texels] = decodeImage(image, mips);
        const Image expected = drawImage(plain, texels);
        if (width > 5) // else ASTC has one block, of one colour
            EXPECT_NE(std::count(expected.color.begin(), expected.color.end(), expected.color[0]), 64 * 64)
                << "the quad is not in view";
        // a driver may decode BC with fewer bits than ours, which the display's curve stretches in the dark
        const bool is_srgb = traits->coding == TexelCoding::srgb;
        EXPECT_LE(largestDifference(shown, expected), is_decoded ? 0 : is_srgb ? 2 : 8);
    }
}

TEST_F(TextureUpload, viewsMakeChannelsThatAreNotStored)
{
    ImageRecord rough = makeRecord(TexelFormat::r8_unorm, 8, 8, 1);
    const std::vector<std::byte> reds = randomTexels(rough, 1);
    const Swizzle swizzle[] = {Swizzle::zero, Swizzle::red, Swizzle::one, Swizzle::one};
    for (uint32_t c = 0; c < 4; ++c)
        rough.swizzle[c] = static_cast<uint8_t>(swizzle[c]);
    const Image shown = drawImage(rough, reds);
    std::vector<std::byte> texels;
    for (const std::byte red : reds)
        for (const std::byte channel : {std::byte{0}, red, std::byte{255}, std::byte{255}})
            texels.push_back(channel);
    EXPECT_EQ(shown.color, drawImage(makeRecord(TexelFormat::rgba8_unorm, 8, 8, 1), texels).color);
}

TEST_F(TextureUpload, aFormatThatTheDeviceLacksIsAnError)
{
    const ImageRecord image = makeRecord(astcFormat(TexelFormat::astc_srgb, 4), 12, 12, 1);
    if (renderer().device().texel_formats[image.format])
        GTEST_SKIP() << "the device has ASTC";
    load(image, randomTexels(image, 1));
    const Status uploaded = host().run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(const auto scene, renderer().upload(*pack_, commands, {}));
            return success();
        });
    ASSERT_FALSE(uploaded.ok());
    EXPECT_EQ(uploaded.error().issue, Issue::texture_format);
    EXPECT_NE(uploaded.error().detail.find("astc-6x6-srgb"), std::string::npos) << uploaded.error().detail;
}

} // namespace

} // namespace hearth::test
