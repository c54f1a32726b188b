// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/image_uses.h"

#include <algorithm>

namespace hearth::formats
{

namespace
{

template <typename Record>
struct Role
{
    TextureRef Record::*texture;
    std::string_view name;
};

constexpr Role<MaterialRecord> kRoles[] = {{&MaterialRecord::base_color_texture, "baseColor"},
                                           {&MaterialRecord::metallic_roughness_texture, "metallicRoughness"},
                                           {&MaterialRecord::normal_texture, "normal"},
                                           {&MaterialRecord::occlusion_texture, "occlusion"},
                                           {&MaterialRecord::emissive_texture, "emissive"}};

constexpr Role<MaterialLayersRecord> kLayerRoles[] = {
    {&MaterialLayersRecord::specular_texture, "specular"},
    {&MaterialLayersRecord::clearcoat_texture, "clearcoat"},
    {&MaterialLayersRecord::clearcoat_normal_texture, "clearcoatNormal"},
    {&MaterialLayersRecord::sheen_texture, "sheen"}};

template <typename Record>
void addUses(const Record& record, uint32_t material, std::span<const Role<Record>> roles,
             std::vector<std::vector<ImageUse>>& uses)
{
    for (const Role<Record>& role : roles)
        if (const uint32_t image = (record.*role.texture).image; image < uses.size())
            uses[image].push_back({material, role.name});
}

} // namespace

std::vector<std::vector<ImageUse>> imageUses(std::span<const MaterialRecord> materials,
                                             std::span<const MaterialLayersRecord> layers, size_t image_count)
{
    std::vector<std::vector<ImageUse>> uses(image_count);
    for (uint32_t material = 0; material < materials.size(); ++material)
    {
        addUses<MaterialRecord>(materials[material], material, kRoles, uses);
        if (const MaterialLayersRecord* const record = findLayers(layers, material))
            addUses<MaterialLayersRecord>(*record, material, kLayerRoles, uses);
    }
    return uses;
}

bool hasOnlyRole(std::span<const ImageUse> uses, std::string_view role)
{
    return std::ranges::all_of(uses, [&](const ImageUse& use) { return use.role == role; });
}

} // namespace hearth::formats
