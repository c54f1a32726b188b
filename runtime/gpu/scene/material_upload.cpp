// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/materials/material_shaders.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "runtime/gpu/scene/texture_upload.h"
#include "runtime/gpu/textures/streamed_textures.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace hearth::gpu
{

namespace
{

VkSamplerAddressMode addressMode(uint8_t wrap)
{
    switch (static_cast<formats::Wrap>(wrap))
    {
    case formats::Wrap::mirrored_repeat:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case formats::Wrap::clamp_to_edge:
        return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case formats::Wrap::repeat:
        break;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

/// Cache of the samplers that the materials need; each is created once.
class SamplerCache
{
public:
    SamplerCache(const Device& device, std::vector<UniqueSampler>& owned) : device_(device), owned_(owned) {}

    Result<VkSampler> get(const formats::TextureRef& texture)
    {
        const auto key = std::make_tuple(texture.wrap_u, texture.wrap_v, texture.nearest);
        if (const auto found = samplers_.find(key); found != samplers_.end())
            return found->second;
        VkSamplerCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
        info.magFilter = texture.nearest != 0 ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
        info.minFilter = VK_FILTER_LINEAR;
        info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
        info.addressModeU = addressMode(texture.wrap_u);
        info.addressModeV = addressMode(texture.wrap_v);
        info.addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT;
        // more than 8 taps hardly help; with nearest magnification anisotropy would blur the texels
        info.anisotropyEnable = device_.sampler_anisotropy && texture.nearest == 0 ? VK_TRUE : VK_FALSE;
        info.maxAnisotropy = std::min(8.0f, device_.limits.maxSamplerAnisotropy);
        info.maxLod = VK_LOD_CLAMP_NONE;
        VkSampler sampler;
        HEARTH_TRY_VK(device_.vk.vkCreateSampler(device_.handle, &info, device_.allocator, &sampler),
                      "create a sampler");
        UniqueSampler made(device_, sampler);
        owned_.push_back(std::move(made)); // which destroys it if that throws
        samplers_[key] = sampler;
        return sampler;
    }

private:
    const Device& device_;
    std::vector<UniqueSampler>& owned_;
    std::map<std::tuple<uint8_t, uint8_t, uint8_t>, VkSampler> samplers_;
};

/// Offsets of a material's blocks in the buffer of materials.
struct BlockOffsets
{
    VkDeviceSize material;
    VkDeviceSize layers;
};

/// Name the images and samplers of a material's textures.
Result<std::vector<SceneTexture>> findTextures(const LayeredMaterial& material, SamplerCache& samplers,
                                               const Scene& scene)
{
    std::vector<SceneTexture> textures;
    for (const formats::TextureRef& texture : materialTextures(material))
    {
        const bool used = texture.image != kInvalidIndex;
        HEARTH_ASSIGN_OR_RETURN(const VkSampler sampler,
                                samplers.get(used ? texture : formats::TextureRef{}));
        const auto white = static_cast<uint32_t>(scene.images.size()) - 1;
        textures.push_back({used ? texture.image : white, sampler});
    }
    return textures;
}

/// Create the sets of a material whose textures are known.
Status createMaterialSets(const Device& device, const DrawLayouts& layouts, size_t row, BlockOffsets offsets,
                          Scene& scene)
{
    const size_t count = scene.textures == nullptr ? 1 : scene.frames.size();
    for (size_t i = 0; i < count; ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                                allocateSet(device, scene.pool.get(), layouts.material.get()));
        DescriptorWriter(set)
            .uniform(shared::kMaterialBlock, scene.buffers.materials, offsets.material,
                     sizeof(shared::Material))
            .uniform(shared::kMaterialLayers, scene.buffers.materials, offsets.layers,
                     sizeof(shared::MaterialLayers))
            .write(device);
        writeMaterialTextures(device, scene, row, set);
        scene.materials[row].sets.push_back(set);
    }
    return success();
}

} // namespace

void writeMaterialTextures(const Device& device, const Scene& scene, size_t row, VkDescriptorSet set)
{
    DescriptorWriter writer(set);
    for (uint32_t slot = 0; slot < shared::kTextureCount; ++slot)
    {
        const SceneTexture& texture = scene.materials[row].textures[slot];
        const bool is_streamed = texture.image + 1 < scene.images.size() && scene.textures != nullptr &&
                                 scene.textures->isStreamed(texture.image);
        const Image& image = is_streamed ? scene.textures->image(texture.image) : scene.images[texture.image];
        writer.texture(shared::kMaterialTextures + slot, image.view.get(), texture.sampler);
    }
    writer.write(device);
}

Status uploadMaterials(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                       std::span<const MaterialBinding> bindings, Uploader& uploader, Scene& scene)
{
    const std::vector<LayeredMaterial> materials = readMaterials(pack);

    HEARTH_TRY(uploadTextures(device, pack, uploader, scene));

    const VkDeviceSize alignment = std::max<VkDeviceSize>(device.limits.minUniformBufferOffsetAlignment, 1);
    const auto aligned = [&](VkDeviceSize size) { return (size + alignment - 1) / alignment * alignment; };
    const VkDeviceSize stride = aligned(sizeof(shared::Material));
    const VkDeviceSize layer_stride = aligned(sizeof(shared::MaterialLayers));
    // after the materials one neutral block for all without layers, then those of the others
    const VkDeviceSize neutral = stride * materials.size();
    const VkDeviceSize size = neutral + layer_stride * (1 + pack.materialLayers().size());
    HEARTH_ASSIGN_OR_RETURN(
        scene.buffers.materials,
        scene.arena.createBuffer(size, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                 MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(const std::span<std::byte> mapped, uploader.stage(scene.buffers.materials, size));
    const auto writeLayers = [&](VkDeviceSize offset, const formats::MaterialLayersRecord& record)
    {
        const shared::MaterialLayers layers = makeLayers(record);
        std::memcpy(mapped.data() + offset, &layers, sizeof(layers));
    };
    writeLayers(neutral, formats::neutralLayers(kInvalidIndex));
    VkDeviceSize end = neutral + layer_stride;
    SamplerCache samplers(device, scene.samplers);
    for (size_t row = 0; row < materials.size(); ++row)
    {
        shared::Material material = makeMaterial(materials[row]);
        // the last one is the default material
        const MaterialBinding binding = row < bindings.size() ? bindings[row] : MaterialBinding{};
        std::copy(binding.parameters.begin(), binding.parameters.end(), std::begin(material.parameters));
        material.motion_bound = binding.motion_bound;
        std::memcpy(mapped.data() + row * stride, &material, sizeof(material));
        SceneMaterial entry;
        entry.variant = {.used_slices = scene.used_slices,
                         .textures = material.textures,
                         .uv_sets = material.uv_sets,
                         .unlit = (material.flags & formats::kMaterialUnlit) != 0 ? 1u : 0u,
                         .layers = layerBits(materials[row].layers),
                         .function = binding.function,
                         .motion = binding.motion};
        BlockOffsets offsets{row * stride, neutral};
        if (entry.variant.layers != 0)
        {
            offsets.layers = std::exchange(end, end + layer_stride);
            writeLayers(offsets.layers, materials[row].layers);
        }
        HEARTH_ASSIGN_OR_RETURN(entry.textures, findTextures(materials[row], samplers, scene));
        scene.materials.push_back(std::move(entry));
        HEARTH_TRY(createMaterialSets(device, layouts, row, offsets, scene));
    }
    return success();
}

} // namespace hearth::gpu
