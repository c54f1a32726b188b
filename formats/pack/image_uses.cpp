// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/image_uses.h"

namespace hearth::formats
{

namespace
{

struct Role
{
    TextureRef MaterialRecord::*texture;
    std::string_view name;
};

constexpr Role kRoles[] = {{&MaterialRecord::base_color_texture, "baseColor"},
                           {&MaterialRecord::metallic_roughness_texture, "metallicRoughness"},
                           {&MaterialRecord::normal_texture, "normal"},
                           {&MaterialRecord::occlusion_texture, "occlusion"},
                           {&MaterialRecord::emissive_texture, "emissive"}};

} // namespace

std::vector<std::vector<ImageUse>> imageUses(std::span<const MaterialRecord> materials, size_t image_count)
{
    std::vector<std::vector<ImageUse>> uses(image_count);
    for (uint32_t material = 0; material < materials.size(); ++material)
        for (const Role& role : kRoles)
            if (const uint32_t image = (materials[material].*role.texture).image; image < image_count)
                uses[image].push_back({material, role.name});
    return uses;
}

} // namespace hearth::formats
