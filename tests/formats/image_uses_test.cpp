// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/image_uses.h"

#include <gtest/gtest.h>

namespace hearth::formats
{

namespace
{

MaterialRecord bareMaterial()
{
    MaterialRecord material{};
    material.base_color_texture.image = material.metallic_roughness_texture.image = kInvalidIndex;
    material.normal_texture.image = material.occlusion_texture.image = kInvalidIndex;
    material.emissive_texture.image = kInvalidIndex;
    return material;
}

std::string formatUses(const std::vector<ImageUse>& uses)
{
    std::string text;
    for (const ImageUse& use : uses)
        text += std::to_string(use.material) + " " + std::string(use.role) + ";";
    return text;
}

} // namespace

TEST(ImageUses, nameMaterialAndRole)
{
    std::vector<MaterialRecord> materials(3, bareMaterial());
    materials[0].base_color_texture.image = 1;
    materials[0].normal_texture.image = 0;
    materials[2].metallic_roughness_texture.image = 2;
    materials[2].occlusion_texture.image = 2;
    materials[2].base_color_texture.image = 1;
    materials[2].emissive_texture.image = 7; // does not exist
    std::vector<MaterialLayersRecord> layers{neutralLayers(1), neutralLayers(2)};
    layers[0].specular_texture.image = 3;
    layers[0].clearcoat_texture.image = 3;
    layers[1].clearcoat_normal_texture.image = 3;
    layers[1].sheen_texture.image = 1;
    const auto uses = imageUses(materials, layers, 4);
    ASSERT_EQ(uses.size(), 4u);
    EXPECT_EQ(formatUses(uses[0]), "0 normal;");
    EXPECT_EQ(formatUses(uses[1]), "0 baseColor;2 baseColor;2 sheen;");
    EXPECT_EQ(formatUses(uses[2]), "2 metallicRoughness;2 occlusion;");
    EXPECT_EQ(formatUses(uses[3]), "1 specular;1 clearcoat;2 clearcoatNormal;");
}

} // namespace hearth::formats
