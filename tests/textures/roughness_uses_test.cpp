// Normal maps over roughness images, and the mips that hearth-textures makes of both.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/roughness_uses.h"

#include "cook/textures/mip_chain.h"
#include "cook/textures/roughness_images.h"
#include "cook/textures/texture_part.h"
#include "formats/container/container_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/textures/texture_test_images.h"

#include <gtest/gtest.h>

namespace hearth::textures
{

namespace
{

using namespace test;
using namespace formats;
using hearth::test::TemporaryFolder;

constexpr std::string_view kStrings = "ormbricks_normal"; ///< names of the first two images
constexpr uint32_t kRoughness = 0, kNormals = 1, kColor = 3;

TextureRef refer(uint32_t image)
{
    return {image, 0, 0, 0, 0, {1, 0, 0, 0, 1, 0}};
}

/// Return a material with a roughness image and a normal map.
MaterialRecord makeMaterial(uint32_t normal_image = kNormals)
{
    MaterialRecord material{};
    for (TextureRef MaterialRecord::*const field : kMaterialTextureFields)
        material.*field = refer(kInvalidIndex);
    material.roughness = 1;
    material.normal_scale = 1;
    material.metallic_roughness_texture = refer(kRoughness);
    material.normal_texture = refer(normal_image);
    return material;
}

std::vector<ImageRecord> makeImages()
{
    std::vector<ImageRecord> images = {makeRecord(16, 16, TexelFormat::rgba8_unorm),
                                       makeRecord(32, 16, TexelFormat::rgba8_unorm, kImageNormalMap),
                                       makeRecord(16, 16, TexelFormat::rgba8_unorm, kImageNormalMap),
                                       makeRecord(16, 16)};
    images[kRoughness].name = {0, 3};
    images[kNormals].name = {3, 13};
    return images;
}

std::vector<RoughnessUse> listUses(std::span<const MaterialRecord> materials,
                                   std::span<const MaterialLayersRecord> layers = {})
{
    const std::vector<ImageRecord> images = makeImages();
    const auto uses = listRoughnessUses(materials, layers, images);
    EXPECT_EQ(uses.size(), images.size());
    for (uint32_t image = 1; image < images.size(); ++image)
        EXPECT_TRUE(uses[image].empty()) << image;
    return uses[kRoughness];
}

TEST(RoughnessUses, materialsWithEqualMapsAndFactorsAreOne)
{
    std::vector<MaterialRecord> materials(4, makeMaterial());
    materials[1].normal_scale = 0.5f;
    materials[2].normal_texture.nearest = 1;
    materials[3].roughness = 0.5f;
    const std::vector<RoughnessUse> uses = listUses(materials);
    ASSERT_EQ(uses.size(), 3u);
    EXPECT_EQ(uses[0].normal_image, kNormals);
    EXPECT_EQ(uses[0].materials, (std::vector<uint32_t>{0, 2}));
    EXPECT_EQ(uses[1].normal_scale, 0.5f);
    EXPECT_EQ(uses[2].roughness_factor, 0.5f);
}

TEST(RoughnessUses, aMapAtAnotherPlaceDoesNotCount)
{
    const auto losesNormals = [](const auto& change)
    {
        MaterialRecord material = makeMaterial();
        change(material);
        const std::vector<RoughnessUse> uses = listUses({&material, 1});
        EXPECT_EQ(uses.size(), 1u);
        return uses.front().normal_image != kInvalidIndex;
    };
    EXPECT_TRUE(losesNormals([](MaterialRecord&) {}));
    EXPECT_FALSE(losesNormals([](MaterialRecord& m) { m.normal_texture.uv_set = 1; }));
    EXPECT_FALSE(losesNormals([](MaterialRecord& m) { m.normal_texture.wrap_u = 2; }));
    EXPECT_FALSE(losesNormals([](MaterialRecord& m) { m.metallic_roughness_texture.wrap_v = 1; }));
    EXPECT_FALSE(losesNormals([](MaterialRecord& m) { m.normal_texture.uv_transform[4] = 2; }));
    EXPECT_FALSE(losesNormals([](MaterialRecord& m) { m.normal_scale = 0; }));
    EXPECT_FALSE(losesNormals([](MaterialRecord& m) { m.normal_texture = refer(kInvalidIndex); }));
    EXPECT_FALSE(losesNormals([](MaterialRecord& m) { m.normal_texture = refer(kColor); }));
}

TEST(RoughnessUses, materialsThatDoNotReadRoughnessDoNotCount)
{
    std::vector<MaterialRecord> materials(3, makeMaterial());
    materials[0].flags = kMaterialUnlit;
    materials[1].roughness = 0;
    materials[2].metallic_roughness_texture = refer(kInvalidIndex);
    materials[2].occlusion_texture = refer(kRoughness);
    EXPECT_TRUE(listUses(materials).empty());
    materials.push_back(makeMaterial());
    EXPECT_EQ(listUses(materials).size(), 1u);
    MaterialLayersRecord layers = neutralLayers(2);
    layers.clearcoat_texture = refer(kRoughness);
    const std::vector<RoughnessUse> uses = listUses(materials, {&layers, 1});
    ASSERT_EQ(uses.size(), 2u) << "a clear coat reads green, too";
    EXPECT_EQ(uses[0].normal_image, kInvalidIndex);
}

TEST(RoughnessImages, areComparedMipByMip)
{
    ImageRecord image = makeRecord(4, 4, TexelFormat::rgba8_unorm);
    image.mip_count = 3;
    std::vector<std::byte> a = filled(4, 4, {7, 100, 7, 7});
    for (const int code : {100, 100, 100, 120, 105})
        for (const int value : {0, code, 0, 0})
            a.push_back(static_cast<std::byte>(value));
    EXPECT_NEAR(findRoughnessRise(image, a), 10.0 / 255, 1e-6) << "sqrt(20^2 / 4), more than the last rises";
    std::vector<std::byte> b = a;
    EXPECT_EQ(findRoughnessDifference(image, a, b), 0);
    b[16 * 4 + 1] = std::byte{106};
    b[0] = std::byte{0};
    EXPECT_NEAR(findRoughnessDifference(image, a, b), 3.0 / 255, 1e-6) << "sqrt(6^2 / 4)";
    b[20 * 4 + 1] = std::byte{100};
    EXPECT_NEAR(findRoughnessDifference(image, a, b), 5.0 / 255, 1e-6);
}

class RoughnessPart : public ::testing::Test
{
protected:
    RoughnessPart()
    {
        texels.push_back(filled(16, 16, {0, 60, 0, 255}));
        texels.back()[2] = std::byte{9}; // one metalness everywhere would become a factor
        texels.push_back(randomBytes(32 * 16 * 4, 1));
        for (size_t z = 2; z < texels.back().size(); z += 4)
            texels.back()[z] = std::byte{255};
        texels.push_back(randomBytes(16 * 16 * 4, 2));
        texels.push_back(randomBytes(16 * 16 * 4, 3));
    }

    /// Cook the images with these materials, and return the mips of the roughness.
    std::vector<std::byte> cook(std::span<const MaterialRecord> materials, const TextureOptions& options = {})
    {
        auto writer = ContainerWriter::create(folder.file("in.part"), ContainerKind::part);
        EXPECT_TRUE(writer.ok());
        for (uint32_t i = 0; i < texels.size(); ++i)
            EXPECT_TRUE(
                writer->addChunk({.type = kChunkImageData, .index = i}, texels[i], 1, Codec::none).ok());
        EXPECT_TRUE(writer->addText(kChunkStrings, kStrings).ok());
        EXPECT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, images).ok());
        EXPECT_TRUE(writer->addRecords<MaterialRecord>(kChunkMaterials, materials).ok());
        EXPECT_TRUE(writer->finish().ok());
        const Status status = cookTextures(folder.file("in.part"), folder.file("out.part"), options);
        EXPECT_TRUE(status.ok()) << (status.ok() ? "" : formatMessage(status.error()));
        const auto part = ContainerReader::open(folder.file("out.part"));
        const auto data = part->read(kChunkImageData, kRoughness);
        return {data->bytes().begin(), data->bytes().end()};
    }

    /// Return the name of an image of the cooked part.
    std::string findName(uint32_t image) const
    {
        const auto part = ContainerReader::open(folder.file("out.part"));
        const auto data = part->read(kChunkStrings);
        const std::string strings(reinterpret_cast<const char*>(data->bytes().data()), data->bytes().size());
        const StringRef name = (*part->records<ImageRecord>(kChunkImages))[image].name;
        EXPECT_TRUE(strings.starts_with(kStrings));
        EXPECT_LE(name.offset + name.length, strings.size());
        return strings.substr(name.offset, name.length);
    }

    std::vector<std::byte> expect(uint32_t normal_image, float scale, float factor)
    {
        RoughnessFilter filter({images[normal_image], texels[normal_image], scale, factor});
        return buildMipChain(images[kRoughness], texels[kRoughness], 16, &filter);
    }

    const TemporaryFolder folder;
    const std::vector<ImageRecord> images = makeImages();
    std::vector<std::vector<std::byte>> texels;
};

TEST_F(RoughnessPart, isWidenedByTheNormalMapOfItsMaterial)
{
    const std::vector<std::byte> plain = buildMipChain(images[kRoughness], texels[kRoughness]);
    std::vector<MaterialRecord> materials(2, makeMaterial());
    materials[0].normal_scale = materials[1].normal_scale = 0.5f;
    EXPECT_EQ(cook(materials), expect(kNormals, 0.5f, 1));
    EXPECT_NE(cook(materials), plain);
    EXPECT_EQ(cook(materials, {.specular_aa = false}), plain);
    materials[0].normal_texture = materials[1].normal_texture = refer(kInvalidIndex);
    EXPECT_EQ(cook(materials), plain);
}

TEST_F(RoughnessPart, isSplitWhereNormalMapsDiffer)
{
    std::vector<MaterialRecord> materials(4, makeMaterial());
    materials[1].normal_scale = 0.2f;
    materials[2].normal_scale = 0.2001f;
    materials[3].normal_texture = refer(kInvalidIndex);
    materials[3].occlusion_texture = refer(kRoughness);
    EXPECT_EQ(cook(materials), buildMipChain(images[kRoughness], texels[kRoughness]))
        << "without a normal map it stays";
    const auto part = ContainerReader::open(folder.file("out.part"));
    const auto records = part->records<ImageRecord>(kChunkImages);
    const auto changed = part->records<MaterialRecord>(kChunkMaterials);
    ASSERT_EQ(records->size(), 6u);
    ASSERT_EQ(changed->size(), 4u);
    const std::array<uint32_t, 4> expected{4, 5, 5, kRoughness};
    for (uint32_t i = 0; i < 4; ++i)
    {
        EXPECT_EQ((*changed)[i].metallic_roughness_texture.image, expected[i]) << i;
        EXPECT_EQ((*changed)[i].normal_texture.image, materials[i].normal_texture.image);
        EXPECT_EQ((*changed)[i].roughness, 1);
    }
    EXPECT_EQ((*changed)[3].occlusion_texture.image, kRoughness);
    const auto mips = [&](uint32_t image)
    {
        const auto data = part->read(kChunkImageData, image);
        return std::vector<std::byte>(data->bytes().begin(), data->bytes().end());
    };
    EXPECT_EQ(mips(4), expect(kNormals, 1, 1));
    EXPECT_EQ(mips(5), expect(kNormals, 0.2f, 1));
    EXPECT_EQ((*records)[4].mip_count, (*records)[0].mip_count);
    EXPECT_EQ(findName(kRoughness), "orm");
    EXPECT_EQ(findName(4), "orm roughness");
    EXPECT_EQ(findName(5), "orm roughness 2");
    EXPECT_FALSE(ContainerReader::open(folder.file("out.part"))->find(kChunkImageData, 6));
}

TEST_F(RoughnessPart, isMadeWhereItRises)
{
    std::vector<MaterialRecord> materials(3, makeMaterial());
    for (MaterialRecord& material : materials)
    {
        material.metallic_roughness_texture = refer(kInvalidIndex);
        material.normal_texture.uv_set = 1;
        material.roughness = 0.3f;
    }
    materials[1].roughness = 0;
    materials[2].normal_scale = 0.001f; // hardly a bump
    cook(materials);
    const auto part = ContainerReader::open(folder.file("out.part"));
    const auto records = part->records<ImageRecord>(kChunkImages);
    const auto changed = part->records<MaterialRecord>(kChunkMaterials);
    ASSERT_EQ(records->size(), 6u);
    ASSERT_EQ(changed->size(), 3u);
    for (uint32_t i = 0; i < 2; ++i)
    {
        const MaterialRecord& material = (*changed)[i];
        const ImageRecord& made = (*records)[4 + i];
        EXPECT_EQ(material.metallic_roughness_texture.image, 4 + i);
        EXPECT_EQ(material.metallic_roughness_texture.uv_set, 1) << "it lies where the normals do";
        EXPECT_EQ(findName(4 + i), i == 0 ? "bricks_normal roughness" : "bricks_normal roughness 2");
        EXPECT_EQ(made.width, 16u);
        EXPECT_EQ(made.height, 8u);
        const auto data = part->read(kChunkImageData, 4 + i);
        const std::vector<Rgba8> finest = decodeMip(made, {data->bytes().begin(), data->bytes().end()}, 0);
        const std::vector<Rgba8> next = decodeMip(made, {data->bytes().begin(), data->bytes().end()}, 1);
        EXPECT_EQ(material.roughness, 1);
        EXPECT_NEAR(finest[0][1], materials[i].roughness * 255, 0.5) << "near by, the surface is what it was";
        EXPECT_EQ(finest[0][2], 255) << "the metalness is the factor's";
        EXPECT_GT(next[0][1], finest[0][1] + 50);
    }
    EXPECT_EQ((*changed)[2].metallic_roughness_texture.image, kInvalidIndex);

    cook(materials, {.specular_aa = false});
    EXPECT_EQ(ContainerReader::open(folder.file("out.part"))->find(kChunkMaterials), nullptr);
}

TEST_F(RoughnessPart, damagedNormalMapIsAnError)
{
    texels[kNormals].resize(8);
    const MaterialRecord material = makeMaterial();
    auto writer = ContainerWriter::create(folder.file("in.part"), ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    for (uint32_t i = 0; i < 2; ++i)
        ASSERT_TRUE(writer->addChunk({.type = kChunkImageData, .index = i}, texels[i], 1, Codec::none).ok());
    ASSERT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, std::span(images).first(2)).ok());
    ASSERT_TRUE(writer->addRecords<MaterialRecord>(kChunkMaterials, std::span(&material, 1)).ok());
    ASSERT_TRUE(writer->finish().ok());
    EXPECT_EQ(cookTextures(folder.file("in.part"), folder.file("out.part")).error().issue, Issue::chunk_size);
}

} // namespace

} // namespace hearth::textures
