// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"

#include "cook/textures/mip_chain.h"
#include "formats/container/container_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/textures/texture_test_images.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace hearth::textures
{

namespace
{

using namespace test;
using namespace formats;
using hearth::test::TemporaryFolder;

/// Write an import part with these images, omitting the texels of image `lost`.
void writeImport(const std::string& path, std::span<const ImageRecord> images,
                 std::span<const std::vector<std::byte>> texels)
{
    auto writer = ContainerWriter::create(path, ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    for (uint32_t i = 0; i < texels.size(); ++i)
        ASSERT_TRUE(writer->addChunk({.type = kChunkImageData, .index = i}, texels[i], 1, Codec::none).ok());
    ASSERT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, images).ok());
    ASSERT_TRUE(writer->finish().ok());
}

TEST(CookTextures, writesEveryImageWithItsMips)
{
    const TemporaryFolder folder;
    std::vector<ImageRecord> images = {makeRecord(12, 7), makeRecord(4, 4, TexelFormat::rgba16_float)};
    images[0].name = {3, 4};
    const std::vector<std::vector<std::byte>> texels = {randomBytes(12 * 7 * 4, 1),
                                                        std::vector<std::byte>(4 * 4 * 8)};
    writeImport(folder.file("in.part"), images, texels);
    ASSERT_TRUE(cookTextures(folder.file("in.part"), folder.file("out.part")).ok());

    const auto part = ContainerReader::open(folder.file("out.part"));
    ASSERT_TRUE(part.ok());
    const auto records = part->records<ImageRecord>(kChunkImages);
    ASSERT_TRUE(records.ok());
    ASSERT_EQ(records->size(), 2u);
    for (uint32_t i = 0; i < 2; ++i)
    {
        const auto data = part->read(kChunkImageData, i);
        ASSERT_TRUE(data.ok());
        EXPECT_EQ((*records)[i].mip_count, fullMipCount(images[i].width, images[i].height));
        const std::vector<std::byte> expected = buildMipChain(images[i], texels[i]);
        EXPECT_TRUE(std::equal(expected.begin(), expected.end(), data->bytes().begin(), data->bytes().end()));
    }
    EXPECT_EQ((*records)[0].name.offset, 3u);
}

TEST(CookTextures, sayTheErrorOfColoursThatHadSixteenBits)
{
    const TemporaryFolder folder;
    const std::vector<ImageRecord> images = {makeRecord(8, 8, TexelFormat::rgba16_srgb),
                                             makeRecord(8, 8, TexelFormat::rgba16_unorm)};
    std::vector<std::byte> opaque = randomBytes(8 * 8 * 8, 1);
    for (size_t texel = 0; texel < 64; ++texel)
        opaque[texel * 8 + 6] = opaque[texel * 8 + 7] = std::byte{0xFF};
    const std::vector<std::vector<std::byte>> texels = {opaque, opaque};
    writeImport(folder.file("in.part"), images, texels);
    std::vector<ImageStatistics> statistics;
    ASSERT_TRUE(cookTextures(folder.file("in.part"), folder.file("out.part"), {}, &statistics).ok());
    ASSERT_EQ(statistics.size(), 2u);
    EXPECT_EQ(statistics[0].image.format, static_cast<uint32_t>(TexelFormat::rgba8_srgb));
    EXPECT_EQ(statistics[1].image.format, static_cast<uint32_t>(TexelFormat::rgba16_unorm));
    // rounding to a step of 1 / 255 is off by 1 / sqrt(12) of a step, in three of four channels
    EXPECT_NEAR(*statistics[0].error, std::sqrt(3.0 / 4 / 12) / 255, 1e-4);
    EXPECT_EQ(statistics[1].error, 0);
    const auto part = ContainerReader::open(folder.file("out.part"));
    ASSERT_TRUE(part.ok());
    EXPECT_EQ(part->find(kChunkImageData, 0)->size, (64u + 16 + 4 + 1) * 4);
    EXPECT_EQ(part->find(kChunkImageData, 1)->size, (64u + 16 + 4 + 1) * 8);

    std::vector<ImageStatistics> narrow;
    ASSERT_TRUE(
        cookTextures(folder.file("in.part"), folder.file("narrow.part"), {.max_bits = 8}, &narrow).ok());
    EXPECT_EQ(narrow[0].error, statistics[0].error);
    EXPECT_EQ(narrow[1].image.format, static_cast<uint32_t>(TexelFormat::rgba8_unorm));
    EXPECT_NEAR(*narrow[1].error, std::sqrt(3.0 / 4 / 12) / 255, 1e-4) << "its alpha is 65535";
    const auto narrow_part = ContainerReader::open(folder.file("narrow.part"));
    ASSERT_TRUE(narrow_part.ok());
    EXPECT_EQ(narrow_part->find(kChunkImageData, 1)->size, (64u + 16 + 4 + 1) * 4);
}

TEST(CookTextures, leavesOutMipsThatAreTooLarge)
{
    const TemporaryFolder folder;
    const std::vector<ImageRecord> images = {makeRecord(12, 7), makeRecord(5, 16), makeRecord(1, 1)};
    const std::vector<std::vector<std::byte>> texels = {randomBytes(12 * 7 * 4, 1),
                                                        randomBytes(5 * 16 * 4, 2), randomBytes(4, 3)};
    writeImport(folder.file("in.part"), images, texels);
    // number of finest mips that are dropped: of 12 x 7, 5 x 16, 1 x 1
    const std::vector<std::pair<uint32_t, std::array<uint32_t, 3>>> rows = {
        {16, {0, 0, 0}}, {12, {0, 1, 0}}, {11, {1, 1, 0}}, {6, {1, 2, 0}}, {1, {3, 4, 0}}};
    for (const auto& [max_size, left_out] : rows)
    {
        ASSERT_TRUE(
            cookTextures(folder.file("in.part"), folder.file("out.part"), {.max_size = max_size}).ok());
        const auto part = ContainerReader::open(folder.file("out.part"));
        ASSERT_TRUE(part.ok());
        const auto records = part->records<ImageRecord>(kChunkImages);
        ASSERT_TRUE(records.ok());
        for (uint32_t i = 0; i < 3; ++i)
        {
            const ImageRecord& kept = (*records)[i];
            EXPECT_EQ(kept.width, std::max(1u, images[i].width >> left_out[i])) << max_size << ' ' << i;
            EXPECT_EQ(kept.height, std::max(1u, images[i].height >> left_out[i])) << max_size << ' ' << i;
            EXPECT_EQ(kept.mip_count, fullMipCount(images[i].width, images[i].height) - left_out[i]);
            const std::vector<std::byte> chain = buildMipChain(images[i], texels[i]);
            const auto data = part->read(kChunkImageData, i);
            ASSERT_TRUE(data.ok());
            ASSERT_LE(data->bytes().size(), chain.size());
            EXPECT_EQ(data->bytes().size(), mipOffset(kept, kept.mip_count));
            EXPECT_TRUE(std::equal(data->bytes().rbegin(), data->bytes().rend(), chain.rbegin()));
        }
    }
}

TEST(CookTextures, saysWhatBecameOfEachImage)
{
    const TemporaryFolder folder;
    std::vector<ImageRecord> images = {makeRecord(12, 7), makeRecord(4, 4, TexelFormat::rgba16_float)};
    images[0].name = {3, 400}; // outside of the strings
    const std::vector<std::vector<std::byte>> texels = {randomBytes(12 * 7 * 4, 1),
                                                        std::vector<std::byte>(4 * 4 * 8)};
    writeImport(folder.file("in.part"), images, texels);
    std::vector<ImageStatistics> statistics;
    ASSERT_TRUE(cookTextures(folder.file("in.part"), folder.file("out.part"), {}, &statistics).ok());
    const auto part = ContainerReader::open(folder.file("out.part"));
    ASSERT_EQ(statistics.size(), 2u);
    for (uint32_t i = 0; i < 2; ++i)
    {
        EXPECT_EQ(statistics[i].name, "");
        EXPECT_EQ(statistics[i].stored_bytes, part->find(kChunkImageData, i)->stored_size);
        EXPECT_EQ(statistics[i].bytes, part->find(kChunkImageData, i)->size);
    }
    EXPECT_TRUE(statistics[0].uses.empty()) << "there are no materials";
    EXPECT_GT(statistics[0].half_error, 0.1);
    EXPECT_FALSE(statistics[1].half_error);
    EXPECT_EQ(statistics[0].error, 0);

    std::vector<ImageStatistics> smaller;
    ASSERT_TRUE(
        cookTextures(folder.file("in.part"), folder.file("small.part"), {.max_size = 6}, &smaller).ok());
    EXPECT_EQ(smaller[0].image.width, 6u);
    EXPECT_EQ(smaller[0].error, statistics[0].half_error) << "it has half of its size now";
    EXPECT_GE(smaller[0].half_error, smaller[0].error);
}

TEST(CookTextures, saysWhichMaterialsShowAnImage)
{
    const TemporaryFolder folder;
    const std::string_view strings = "Bark";
    std::array<MaterialRecord, 2> materials{};
    for (MaterialRecord& material : materials)
        for (TextureRef* texture :
             {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
              &material.occlusion_texture, &material.emissive_texture})
            texture->image = kInvalidIndex;
    materials[1].name = {0, 4};
    materials[0].emissive_texture.image = 1;
    materials[1].normal_texture.image = 1;
    const ImageRecord image = makeRecord(1, 1);
    {
        auto writer = ContainerWriter::create(folder.file("in.part"), ContainerKind::part);
        ASSERT_TRUE(writer.ok());
        for (uint32_t i = 0; i < 2; ++i)
            ASSERT_TRUE(
                writer->addChunk({.type = kChunkImageData, .index = i}, randomBytes(4, 1), 1, Codec::none)
                    .ok());
        ASSERT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, std::array{image, image}).ok());
        ASSERT_TRUE(writer->addRecords<MaterialRecord>(kChunkMaterials, materials).ok());
        ASSERT_TRUE(
            writer->addChunk({.type = kChunkStrings}, std::as_bytes(std::span(strings)), 1, Codec::none)
                .ok());
        ASSERT_TRUE(writer->finish().ok());
    }
    std::vector<ImageStatistics> statistics;
    ASSERT_TRUE(cookTextures(folder.file("in.part"), folder.file("out.part"), {}, &statistics).ok());
    ASSERT_EQ(statistics.size(), 2u);
    EXPECT_TRUE(statistics[0].uses.empty());
    ASSERT_EQ(statistics[1].uses.size(), 2u);
    EXPECT_EQ(statistics[1].uses[0].material, "");
    EXPECT_EQ(statistics[1].uses[0].role, "emissive");
    EXPECT_EQ(statistics[1].uses[1].material, "Bark");
    EXPECT_EQ(statistics[1].uses[1].role, "normal");
}

TEST(CookTextures, partWithoutImagesGivesAnEmptyTable)
{
    const TemporaryFolder folder;
    writeImport(folder.file("in.part"), {}, {});
    ASSERT_TRUE(cookTextures(folder.file("in.part"), folder.file("out.part")).ok());
    const auto part = ContainerReader::open(folder.file("out.part"));
    ASSERT_TRUE(part.ok());
    EXPECT_EQ(part->records<ImageRecord>(kChunkImages)->size(), 0u);
}

TEST(CookTextures, refusesDamagedRecordsAndLeavesNoOutput)
{
    struct Case
    {
        const char* name;
        ImageRecord image;
        size_t bytes;
        Issue issue;
    };
    ImageRecord unknown_format = makeRecord(2, 2);
    unknown_format.format = 77;
    const Case cases[] = {
        {"no texels", makeRecord(0, 4), 0, Issue::meaning_value},
        {"too large", makeRecord(16385, 1), 16385 * 4, Issue::meaning_value},
        {"unknown format", unknown_format, 16, Issue::meaning_value},
        {"too few bytes", makeRecord(4, 4), 63, Issue::chunk_size},
    };
    for (const Case& c : cases)
    {
        const TemporaryFolder folder;
        const std::vector<std::byte> texels(c.bytes);
        writeImport(folder.file("in.part"), {&c.image, 1}, {&texels, 1});
        const Status status = cookTextures(folder.file("in.part"), folder.file("out.part"));
        ASSERT_FALSE(status.ok()) << c.name;
        EXPECT_EQ(status.error().issue, c.issue) << c.name;
        EXPECT_EQ(folder.files(), std::set<std::string>{"in.part"}) << c.name;
    }
}

TEST(CookTextures, refusesAMissingPartAndMissingTexels)
{
    const TemporaryFolder folder;
    EXPECT_EQ(cookTextures(folder.file("none.part"), folder.file("out.part")).error().issue,
              Issue::input_missing);
    const ImageRecord image = makeRecord(2, 2);
    writeImport(folder.file("in.part"), {&image, 1}, {});
    EXPECT_EQ(cookTextures(folder.file("in.part"), folder.file("out.part")).error().issue,
              Issue::chunk_missing);
}

} // namespace

} // namespace hearth::textures
