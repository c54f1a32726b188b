// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/join_occlusion.h"

#include "cook/textures/texel_codec.h"
#include "cook/textures/texture_place.h"
#include "formats/pack/image_uses.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Return whether the images are alike but for their texels. A placeholder stays visible as an image.
bool suits(const ImageRecord& occlusion, const ImageRecord& image)
{
    return occlusion.width == image.width && occlusion.height == image.height &&
           occlusion.format == image.format && classifyContent(image) == Content::data &&
           classifyContent(occlusion) == Content::data &&
           ((occlusion.flags | image.flags) & kImagePlaceholder) == 0;
}

/// Return the only occlusion image of the materials that use a metallic-roughness image; kInvalidIndex: none,
/// or it cannot join.
uint32_t findOnlyOcclusion(uint32_t image, std::span<const ImageUse> uses,
                           std::span<const MaterialRecord> materials, std::span<const ImageRecord> images)
{
    if (!hasOnlyRole(uses, "metallicRoughness"))
        return kInvalidIndex;
    uint32_t found = kInvalidIndex;
    for (const ImageUse& use : uses)
    {
        const MaterialRecord& material = materials[use.material];
        const TextureRef& occlusion = material.occlusion_texture;
        if (occlusion.image >= images.size())
            continue;
        if ((found != kInvalidIndex && found != occlusion.image) ||
            !suits(images[occlusion.image], images[image]) ||
            !liesOnSamePlace(occlusion, material.metallic_roughness_texture))
            return kInvalidIndex;
        found = occlusion.image;
    }
    return found;
}

} // namespace

std::vector<uint32_t> listJoinedOcclusion(std::span<const MaterialRecord> materials,
                                          std::span<const MaterialLayersRecord> layers,
                                          std::span<const ImageRecord> images)
{
    const std::vector<std::vector<ImageUse>> uses = imageUses(materials, layers, images.size());
    std::vector<uint32_t> joined(images.size(), kInvalidIndex);
    for (uint32_t i = 0; i < images.size(); ++i)
        joined[i] = findOnlyOcclusion(i, uses[i], materials, images);

    const auto becomesUseless = [&](uint32_t occlusion)
    {
        const auto isJoined = [&](const ImageUse& use)
        {
            const uint32_t image = materials[use.material].metallic_roughness_texture.image;
            return image < joined.size() && joined[image] == occlusion;
        };
        return hasOnlyRole(uses[occlusion], "occlusion") && std::ranges::all_of(uses[occlusion], isJoined);
    };
    for (uint32_t& occlusion : joined)
        if (occlusion != kInvalidIndex && !becomesUseless(occlusion))
            occlusion = kInvalidIndex;
    return joined;
}

void shareOcclusion(std::span<const uint32_t> joined, std::span<MaterialRecord> materials)
{
    for (MaterialRecord& material : materials)
    {
        const uint32_t image = material.metallic_roughness_texture.image;
        if (image < joined.size() && joined[image] != kInvalidIndex &&
            joined[image] == material.occlusion_texture.image)
            material.occlusion_texture.image = image;
    }
}

void copyRed(TexelFormat format, std::span<const std::byte> from, std::span<std::byte> to)
{
    const size_t texel = texelBytes(static_cast<uint32_t>(format));
    assert(from.size() == to.size() && (texel == 4 || texel == 8));
    for (size_t i = 0; i < from.size(); i += texel)
        std::memcpy(&to[i], &from[i], texel / 4);
}

} // namespace hearth::textures
