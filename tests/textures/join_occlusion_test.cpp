// Checks which images of occlusion, roughness and metalness are given up, and that materials lose nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/join_occlusion.h"

#include "cook/textures/mip_chain.h"
#include "cook/textures/texture_part.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"
#include "tests/textures/texture_test_images.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <tuple>

namespace hearth::textures
{

namespace
{

using namespace test;
using namespace formats;
using hearth::test::TemporaryFolder;

TextureRef refer(uint32_t image, uint8_t uv_set = 0)
{
    return {image, uv_set, 0, 0, 0, {1, 0, 0, 0, 1, 0}};
}

MaterialRecord makeMaterial(uint32_t metallic_roughness, uint32_t occlusion)
{
    MaterialRecord material{};
    for (TextureRef MaterialRecord::*const field : kMaterialTextureFields)
        material.*field = refer(kInvalidIndex);
    material.roughness = material.normal_scale = material.occlusion_strength = 1;
    material.metallic_roughness_texture = refer(metallic_roughness);
    material.occlusion_texture = refer(occlusion);
    return material;
}

/// Texture of a material, with the channels that shaders read: 1 red, 2 green, 4 blue, 8 alpha.
struct ReadTexture
{
    TextureRef texture;
    uint32_t channels;
    bool is_occlusion = false;
    bool is_roughness = false;
};

std::vector<ReadTexture> listTextures(std::span<const MaterialRecord> materials,
                                      std::span<const MaterialLayersRecord> layers)
{
    std::vector<ReadTexture> textures;
    for (const MaterialRecord& material : materials)
    {
        textures.push_back({material.base_color_texture, 15});
        textures.push_back({material.metallic_roughness_texture, 6, false, true});
        textures.push_back({material.normal_texture, 3});
        textures.push_back({material.occlusion_texture, 1, true});
        textures.push_back({material.emissive_texture, 7});
    }
    for (const MaterialLayersRecord& layer : layers)
    {
        textures.push_back({layer.specular_texture, 15});
        textures.push_back({layer.clearcoat_texture, 3});
        textures.push_back({layer.clearcoat_normal_texture, 3});
        textures.push_back({layer.sheen_texture, 15});
    }
    return textures;
}

/// Images and materials of an import part.
struct Scene
{
    std::vector<ImageRecord> images{};
    std::vector<std::vector<std::byte>> texels{};
    std::vector<MaterialRecord> materials{};
    std::vector<MaterialLayersRecord> layers{};

    void addImage(ImageRecord image)
    {
        texels.push_back(randomBytes(static_cast<size_t>(mipOffset(image, 1)),
                                     100 + static_cast<uint32_t>(images.size())));
        images.push_back(image);
    }
};

/// Textures part in memory.
struct Cooked
{
    std::vector<ImageRecord> images{};
    std::vector<std::vector<std::byte>> mips{};
    std::vector<MaterialRecord> materials{}; ///< those of the scene, if the part has none
    std::vector<MaterialLayersRecord> layers{};
};

Cooked cook(const Scene& scene, const TextureOptions& options)
{
    const TemporaryFolder folder;
    auto writer = ContainerWriter::create(folder.file("in.part"), ContainerKind::part);
    EXPECT_TRUE(writer.ok());
    for (uint32_t i = 0; i < scene.images.size(); ++i)
        EXPECT_TRUE(
            writer->addChunk({.type = kChunkImageData, .index = i}, scene.texels[i], 1, Codec::none).ok());
    EXPECT_TRUE(writer->addRecords<ImageRecord>(kChunkImages, scene.images).ok());
    EXPECT_TRUE(writer->addRecords<MaterialRecord>(kChunkMaterials, scene.materials).ok());
    EXPECT_TRUE(writer->addRecords<MaterialLayersRecord>(kChunkMaterialLayers, scene.layers).ok());
    EXPECT_TRUE(writer->finish().ok());
    const Status status = cookTextures(folder.file("in.part"), folder.file("out.part"), options);
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : formatMessage(status.error()));

    const auto part = ContainerReader::open(folder.file("out.part"));
    const auto images = part->records<ImageRecord>(kChunkImages);
    Cooked cooked{
        .images = {images->begin(), images->end()}, .materials = scene.materials, .layers = scene.layers};
    for (uint32_t i = 0; i < cooked.images.size(); ++i)
    {
        const auto data = part->read(kChunkImageData, i);
        EXPECT_TRUE(data.ok());
        cooked.mips.emplace_back(data->bytes().begin(), data->bytes().end());
    }
    EXPECT_EQ(part->find(kChunkImageData, static_cast<uint32_t>(cooked.images.size())), nullptr);
    if (part->find(kChunkMaterials) != nullptr)
    {
        const auto materials = part->records<MaterialRecord>(kChunkMaterials);
        const auto layers = part->records<MaterialLayersRecord>(kChunkMaterialLayers);
        cooked.materials.assign(materials->begin(), materials->end());
        cooked.layers.assign(layers->begin(), layers->end());
    }
    return cooked;
}

bool isSamePlace(const TextureRef& a, const TextureRef& b)
{
    return std::equal(a.uv_transform, a.uv_transform + 6, b.uv_transform) &&
           std::tie(a.uv_set, a.wrap_u, a.wrap_v) == std::tie(b.uv_set, b.wrap_u, b.wrap_v);
}

/// Return whether all uses of an occlusion image allow it to join, by asking each pair of materials.
bool canJoin(const Scene& scene, uint32_t occlusion)
{
    const auto isUsedElsewhere = [&](uint32_t image, bool ReadTexture::*role)
    {
        return std::ranges::any_of(listTextures(scene.materials, scene.layers), [&](const ReadTexture& read)
                                   { return read.texture.image == image && !(read.*role); });
    };
    const auto suits = [&](const MaterialRecord& material)
    {
        const uint32_t image = material.metallic_roughness_texture.image;
        const ImageRecord& own = scene.images[occlusion];
        return image != kInvalidIndex && scene.images[image].width == own.width &&
               scene.images[image].height == own.height && scene.images[image].format == own.format &&
               isSamePlace(material.metallic_roughness_texture, material.occlusion_texture) &&
               !isUsedElsewhere(image, &ReadTexture::is_roughness);
    };
    if (isUsedElsewhere(occlusion, &ReadTexture::is_occlusion))
        return false;
    uint32_t uses = 0;
    for (const MaterialRecord& a : scene.materials)
    {
        if (a.occlusion_texture.image != occlusion)
            continue;
        ++uses;
        if (!suits(a))
            return false;
        for (const MaterialRecord& b : scene.materials)
            if (b.metallic_roughness_texture.image == a.metallic_roughness_texture.image &&
                b.occlusion_texture.image != kInvalidIndex &&
                (b.occlusion_texture.image != occlusion || !suits(b)))
                return false;
    }
    return uses > 0;
}

Scene makeScene(uint32_t seed)
{
    Scene scene;
    for (uint32_t i = 0; i < 5; ++i)
        scene.addImage(makeRecord(8, 4, TexelFormat::rgba8_unorm));
    scene.addImage(makeRecord(4, 4, TexelFormat::rgba8_unorm));
    for (uint32_t i = 0; i < 2; ++i)
        scene.addImage(makeRecord(8, 4, TexelFormat::rgba16_unorm));
    std::mt19937 random(seed);
    const auto pick = [&](uint32_t count) { return static_cast<uint32_t>(random() % count); };
    const auto pickImage = [&](uint32_t one_in)
    { return pick(one_in) == 0 ? pick(static_cast<uint32_t>(scene.images.size())) : kInvalidIndex; };
    const uint32_t count = 1 + pick(3);
    for (uint32_t i = 0; i < count; ++i)
    {
        MaterialRecord material = makeMaterial(pickImage(1), pick(4) == 0 ? kInvalidIndex : pickImage(1));
        material.emissive_texture.image = pickImage(12);
        material.occlusion_texture.uv_set = pick(8) == 0 ? 1 : 0;
        material.metallic_roughness_texture.uv_transform[2] = pick(8) == 0 ? 0.5f : 0;
        scene.materials.push_back(material);
        if (pick(6) != 0)
            continue;
        scene.layers.push_back(neutralLayers(i));
        scene.layers.back().clearcoat_texture.image = pickImage(2);
    }
    return scene;
}

/// Expect that a texture has the same texels in the channels that are read, and the same place.
void expectSameTexels(const Scene& scene, const Cooked& cooked, const ReadTexture& before,
                      const ReadTexture& after)
{
    EXPECT_TRUE(isSamePlace(before.texture, after.texture));
    if (before.texture.image == kInvalidIndex)
    {
        EXPECT_EQ(after.texture.image, kInvalidIndex);
        return;
    }
    ASSERT_LT(after.texture.image, cooked.images.size());
    const ImageRecord& image = scene.images[before.texture.image];
    const std::vector<std::byte> expected = buildMipChain(image, scene.texels[before.texture.image]);
    const std::vector<std::byte>& actual = cooked.mips[after.texture.image];
    EXPECT_EQ(cooked.images[after.texture.image].width, image.width);
    EXPECT_EQ(cooked.images[after.texture.image].format, image.format);
    ASSERT_EQ(actual.size(), expected.size());
    const size_t channel_bytes = texelBytes(image.format) / 4;
    for (size_t i = 0; i < actual.size(); ++i)
    {
        const bool is_read = (before.channels >> (i / channel_bytes % 4) & 1u) != 0;
        ASSERT_TRUE(!is_read || actual[i] == expected[i]) << i;
    }
}

TEST(JoinOcclusion, materialsReadTheSameTexelsFromFewerImages)
{
    size_t cooks = 0;
    for (uint32_t seed = 0; cooks < hearth::test::trials(40); ++seed)
    {
        ASSERT_LT(seed, 10'000u) << "few scenes have an image that can join";
        const Scene scene = makeScene(seed);
        std::vector<uint32_t> expected;
        for (uint32_t image = 0; image < scene.images.size(); ++image)
            if (canJoin(scene, image))
                expected.push_back(image);
        std::vector<uint32_t> joined = listJoinedOcclusion(scene.materials, scene.layers, scene.images);
        std::ranges::sort(joined);
        joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
        std::erase(joined, kInvalidIndex);
        ASSERT_EQ(joined, expected) << seed;
        if (expected.empty())
            continue;
        ++cooks;
        const Cooked cooked = cook(scene, {.specular_aa = false});
        ASSERT_EQ(cooked.images.size(), scene.images.size() - expected.size()) << seed;
        const std::vector<ReadTexture> before = listTextures(scene.materials, scene.layers);
        const std::vector<ReadTexture> after = listTextures(cooked.materials, cooked.layers);
        ASSERT_EQ(before.size(), after.size());
        for (size_t i = 0; i < before.size(); ++i)
            expectSameTexels(scene, cooked, before[i], after[i]);
        ASSERT_FALSE(HasFailure()) << seed;
    }
}

TEST(JoinOcclusion, whatCannotShareAnImageStays)
{
    Scene scene;
    for (uint32_t i = 0; i < 3; ++i)
        scene.addImage(makeRecord(8, 8, TexelFormat::rgba8_unorm));
    scene.materials = {makeMaterial(0, 1)};
    const auto countJoined = [&](const auto& change)
    {
        Scene changed = scene;
        change(changed);
        const std::vector<uint32_t> joined =
            listJoinedOcclusion(changed.materials, changed.layers, changed.images);
        return std::ranges::count_if(joined, [](uint32_t image) { return image != kInvalidIndex; });
    };
    EXPECT_EQ(countJoined([](Scene&) {}), 1);
    EXPECT_EQ(countJoined([](Scene& s) { s.images[1].width = 4; }), 0);
    EXPECT_EQ(countJoined([](Scene& s) { s.images[1].flags = kImagePlaceholder; }), 0);
    EXPECT_EQ(countJoined([](Scene& s) { s.materials[0].occlusion_texture.uv_set = 1; }), 0);
    EXPECT_EQ(countJoined([](Scene& s) { s.materials[0].occlusion_texture.wrap_v = 1; }), 0);
    EXPECT_EQ(countJoined([](Scene& s) { s.materials[0].occlusion_texture.uv_transform[0] = 2; }), 0);
    EXPECT_EQ(countJoined([](Scene& s) { s.materials[0].occlusion_texture.image = 0; }), 0);
    EXPECT_EQ(countJoined([](Scene& s) { s.materials[0].occlusion_texture.image = 9; }), 0);
    EXPECT_EQ(countJoined([](Scene& s) { s.materials.push_back(makeMaterial(0, 2)); }), 0)
        << "its red would be two";
    EXPECT_EQ(countJoined([](Scene& s) { s.materials.push_back(makeMaterial(kInvalidIndex, 1)); }), 0)
        << "the occlusion image would be needed all the same";
    EXPECT_EQ(countJoined([](Scene& s) { s.materials.push_back(makeMaterial(2, 1)); }), 2);
    EXPECT_EQ(countJoined([](Scene& s) { s.materials.push_back(makeMaterial(0, kInvalidIndex)); }), 1);
}

TEST(JoinOcclusion, followsARoughnessThatIsSplit)
{
    Scene scene;
    scene.addImage(makeRecord(8, 8, TexelFormat::rgba8_unorm));
    scene.addImage(makeRecord(8, 8, TexelFormat::rgba8_unorm));
    scene.addImage(makeRecord(8, 8, TexelFormat::rgba8_unorm, kImageNormalMap));
    scene.materials.assign(2, makeMaterial(1, 0));
    scene.materials[0].normal_texture = refer(2);
    const Cooked cooked = cook(scene, {});
    ASSERT_EQ(cooked.images.size(), 3u) << "the occlusion is gone, a second roughness came";
    EXPECT_NE(cooked.materials[0].metallic_roughness_texture.image,
              cooked.materials[1].metallic_roughness_texture.image);
    for (uint32_t i = 0; i < 2; ++i)
    {
        EXPECT_EQ(cooked.materials[i].occlusion_texture.image,
                  cooked.materials[i].metallic_roughness_texture.image);
        expectSameTexels(scene, cooked, {scene.materials[i].occlusion_texture, 1},
                         {cooked.materials[i].occlusion_texture, 1});
    }
    EXPECT_EQ(cooked.materials[0].normal_texture.image, 1u);
}

TEST(ConstantImages, becomeFactors)
{
    Scene scene;
    for (uint32_t i = 0; i < 4; ++i)
        scene.addImage(makeRecord(8, 8, TexelFormat::rgba8_unorm));
    scene.addImage(makeRecord(8, 8, TexelFormat::rgba16_unorm));
    for (const auto& [image, channel, value] :
         {std::array{0u, 1u, 51u}, {0u, 2u, 255u}, {1u, 0u, 255u}, {2u, 0u, 254u}, {3u, 1u, 51u}})
        for (size_t i = channel; i < scene.texels[image].size(); i += 4)
            scene.texels[image][i] = static_cast<std::byte>(value);
    for (size_t i = 0; i < scene.texels[4].size(); i += 8)
        for (const size_t byte : {2u, 3u, 4u, 5u})
            scene.texels[4][i + byte] = std::byte{0x33};
    scene.materials = {makeMaterial(0, 1), makeMaterial(3, 2), makeMaterial(4, 1)};
    for (MaterialRecord& material : scene.materials)
    {
        material.roughness = 0.5f;
        material.metallic = 0.75f;
    }
    scene.materials[1].occlusion_texture.uv_set = 1; // so that it does not join
    const Cooked cooked = cook(scene, {});
    ASSERT_EQ(cooked.images.size(), 2u);
    EXPECT_EQ(cooked.materials[0].metallic_roughness_texture.image, kInvalidIndex);
    EXPECT_EQ(cooked.materials[0].occlusion_texture.image, kInvalidIndex) << "all texels are 1";
    EXPECT_FLOAT_EQ(cooked.materials[0].roughness, 0.1f);
    EXPECT_FLOAT_EQ(cooked.materials[0].metallic, 0.75f);
    EXPECT_EQ(cooked.materials[1].metallic_roughness_texture.image, 1u) << "its metalness differs";
    EXPECT_EQ(cooked.materials[1].occlusion_texture.image, 0u) << "it is not quite 1";
    EXPECT_EQ(cooked.materials[1].roughness, 0.5f);
    EXPECT_EQ(cooked.materials[2].metallic_roughness_texture.image, kInvalidIndex);
    EXPECT_FLOAT_EQ(cooked.materials[2].roughness, 0.1f) << "of 16 bits, too";
    EXPECT_FLOAT_EQ(cooked.materials[2].metallic, 0.15f);

    scene.images[0].flags = kImagePlaceholder;
    scene.materials[1].emissive_texture = refer(1);
    const Cooked others = cook(scene, {});
    EXPECT_EQ(others.images.size(), 4u) << "a placeholder stays, and an image that is read elsewhere, too";
}

} // namespace

} // namespace hearth::textures
