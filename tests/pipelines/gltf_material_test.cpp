// Tests the import of materials, textures and images.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_view.h"
#include "formats/records/material_layers.h"
#include "pipelines/import/gltf/specular_glossiness.h"
#include "tests/pipelines/gltf_fixture.h"

#include <algorithm>
#include <cmath>

namespace hearth::import::test
{

namespace
{

using namespace formats;

/// Return an uncompressed TGA of one BGRA colour.
std::string tga(uint16_t width, uint16_t height, std::string_view bgra)
{
    std::string bytes("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
    bytes += toBytes<uint16_t>({width, height});
    bytes += std::string("\x20\x28", 2); // 32 bits, top to bottom, 8 bits of alpha
    for (int i = 0; i < width * height; ++i)
        bytes += bgra;
    return bytes;
}

const std::string kGrey = std::string("\x80\x80\x80\xFF", 4);

std::vector<MaterialRecord> getMaterials(const Imported& result)
{
    EXPECT_TRUE(result.ok()) << result.message();
    return result.ok() ? result.records<MaterialRecord>(kChunkMaterials) : std::vector<MaterialRecord>{};
}

TEST(GltfMaterials, haveTheDefaultsOfTheSpecification)
{
    const auto materials = getMaterials(GltfData().import(R"("materials":[{}])"));
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(materials[0].base_color, (Float4{1, 1, 1, 1}));
    EXPECT_EQ(materials[0].metallic, 1.0f);
    EXPECT_EQ(materials[0].roughness, 1.0f);
    EXPECT_EQ(materials[0].alpha_cutoff, 0.5f);
    EXPECT_EQ(materials[0].emissive, (Float3{0, 0, 0}));
    EXPECT_EQ(materials[0].base_color_texture.image, kInvalidIndex);
    EXPECT_EQ(materials[0].flags, 0u);
}

TEST(GltfMaterials, readFactorsFlagsAndExtensions)
{
    const Imported result =
        GltfData().import(R"("materials":[{"name":"lamp","doubleSided":true,"alphaMode":"BLEND",
        "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,"roughnessFactor":2},
        "emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_unlit":{},
        "KHR_materials_emissive_strength":{"emissiveStrength":8},"KHR_materials_iridescence":{"iridescenceFactor":1}}}])");
    const auto materials = getMaterials(result);
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(materials[0].base_color, (Float4{0.1f, 0.2f, 0.3f, 0.4f}));
    EXPECT_EQ(materials[0].metallic, 0.5f);
    EXPECT_EQ(materials[0].roughness, 1.0f);
    EXPECT_EQ(materials[0].emissive, (Float3{8, 4, 0}));
    EXPECT_EQ(materials[0].flags, uint32_t{kMaterialDoubleSided | kMaterialUnlit});
    EXPECT_EQ(materials[0].alpha_mode, static_cast<uint32_t>(AlphaMode::blend));
    EXPECT_TRUE(result.hasWarning(Issue::repaired, "outside 0 to 1"));
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "extension KHR_materials_iridescence"))
        << "also when it is not declared";
    EXPECT_EQ(result.text(kChunkStrings).substr(materials[0].name.offset, materials[0].name.length), "lamp");
}

std::vector<MaterialLayersRecord> getLayers(const Imported& result)
{
    EXPECT_TRUE(result.ok()) << result.message();
    return result.ok() && result.part->find(kChunkMaterialLayers) != nullptr
               ? result.records<MaterialLayersRecord>(kChunkMaterialLayers)
               : std::vector<MaterialLayersRecord>{};
}

TEST(GltfLayers, keepTheFactorsOfFourExtensions)
{
    const Imported result = GltfData().import(R"("materials":[{},{"extensions":{
        "KHR_materials_ior":{"ior":1.33},
        "KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[0.25,2,1]},
        "KHR_materials_clearcoat":{"clearcoatFactor":0.75,"clearcoatRoughnessFactor":0.125},
        "KHR_materials_sheen":{"sheenColorFactor":[0.5,0.25,0],"sheenRoughnessFactor":0.375}}},
        {"extensions":{"KHR_materials_ior":{"ior":0}}}])");
    const auto layers = getLayers(result);
    ASSERT_EQ(layers.size(), 2u) << "the first material has none";
    EXPECT_EQ(layers[0].material, 1u);
    EXPECT_EQ(layers[0].ior, 1.33f);
    EXPECT_EQ(layers[0].specular, 0.5f);
    EXPECT_EQ(layers[0].specular_color, (Float3{0.25f, 2, 1}));
    EXPECT_EQ(layers[0].clearcoat, 0.75f);
    EXPECT_EQ(layers[0].clearcoat_roughness, 0.125f);
    EXPECT_EQ(layers[0].clearcoat_normal_scale, 1.0f);
    EXPECT_EQ(layers[0].sheen_color, (Float3{0.5f, 0.25f, 0}));
    EXPECT_EQ(layers[0].sheen_roughness, 0.375f);
    for (TextureRef MaterialLayersRecord::*const texture : kLayerTextures)
        EXPECT_EQ((layers[0].*texture).image, kInvalidIndex);
    EXPECT_EQ(layers[1].material, 2u);
    EXPECT_EQ(layers[1].ior, 0.0f) << "reflects all light";
    EXPECT_FALSE(result.hasWarning(Issue::dropped, "KHR_materials"));
}

TEST(GltfLayers, thatChangeNothingAreNotWritten)
{
    const Imported result = GltfData().import(R"("materials":[{"extensions":{
        "KHR_materials_ior":{"ior":1.5},"KHR_materials_specular":{},
        "KHR_materials_clearcoat":{"clearcoatRoughnessFactor":0.5},
        "KHR_materials_sheen":{"sheenRoughnessFactor":0.5}}}])");
    EXPECT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.part->find(kChunkMaterialLayers), nullptr);
}

TEST(GltfLayers, areBroughtIntoTheirRanges)
{
    const Imported result = GltfData().import(R"("materials":[{"extensions":{
        "KHR_materials_ior":{"ior":0.5},
        "KHR_materials_specular":{"specularFactor":-1,"specularColorFactor":[-1,0,3]},
        "KHR_materials_clearcoat":{"clearcoatFactor":2,"clearcoatRoughnessFactor":3},
        "KHR_materials_sheen":{"sheenColorFactor":[1,2,0],"sheenRoughnessFactor":-1}}}])");
    const auto layers = getLayers(result);
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].ior, 1.0f);
    EXPECT_EQ(layers[0].specular, 0.0f);
    EXPECT_EQ(layers[0].specular_color, (Float3{0, 0, 3}));
    EXPECT_EQ(layers[0].clearcoat, 1.0f);
    EXPECT_EQ(layers[0].clearcoat_roughness, 1.0f);
    EXPECT_EQ(layers[0].sheen_color, (Float3{1, 1, 0}));
    EXPECT_EQ(layers[0].sheen_roughness, 0.0f);
    EXPECT_EQ(std::count_if(result.warnings.begin(), result.warnings.end(),
                            [](const Error& w) { return w.issue == Issue::repaired; }),
              7)
        << "one for each";
    for (const char* name : {"specularColorFactor is negative", "sheenColorFactor is not in 0 to 1"})
        EXPECT_TRUE(result.hasWarning(Issue::repaired, name)) << name;
    for (const char* wrong :
         {R"("KHR_materials_ior":{"ior":"1.5"})", R"("KHR_materials_specular":{"specularColorFactor":[1,1]})",
          R"("KHR_materials_clearcoat":{"clearcoatTexture":{"index":0}})",
          R"("KHR_materials_sheen":{"sheenColorTexture":3})"})
        EXPECT_FALSE(GltfData().import(std::string(R"("materials":[{"extensions":{)") + wrong + "}}]").ok())
            << wrong;
}

TEST(GltfLayers, ofMaterialsThatExcludeThemAreNamed)
{
    for (const char* other : {R"("KHR_materials_unlit":{})", R"("KHR_materials_pbrSpecularGlossiness":{})"})
        for (const char* layer :
             {R"("KHR_materials_ior":{"ior":1.2})", R"("KHR_materials_clearcoat":{"clearcoatFactor":1})",
              R"("KHR_materials_sheen":{"sheenColorFactor":[0,0.5,0]})"})
        {
            const Imported result = GltfData().import(
                std::string(R"("materials":[{"name":"oak","extensions":{)") + other + "," + layer + "}}]");
            EXPECT_TRUE(getLayers(result).empty());
            EXPECT_TRUE(result.hasWarning(
                Issue::dropped,
                "specular reflectance, clear coat and sheen of material \"oak\" are not kept"));
        }
}

/// Layers of a part with two textures, a.tga and b.tga.
struct TexturedLayers
{
    explicit TexturedLayers(const std::string& extensions, const std::string& textures = "")
    {
        folder.write("a.tga", tga(2, 1, std::string("\x10\x20\x30\x40", 4)));
        folder.write("b.tga", tga(1, 2, std::string("\x50\x60\x70\x80", 4)));
        result = importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.tga"},{"uri":"b.tga"}],
            "textures":[{"source":0},{"source":1},{"source":0})" +
                                 textures + R"(],"materials":[{"extensions":{)" + extensions + "}}]}",
                             &folder);
        const auto all = getLayers(result);
        EXPECT_EQ(all.size(), 1u);
        layers = all.empty() ? neutralLayers(0) : all[0];
    }

    ImageRecord image(const TextureRef& texture) const
    {
        return result.records<ImageRecord>(kChunkImages).at(texture.image);
    }

    /// First texel.
    std::vector<uint8_t> texel(const TextureRef& texture) const
    {
        std::vector<uint8_t> texels = result.texels(texture.image);
        texels.resize(4);
        return texels;
    }

    TemporaryFolder folder;
    Imported result;
    MaterialLayersRecord layers;
};

using Texel = std::vector<uint8_t>;

TEST(GltfLayers, useAnImageThatHasBothOfAPair)
{
    const TexturedLayers part(R"("KHR_materials_specular":{"specularTexture":{"index":0},
        "specularColorTexture":{"index":2}},"KHR_materials_clearcoat":{"clearcoatFactor":1,
        "clearcoatRoughnessFactor":1,"clearcoatTexture":{"index":0},"clearcoatRoughnessTexture":{"index":0},
        "clearcoatNormalTexture":{"index":1,"scale":0.5}},"KHR_materials_sheen":{"sheenColorFactor":[1,1,1],
        "sheenRoughnessFactor":1,"sheenColorTexture":{"index":0,"texCoord":1},
        "sheenRoughnessTexture":{"index":0,"texCoord":1}})");
    EXPECT_EQ(part.texel(part.layers.specular_texture), (Texel{0x30, 0x20, 0x10, 0x40}));
    EXPECT_EQ(part.image(part.layers.specular_texture).format,
              static_cast<uint32_t>(TexelFormat::rgba8_srgb));
    EXPECT_EQ(part.layers.specular_texture.image, part.layers.sheen_texture.image) << "written once";
    EXPECT_EQ(part.layers.sheen_texture.uv_set, 1);
    EXPECT_EQ(part.image(part.layers.clearcoat_texture).format,
              static_cast<uint32_t>(TexelFormat::rgba8_unorm));
    EXPECT_EQ(part.image(part.layers.clearcoat_normal_texture).flags, uint32_t{kImageNormalMap});
    EXPECT_EQ(part.layers.clearcoat_normal_scale, 0.5f);
    EXPECT_EQ(part.result.records<ImageRecord>(kChunkImages).size(), 3u);
}

TEST(GltfLayers, mergeTheChannelsOfAPair)
{
    const TexturedLayers part(R"("KHR_materials_specular":{"specularTexture":{"index":0},
        "specularColorTexture":{"index":1}},"KHR_materials_clearcoat":{"clearcoatFactor":1,
        "clearcoatRoughnessFactor":1,"clearcoatTexture":{"index":0},"clearcoatRoughnessTexture":{"index":1}},
        "KHR_materials_sheen":{"sheenColorFactor":[1,1,1],"sheenRoughnessFactor":1,
        "sheenColorTexture":{"index":0},"sheenRoughnessTexture":{"index":1}})");
    EXPECT_EQ(part.texel(part.layers.specular_texture), (Texel{0x70, 0x60, 0x50, 0x40}));
    const Texel coat = part.texel(part.layers.clearcoat_texture);
    EXPECT_EQ(coat[0], 0x30) << "R of the first";
    EXPECT_EQ(coat[1], 0x60) << "G of the second";
    EXPECT_EQ(part.texel(part.layers.sheen_texture), (Texel{0x30, 0x20, 0x10, 0x80}));
    EXPECT_EQ(part.image(part.layers.sheen_texture).width, 2u);
    EXPECT_EQ(part.image(part.layers.sheen_texture).height, 2u);
}

/// The channels that the missing texture would have are white.
TEST(GltfLayers, fillUpASingleTextureOfAPair)
{
    const TexturedLayers strength(R"("KHR_materials_specular":{"specularTexture":{"index":0}},
        "KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":1,
        "clearcoatRoughnessTexture":{"index":0}}, "KHR_materials_sheen":{"sheenColorFactor":[1,1,1],
        "sheenRoughnessFactor":1,"sheenRoughnessTexture":{"index":0}})");
    EXPECT_EQ(strength.texel(strength.layers.specular_texture), (Texel{255, 255, 255, 0x40}));
    EXPECT_EQ(strength.texel(strength.layers.clearcoat_texture)[0], 255);
    EXPECT_EQ(strength.texel(strength.layers.clearcoat_texture)[1], 0x20);
    EXPECT_EQ(strength.texel(strength.layers.sheen_texture), (Texel{255, 255, 255, 0x40}));
    const TexturedLayers color(R"("KHR_materials_specular":{"specularColorTexture":{"index":0}},
        "KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatTexture":{"index":0}})");
    EXPECT_EQ(color.texel(color.layers.specular_texture), (Texel{0x30, 0x20, 0x10, 255}));
    EXPECT_EQ(color.texel(color.layers.clearcoat_texture), (Texel{0x30, 0x20, 0x10, 0x40}))
        << "with a roughness of 0 the image itself serves";
}

TEST(GltfLayers, nameTheTextureThatLiesElsewhere)
{
    for (const char* second : {R"({"index":1,"texCoord":1})", R"({"index":3})",
                               R"({"index":1,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}})"})
    {
        const TexturedLayers part(std::string(R"("KHR_materials_sheen":{"sheenColorFactor":[1,1,1],
            "sheenRoughnessFactor":1,"sheenColorTexture":{"index":0},"sheenRoughnessTexture":)") +
                                      second + "}",
                                  R"(,{"source":1,"sampler":0}],"samplers":[{"wrapS":33071})");
        EXPECT_EQ(part.texel(part.layers.sheen_texture), (Texel{0x30, 0x20, 0x10, 255})) << second;
        EXPECT_TRUE(part.result.hasWarning(Issue::dropped,
                                           "sheenRoughnessTexture is not kept: it has another UV "
                                           "mapping or sampler than sheenColorTexture"));
    }
}

TEST(GltfLayers, keepWhatIsLeftOfABrokenPair)
{
    const TexturedLayers part(R"("KHR_materials_sheen":{"sheenColorFactor":[1,1,1],"sheenRoughnessFactor":1,
        "sheenColorTexture":{"index":3},"sheenRoughnessTexture":{"index":0}})",
                              ",{}");
    EXPECT_EQ(part.texel(part.layers.sheen_texture), (Texel{255, 255, 255, 0x40}));
    EXPECT_TRUE(part.result.hasWarning(Issue::image_missing, "material 0"));
}

TEST(GltfMaterials, transformUvsAsTheExtensionSays)
{
    const auto materials =
        getMaterials(GltfData().import(R"("textures":[{}],"materials":[{"pbrMetallicRoughness":
        {"baseColorTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":
        {"offset":[0.25,0.5],"rotation":1.5707963267948966,"scale":[2,3],"texCoord":2}}}}}])"));
    ASSERT_EQ(materials.size(), 1u);
    const TextureRef& texture = materials[0].base_color_texture;
    EXPECT_EQ(texture.uv_set, 2);
    // translation * rotation * scale with rotation [[cos sin] [-sin cos]]
    const float expected[6] = {0, 3, 0.25f, -2, 0, 0.5f};
    for (size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(texture.uv_transform[i], expected[i], 1e-6) << i;
}

TEST(GltfMaterials, readSamplers)
{
    const auto materials =
        getMaterials(GltfData().import(R"("samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}],
        "textures":[{"sampler":0},{}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},
        "emissiveTexture":{"index":1}}])"));
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(materials[0].base_color_texture.wrap_u, static_cast<uint8_t>(Wrap::clamp_to_edge));
    EXPECT_EQ(materials[0].base_color_texture.wrap_v, static_cast<uint8_t>(Wrap::mirrored_repeat));
    EXPECT_EQ(materials[0].base_color_texture.nearest, 1);
    EXPECT_EQ(materials[0].emissive_texture.wrap_u, static_cast<uint8_t>(Wrap::repeat));
    EXPECT_EQ(materials[0].emissive_texture.nearest, 0);
}

TEST(GltfMaterials, dropTexturesOfUvSetsThatNoMeshCanHave)
{
    for (const char* set : {"4", "99", "4294967296"})
    {
        const Imported result = GltfData().import(
            std::string(R"("textures":[{}],"materials":[{"emissiveTexture":{"index":0,"texCoord":)") + set +
            "}}]");
        EXPECT_EQ(getMaterials(result)[0].emissive_texture.image, kInvalidIndex);
        EXPECT_TRUE(result.hasWarning(Issue::dropped, "UV set"));
    }
}

TEST(GltfImages, areWrittenOnceForEachPurpose)
{
    const TemporaryFolder folder;
    folder.write("a.tga", tga(2, 1, kGrey));
    const Imported result = importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.tga"}],
        "textures":[{"source":0},{"source":0}],"materials":[
        {"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":1}},
         "normalTexture":{"index":0},"occlusionTexture":{"index":0},"emissiveTexture":{"index":1}},
        {"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}}]})",
                                        &folder);
    const auto materials = getMaterials(result);
    const auto images = result.records<ImageRecord>(kChunkImages);
    ASSERT_EQ(images.size(), 3u);
    EXPECT_EQ(materials[0].base_color_texture.image, materials[0].emissive_texture.image);
    EXPECT_EQ(materials[0].base_color_texture.image, materials[1].base_color_texture.image);
    EXPECT_EQ(materials[0].metallic_roughness_texture.image, materials[0].occlusion_texture.image);
    const ImageRecord& color = images[materials[0].base_color_texture.image];
    const ImageRecord& data = images[materials[0].occlusion_texture.image];
    const ImageRecord& normal = images[materials[0].normal_texture.image];
    EXPECT_EQ(color.format, static_cast<uint32_t>(TexelFormat::rgba8_srgb));
    EXPECT_EQ(data.format, static_cast<uint32_t>(TexelFormat::rgba8_unorm));
    EXPECT_EQ(normal.format, static_cast<uint32_t>(TexelFormat::rgba8_unorm));
    EXPECT_EQ(normal.flags, uint32_t{kImageNormalMap});
    EXPECT_EQ(color.width, 2u);
    EXPECT_EQ(color.mip_count, 1u);
    EXPECT_EQ(result.texels(0), (std::vector<uint8_t>{128, 128, 128, 255, 128, 128, 128, 255}));
    EXPECT_EQ(result.text(kChunkStrings).substr(color.name.offset, color.name.length), "a.tga");
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_EQ(result.warnings[0].issue, Issue::nothing_drawn) << "and nothing about images";
}

TEST(GltfImages, sayOnceThatAlphaIsNotOpacity)
{
    const TemporaryFolder folder;
    std::string area(495, '\0'); // the last byte is attributes type 0: there is no alpha
    folder.write("a.tga", tga(2, 1, std::string("\x80\x80\x80\0", 4)) + area + toBytes<uint32_t>({26, 0}) +
                              std::string("TRUEVISION-XFILE.\0", 18));
    const Imported result = importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.tga"}],
        "textures":[{"source":0}],"materials":[{"name":"oak","normalTexture":{"index":0},
        "pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0}}}]})",
                                        &folder);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.texels(0)[3], 255);
    const std::string expected =
        "test.gltf|/images/0: warning: image \"a.tga\" of material \"oak\": alpha is not opacity, as "
        "attributes type 0 of the TGA's extension area says: it is not kept [W1304] hint: if it is opacity, "
        "save the image as PNG, or as TGA with attributes type 3";
    EXPECT_EQ(std::count_if(result.warnings.begin(), result.warnings.end(),
                            [&](const Error& warning) { return formatMessage(warning) == expected; }),
              1)
        << formatMessage(result.warnings.at(0));
}

/// Return a PNG of 2 x 1 texels with 16 bits a channel: (0x8123, 0x7F45, 0xFF67), (0x0102, 0x0304, 0x0506).
std::string png16()
{
    constexpr char kBytes[] =
        "\x89\x50\x4E\x47\x0D\x0A\x1A\x0A\x00\x00\x00\x0D\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00"
        "\x00\x01\x10\x02\x00\x00\x00\x2B\xD0\x34\x9E\x00\x00\x00\x15\x49\x44\x41\x54\x78\xDA\x63"
        "\x68\x54\xAE\x77\xFD\x9F\xCE\xC8\xC4\xCC\xC2\xCA\x06\x00\x19\xFE\x02\xE4\xC7\xB0\xF4\xC8"
        "\x00\x00\x00\x00\x49\x45\x4E\x44\xAE\x42\x60\x82";
    return {kBytes, sizeof(kBytes) - 1};
}

TEST(GltfImages, keepSixteenBits)
{
    const TemporaryFolder folder;
    folder.write("a.png", png16());
    const Imported result = importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.png"}],
        "textures":[{"source":0}],"materials":[{"name":"oak","normalTexture":{"index":0},
        "pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0}}}]})",
                                        &folder);
    const auto materials = getMaterials(result);
    const auto images = result.records<ImageRecord>(kChunkImages);
    ASSERT_EQ(images.size(), 3u);
    const uint32_t color = materials.at(0).base_color_texture.image;
    const uint32_t data = materials[0].metallic_roughness_texture.image;
    const uint32_t normal = materials[0].normal_texture.image;
    EXPECT_EQ(images[color].format, static_cast<uint32_t>(TexelFormat::rgba16_srgb));
    EXPECT_EQ(images[data].format, static_cast<uint32_t>(TexelFormat::rgba16_unorm));
    EXPECT_EQ(images[normal].format, static_cast<uint32_t>(TexelFormat::rgba16_unorm));
    const std::vector<uint8_t> expected{0x23, 0x81, 0x45, 0x7F, 0x67, 0xFF, 0xFF, 0xFF,
                                        0x02, 0x01, 0x04, 0x03, 0x06, 0x05, 0xFF, 0xFF};
    EXPECT_EQ(result.texels(color), expected);
    EXPECT_EQ(result.texels(data), expected);
    EXPECT_EQ(result.texels(normal), expected);
    const std::string warning =
        "test.gltf|/images/0: warning: image \"a.png\" of material \"oak\": its colours have 16 bits a "
        "channel, "
        "8 are kept; mips are made from all 16 [W1306] hint: colours need 8 bits; save light as EXR or HDR";
    EXPECT_EQ(std::count_if(result.warnings.begin(), result.warnings.end(),
                            [](const Error& w) { return w.issue == Issue::image_depth; }),
              1)
        << "data and normals lose nothing";
    EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(),
                            [&](const Error& w) { return formatMessage(w) == warning; }));
}

TEST(GltfImages, sayThatSpecularGlossinessTakesEightBits)
{
    const TemporaryFolder folder;
    folder.write("a.png", png16());
    const Imported result = importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.png"}],
        "textures":[{"source":0}],"materials":[{"name":"oak","extensions":{"KHR_materials_pbrSpecularGlossiness":
        {"specularGlossinessTexture":{"index":0}}}}]})",
                                        &folder);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_TRUE(result.hasWarning(
        Issue::image_depth, "specular-glossiness of material \"oak\" was converted in 8 bits a channel"));
    for (const ImageRecord& image : result.records<ImageRecord>(kChunkImages))
        EXPECT_EQ(texelBytes(image.format), 4u);
}

TEST(GltfImages, keepTheCutoffOfAlphaTests)
{
    const TemporaryFolder folder;
    folder.write("a.tga", tga(1, 1, kGrey));
    const Imported result =
        importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.tga"}],"textures":[{"source":0}],
        "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
        {"alphaMode":"MASK","alphaCutoff":0.25,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5],"baseColorTexture":{"index":0}}}]})",
                    &folder);
    ASSERT_TRUE(result.ok()) << result.message();
    const auto images = result.records<ImageRecord>(kChunkImages);
    ASSERT_EQ(images.size(), 1u);
    EXPECT_EQ(images[0].flags, uint32_t{kImageAlphaTested});
    EXPECT_EQ(images[0].alpha_cutoff, 0.5f) << "of the texture's own alpha";
}

TEST(GltfImages, becomePlaceholdersWhenTheyAreMissingOrBroken)
{
    const std::pair<const char*, Issue> cases[] = {
        {R"({"uri":"absent.png"})", Issue::image_missing},
        {R"({})", Issue::image_missing},
        {R"({"uri":"../outside.png"})", Issue::image_replaced},
        {R"({"uri":"data:image/png;base64,AAAA"})", Issue::image_replaced},
        {R"({"uri":"data:image/png;base64,%"})", Issue::image_replaced},
    };
    for (const auto& [image, issue] : cases)
    {
        const Imported result = GltfData().import(
            std::string(R"("textures":[{"source":0}],"images":[)") + image +
            R"(],"materials":[{"emissiveTexture":{"index":0},"normalTexture":{"index":0}}])");
        const auto materials = getMaterials(result);
        const auto images = result.records<ImageRecord>(kChunkImages);
        ASSERT_EQ(images.size(), 2u);
        const uint32_t color = materials[0].emissive_texture.image;
        const uint32_t normal = materials[0].normal_texture.image;
        EXPECT_EQ(images[color].flags, uint32_t{kImagePlaceholder});
        EXPECT_EQ(images[normal].flags, uint32_t{kImagePlaceholder | kImageNormalMap});
        EXPECT_EQ(images[color].width, 64u);
        EXPECT_EQ(result.texels(color)[0], 255);
        EXPECT_EQ(result.texels(color)[1], 0);
        EXPECT_EQ(result.texels(normal)[2], 255) << "a missing normal map leaves the surface as it is";
        EXPECT_TRUE(result.hasWarning(issue, "")) << image;
    }
}

TEST(GltfImages, nameTheirMaterialAndTheNearestFileWhereTheyAreMissing)
{
    const TemporaryFolder folder;
    folder.write("textures/wood.tga", tga(1, 1, kGrey));
    folder.write("textures/notes.txt", "wood.png");
    std::filesystem::create_symlink("/etc/hostname", folder.path("textures/link.png"));
    struct Row
    {
        const char* uri; ///< as written in JSON
        const char* path;
        const char* nearest;
    };
    const Row rows[] = {
        {"textures/Wood.TGA", "textures/Wood.TGA", R"("textures/wood.tga", whose letters differ in case)"},
        {R"(textures\\wood.tga)", R"(textures\wood.tga)",
         R"("textures/wood.tga", with '/' between folders, not '\')"},
        {"wood.tga", "wood.tga", R"("textures/wood.tga", in another folder)"},
        {"textures/wood.png", "textures/wood.png", R"("textures/wood.tga", in another format)"},
        {"Wood.png", "Wood.png", R"("textures/wood.tga", in another folder and format)"},
        {"textures/wo%6Fds.tga", "textures/woods.tga", R"("textures/wood.tga")"},
        {"../art/wood.tga", "../art/wood.tga", R"("textures/wood.tga", in another folder)"},
        {"./Textures/wood.tga", "./Textures/wood.tga",
         R"("textures/wood.tga", whose letters differ in case)"},
        {"textures/stone.png", "textures/stone.png", ""},
        {"textures/link.png", "textures/link.png", ""},
        {"textures/notes.png", "textures/notes.png", ""},
    };
    for (const Row& row : rows)
    {
        const Imported result = importBytes(
            R"({"asset":{"version":"2.0"},"images":[{"uri":")" + std::string(row.uri) +
                R"("}],"textures":[{"source":0}],"materials":[{"name":"oak","emissiveTexture":{"index":0}}]})",
            &folder);
        ASSERT_TRUE(result.ok()) << result.message();
        ASSERT_EQ(result.warnings.size(), 2u) << row.uri << ": the other is of a source without triangles";
        const std::string& detail = result.warnings[0].detail;
        EXPECT_NE(detail.find(R"(of material "oak": ")" + std::string(row.path) + R"(" beside test.gltf: )"),
                  std::string::npos)
            << detail;
        const size_t nearest = detail.find("; nearest: ");
        EXPECT_EQ(nearest == std::string::npos ? "" : detail.substr(nearest + 11), row.nearest) << detail;
        EXPECT_EQ(result.text(kChunkMeta).find("nearest"), std::string::npos)
            << "the part does not depend on files that were not read";
    }
}

TEST(GltfImages, preferTheOneOfTheTextureAndElseThatOfAnExtension)
{
    const TemporaryFolder folder;
    folder.write("a.tga", tga(1, 1, kGrey));
    folder.write("b.tga", tga(2, 2, kGrey));
    const auto getWidth = [&](const std::string& texture)
    {
        const Imported result =
            importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"a.tga"},{"uri":"b.tga"}],
            "extensionsRequired":["EXT_texture_webp"],"materials":[{"emissiveTexture":{"index":0}}],"textures":[)" +
                            texture + "]}",
                        &folder);
        EXPECT_TRUE(result.ok()) << result.message();
        return result.records<ImageRecord>(kChunkImages)[0].width;
    };
    EXPECT_EQ(getWidth(R"({"source":0,"extensions":{"EXT_texture_webp":{"source":1}}})"), 1u);
    EXPECT_EQ(getWidth(R"({"extensions":{"EXT_texture_webp":{"source":1}}})"), 2u);
    EXPECT_EQ(getWidth(R"({"extensions":{"KHR_texture_basisu":{"source":1}}})"), 2u);
}

TEST(GltfImages, areNamedWhenNothingUsesThem)
{
    const Imported result = GltfData().import(R"("images":[{"name":"spare","uri":"absent.png"}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "spare"));
    EXPECT_FALSE(result.hasWarning(Issue::image_missing, ""));
}

TEST(SpecularGlossiness, ofADielectricKeepsItsColor)
{
    const MetallicRoughness result =
        convertSpecularGlossiness({{0.5f, 0.25f, 0.125f}, {0.04f, 0.04f, 0.04f}, 0.75f});
    EXPECT_NEAR(result.metallic, 0, 1e-3);
    EXPECT_NEAR(result.roughness, 0.25, 1e-6);
    EXPECT_NEAR(result.base_color.x, 0.5, 2e-3);
    EXPECT_NEAR(result.base_color.z, 0.125, 2e-3);
}

TEST(SpecularGlossiness, ofAMetalTakesTheColorOfItsReflection)
{
    const MetallicRoughness result = convertSpecularGlossiness({{0, 0, 0}, {1, 0.75f, 0.25f}, 1});
    EXPECT_NEAR(result.metallic, 1, 1e-5);
    EXPECT_NEAR(result.roughness, 0, 1e-6);
    EXPECT_NEAR(result.base_color.x, 1, 1e-5);
    EXPECT_NEAR(result.base_color.y, 0.75, 1e-5);
    EXPECT_NEAR(result.base_color.z, 0.25, 1e-5);
}

TEST(SpecularGlossiness, isConvertedTexelByTexel)
{
    const TemporaryFolder folder;
    folder.write("diffuse.tga", tga(1, 1, std::string("\0\0\xFF\x80", 4))); // red, alpha 0.5
    folder.write("specular.tga", tga(2, 1, std::string("\0\0\0\x40", 4)));  // no reflection, glossiness 0.25
    const Imported result =
        importBytes(R"({"asset":{"version":"2.0"},"images":[{"uri":"diffuse.tga"},{"uri":"specular.tga"}],
        "extensionsRequired":["KHR_materials_pbrSpecularGlossiness"],
        "textures":[{"source":0},{"source":1}],"materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor":[1,1,1,1],"diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1}}}}]})",
                    &folder);
    const auto materials = getMaterials(result);
    ASSERT_EQ(materials.size(), 1u);
    const auto images = result.records<ImageRecord>(kChunkImages);
    const uint32_t base = materials[0].base_color_texture.image;
    const uint32_t surface = materials[0].metallic_roughness_texture.image;
    ASSERT_LT(base, images.size());
    ASSERT_LT(surface, images.size());
    EXPECT_EQ(images[base].width, 2u);
    EXPECT_EQ(images[base].format, static_cast<uint32_t>(TexelFormat::rgba8_srgb));
    EXPECT_EQ(images[surface].format, static_cast<uint32_t>(TexelFormat::rgba8_unorm));
    const auto base_texels = result.texels(base);
    EXPECT_EQ(base_texels[0], 255);
    EXPECT_EQ(base_texels[1], 0);
    EXPECT_EQ(base_texels[3], 128);
    EXPECT_EQ(result.texels(surface)[1], 255 - 64);
    EXPECT_EQ(result.texels(surface)[2], 0);
    EXPECT_TRUE(result.hasWarning(Issue::degraded, "specular-glossiness"));
}

} // namespace

} // namespace hearth::import::test
