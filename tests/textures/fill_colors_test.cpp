// Colours under an alpha of 0: filled from around, and nothing else changes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/fill_colors.h"

#include "cook/textures/texture_part.h"
#include "formats/container/container_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/textures/texture_test_images.h"

#include <tbb/global_control.h>

#include <gtest/gtest.h>

namespace hearth::textures
{

namespace
{

using namespace test;
using namespace formats;
using hearth::test::TemporaryFolder;

std::vector<std::byte> toBytes(std::span<const Rgba8> texels)
{
    const auto bytes = std::as_bytes(texels);
    return {bytes.begin(), bytes.end()};
}

/// Return random texels, of which a share has an alpha of 0.
std::vector<Rgba8> randomTexels(uint32_t width, uint32_t height, uint32_t seed, unsigned hidden_of_16)
{
    std::mt19937 random(seed);
    std::vector<Rgba8> texels(size_t{width} * height);
    for (Rgba8& texel : texels)
    {
        for (uint8_t& channel : texel)
            channel = static_cast<uint8_t>(1 + random() % 255);
        if (random() % 16 < hidden_of_16)
            texel[3] = 0;
    }
    return texels;
}

std::vector<Rgba8> fillTexels(uint32_t width, uint32_t height, std::span<const Rgba8> texels)
{
    ImageRecord image = makeRecord(width, height);
    image.mip_count = 1;
    std::vector<std::byte> bytes = toBytes(texels);
    fillHiddenColors(image, bytes);
    return decodeMip(image, bytes, 0);
}

TEST(FillHiddenColors, onlyColoursThatNobodySeesChange)
{
    for (const auto& [width, height] : {std::array{1u, 1u}, std::array{2u, 1u}, std::array{37u, 23u},
                                        std::array{64u, 64u}, std::array{1u, 90u}})
        for (const unsigned hidden : {0u, 1u, 8u, 15u, 16u})
        {
            const std::vector<Rgba8> before = randomTexels(width, height, 7 * width + hidden, hidden);
            const std::vector<Rgba8> after = fillTexels(width, height, before);
            std::array<uint8_t, 3> low{255, 255, 255}, high{};
            size_t seen = 0;
            for (const Rgba8& texel : before)
                for (size_t c = 0; c < 3 && texel[3] > 0; ++c)
                {
                    ++seen;
                    low[c] = std::min(low[c], texel[c]);
                    high[c] = std::max(high[c], texel[c]);
                }
            for (size_t i = 0; i < before.size(); ++i)
            {
                if (before[i][3] > 0 || seen == 0)
                {
                    EXPECT_EQ(after[i], before[i]);
                }
                EXPECT_EQ(after[i][3], before[i][3]);
                for (size_t c = 0; c < 3 && seen > 0; ++c)
                {
                    EXPECT_GE(after[i][c], low[c]) << "a mean is among the colours that are seen";
                    EXPECT_LE(after[i][c], std::min(255, high[c] + 1));
                }
            }
        }
}

TEST(FillHiddenColors, theNearestColourSpreads)
{
    // two leaves on white, which nobody sees: a green one on the left, a red one on the right
    constexpr uint32_t kSide = 64;
    std::vector<Rgba8> texels(size_t{kSide} * kSide, {255, 255, 255, 0});
    for (uint32_t y = 20; y < 44; ++y)
        for (uint32_t x = 0; x < 12; ++x)
        {
            texels[y * kSide + 4 + x] = {20, 200, 20, 255};
            texels[y * kSide + 48 + x] = {200, 20, 20, 255};
        }
    const std::vector<Rgba8> filled = fillTexels(kSide, kSide, texels);
    const auto at = [&](uint32_t x, uint32_t y) { return filled[y * kSide + x]; };
    for (uint32_t y = 20; y < 44; ++y)
    {
        EXPECT_EQ(at(3, y), (Rgba8{20, 200, 20, 0})) << y;
        EXPECT_EQ(at(16, y), (Rgba8{20, 200, 20, 0})) << y;
        EXPECT_EQ(at(60, y), (Rgba8{200, 20, 20, 0})) << y;
    }
    EXPECT_GT(at(0, 0)[1], at(0, 0)[0] + 100) << "the corner is nearer to the green one";
    EXPECT_GT(at(63, 63)[0], at(63, 63)[1] + 100);
    for (const Rgba8& texel : filled)
        EXPECT_LT(texel[2], 60) << "white is gone";
}

TEST(FillHiddenColors, sixteenBitsAreFilledAlike)
{
    constexpr uint32_t kWidth = 19, kHeight = 31;
    const std::vector<Rgba8> texels = randomTexels(kWidth, kHeight, 3, 9);
    ImageRecord image = makeRecord(kWidth, kHeight, TexelFormat::rgba16_srgb);
    std::vector<std::byte> wide;
    for (const std::byte byte : toBytes(texels))
        wide.insert(wide.end(), 2, byte);
    fillHiddenColors(image, wide);
    EXPECT_EQ(narrowTexels(wide), toBytes(fillTexels(kWidth, kHeight, texels)));
}

TEST(FillHiddenColors, sameBytesForAnyNumberOfThreads)
{
    const std::vector<Rgba8> texels = randomTexels(150, 210, 1, 14);
    const auto run = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return fillTexels(150, 210, texels);
    };
    EXPECT_EQ(run(1), run(7));
}

MaterialRecord makeMaterial(AlphaMode mode)
{
    MaterialRecord material{};
    for (TextureRef MaterialRecord::*const field : kMaterialTextureFields)
        (material.*field).image = kInvalidIndex;
    material.base_color_texture.image = 0;
    material.alpha_mode = static_cast<uint32_t>(mode);
    material.alpha_cutoff = 0.5f;
    return material;
}

TEST(ListHiddenColors, everyUseMustHideThem)
{
    const auto isHidden = [](std::span<const MaterialRecord> materials) -> bool
    { return listHiddenColors(materials, {}, 1)[0]; };
    const MaterialRecord opaque = makeMaterial(AlphaMode::opaque), mask = makeMaterial(AlphaMode::mask),
                         blend = makeMaterial(AlphaMode::blend);
    EXPECT_TRUE(isHidden(std::array{mask}));
    EXPECT_TRUE(isHidden(std::array{blend, mask}));
    EXPECT_FALSE(isHidden(std::array{opaque}));
    EXPECT_FALSE(isHidden(std::array{mask, opaque})) << "one material shows all colours";
    EXPECT_FALSE(isHidden({})) << "nobody knows what it is for";
    MaterialRecord glowing = mask;
    glowing.emissive_texture.image = 0;
    EXPECT_FALSE(isHidden(std::array{glowing})) << "light does not depend on alpha";
    MaterialRecord all_pass = mask;
    all_pass.alpha_cutoff = 0;
    EXPECT_FALSE(isHidden(std::array{all_pass}));
}

TEST(CookTextures, fillsHiddenColorsOfMasks)
{
    const TemporaryFolder folder;
    const std::vector<Rgba8> texels = randomTexels(16, 16, 4, 8);
    const ImageRecord image = makeRecord(16, 16);
    const auto cook = [&](AlphaMode mode)
    {
        const MaterialRecord material = makeMaterial(mode);
        auto writer = ContainerWriter::create(folder.file("in.part"), ContainerKind::part);
        EXPECT_TRUE(writer->addChunk({.type = kChunkImageData}, toBytes(texels), 1, Codec::none).ok());
        EXPECT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, std::span(&image, 1)).ok());
        EXPECT_TRUE(writer->addRecords<MaterialRecord>(kChunkMaterials, std::span(&material, 1)).ok());
        EXPECT_TRUE(writer->finish().ok());
        EXPECT_TRUE(cookTextures(folder.file("in.part"), folder.file("out.part")).ok());
        const auto part = ContainerReader::open(folder.file("out.part"));
        const auto data = part->read(kChunkImageData);
        return decodeMip(image, {data->bytes().begin(), data->bytes().end()}, 0);
    };
    EXPECT_EQ(cook(AlphaMode::opaque), texels);
    EXPECT_EQ(cook(AlphaMode::mask), fillTexels(16, 16, texels));
}

} // namespace

} // namespace hearth::textures
