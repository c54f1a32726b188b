// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/constant_images.h"

#include "cook/textures/read_texels.h"
#include "cook/textures/texel_codec.h"
#include "formats/pack/image_uses.h"
#include "formats/pack/pack_view.h"

#include <cstring>
#include <optional>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Return the value of a channel, 0 to 1, if all texels have the same.
std::optional<float> findOneValue(const ImageRecord& image, std::span<const std::byte> texels,
                                  uint32_t channel)
{
    const size_t texel = texelBytes(image.format), size = texel / 4;
    const std::span<const std::byte> first = texels.subspan(channel * size, size);
    for (size_t at = channel * size; at < texels.size(); at += texel)
        if (std::memcmp(&texels[at], first.data(), size) != 0)
            return std::nullopt;
    if (size == 1)
        return static_cast<float>(std::to_integer<uint32_t>(first[0])) / 0xFF;
    uint16_t code = 0;
    std::memcpy(&code, first.data(), sizeof(code));
    return static_cast<float>(code) / 0xFFFF;
}

/// Replace an image that is an occlusion and nothing else.
void replaceOcclusion(const ImageRecord& image, std::span<const std::byte> texels,
                      std::span<const ImageUse> uses, std::span<MaterialRecord> materials)
{
    if (findOneValue(image, texels, 0) != 1.0f)
        return;
    for (const ImageUse& use : uses)
        materials[use.material].occlusion_texture.image = kInvalidIndex;
}

/// Replace an image that is a roughness and metalness and nothing else.
void replaceRoughness(const ImageRecord& image, std::span<const std::byte> texels,
                      std::span<const ImageUse> uses, std::span<MaterialRecord> materials)
{
    const std::optional<float> roughness = findOneValue(image, texels, 1),
                               metalness = findOneValue(image, texels, 2);
    if (!roughness || !metalness)
        return;
    for (const ImageUse& use : uses)
    {
        MaterialRecord& material = materials[use.material];
        material.roughness *= *roughness;
        material.metallic *= *metalness;
        material.metallic_roughness_texture.image = kInvalidIndex;
    }
}

} // namespace

Status replaceConstantImages(const ContainerReader& part, std::span<const ImageRecord> images,
                             std::span<const MaterialLayersRecord> layers,
                             std::vector<MaterialRecord>& materials)
{
    const std::vector<std::vector<ImageUse>> uses = imageUses(materials, layers, images.size());
    for (uint32_t i = 0; i < images.size(); ++i)
    {
        const bool is_occlusion = hasOnlyRole(uses[i], "occlusion");
        if (uses[i].empty() || classifyContent(images[i]) != Content::data ||
            (images[i].flags & kImagePlaceholder) != 0 ||
            (!is_occlusion && !hasOnlyRole(uses[i], "metallicRoughness")))
            continue;
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> texels, readTexels(part, images[i], i));
        if (is_occlusion)
            replaceOcclusion(images[i], texels, uses[i], materials);
        else
            replaceRoughness(images[i], texels, uses[i], materials);
    }
    return success();
}

} // namespace hearth::textures
