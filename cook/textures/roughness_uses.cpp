// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/roughness_uses.h"

#include "cook/textures/texel_codec.h"
#include "cook/textures/texture_place.h"
#include "formats/pack/image_uses.h"

#include <algorithm>

namespace hearth::textures
{

using namespace formats;

namespace
{

bool hasContent(std::span<const ImageRecord> images, uint32_t image, Content content)
{
    return image < images.size() && classifyContent(images[image]) == content;
}

/// Return the use of the roughness image of a material, which has one.
RoughnessUse describeUse(const MaterialRecord& material, std::span<const ImageRecord> images)
{
    const TextureRef& normals = material.normal_texture;
    if (material.normal_scale == 0 || !hasContent(images, normals.image, Content::normals) ||
        !liesOnSamePlace(normals, material.metallic_roughness_texture))
        return {};
    return {.normal_image = normals.image,
            .normal_scale = material.normal_scale,
            .roughness_factor = material.roughness};
}

/// Return the same use among some, after adding it if there is none.
RoughnessUse& findOrAdd(std::vector<RoughnessUse>& uses, RoughnessUse use)
{
    const auto found = std::ranges::find_if(uses,
                                            [&](const RoughnessUse& other)
                                            {
                                                return other.normal_image == use.normal_image &&
                                                       other.normal_scale == use.normal_scale &&
                                                       other.roughness_factor == use.roughness_factor;
                                            });
    return found != uses.end() ? *found : uses.emplace_back(std::move(use));
}

bool readsGreen(std::string_view role)
{
    return role != "metallicRoughness" && role != "occlusion";
}

} // namespace

std::vector<std::vector<RoughnessUse>> listRoughnessUses(std::span<const MaterialRecord> materials,
                                                         std::span<const MaterialLayersRecord> layers,
                                                         std::span<const ImageRecord> images)
{
    std::vector<std::vector<RoughnessUse>> uses(images.size());
    for (uint32_t i = 0; i < materials.size(); ++i)
    {
        const MaterialRecord& material = materials[i];
        const uint32_t image = material.metallic_roughness_texture.image;
        if ((material.flags & kMaterialUnlit) == 0 && material.roughness > 0 &&
            hasContent(images, image, Content::data))
            findOrAdd(uses[image], describeUse(material, images)).materials.push_back(i);
    }
    const std::vector<std::vector<ImageUse>> all = imageUses(materials, layers, images.size());
    for (size_t image = 0; image < images.size(); ++image)
        if (!uses[image].empty() &&
            std::ranges::any_of(all[image], [](const ImageUse& use) { return readsGreen(use.role); }))
            findOrAdd(uses[image], {});
    for (std::vector<RoughnessUse>& of_image : uses)
        std::ranges::stable_partition(of_image, [](const RoughnessUse& use)
                                      { return use.normal_image == kInvalidIndex; });
    return uses;
}

std::vector<RoughnessUse> listMissingRoughness(std::span<const MaterialRecord> materials,
                                               std::span<const ImageRecord> images)
{
    std::vector<RoughnessUse> uses;
    for (uint32_t i = 0; i < materials.size(); ++i)
    {
        const MaterialRecord& material = materials[i];
        if ((material.flags & kMaterialUnlit) != 0 || material.normal_scale == 0 ||
            material.metallic_roughness_texture.image != kInvalidIndex ||
            !hasContent(images, material.normal_texture.image, Content::normals))
            continue;
        findOrAdd(uses, {.normal_image = material.normal_texture.image,
                         .normal_scale = material.normal_scale,
                         .roughness_factor = material.roughness})
            .materials.push_back(i);
    }
    return uses;
}

} // namespace hearth::textures
