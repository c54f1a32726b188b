// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/scene_shading.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace hearth::gpu
{

namespace
{

/// Return the format of an image that checkPack has passed.
VkFormat imageFormat(uint32_t format)
{
    return static_cast<VkFormat>(formats::findTexelFormat(format)->vulkan_format);
}

constexpr VkImageUsageFlags kTextureUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

Status uploadImage(const Device& device, const formats::PackView& pack, uint32_t index, Uploader& uploader,
                   Scene& scene)
{
    const formats::ImageRecord& record = pack.images()[index];
    if (std::max(record.width, record.height) > device.limits.maxImageDimension2D)
        return Error{Issue::device_limit, pack.name(), "image " + std::to_string(index),
                     std::to_string(record.width) + "x" + std::to_string(record.height) +
                         " texels, the device takes " + std::to_string(device.limits.maxImageDimension2D)};
    HEARTH_ASSIGN_OR_RETURN(const formats::ChunkData data, pack.imageData(index));
    const bool is_narrowed = formats::isUnorm16(record.format) && !device.samples_unorm16;
    const auto format =
        is_narrowed ? static_cast<uint32_t>(formats::TexelFormat::rgba8_unorm) : record.format;
    HEARTH_ASSIGN_OR_RETURN(scene.images[index],
                            scene.arena.createImage({.format = imageFormat(format),
                                                     .extent = {record.width, record.height},
                                                     .mip_count = record.mip_count,
                                                     .usage = kTextureUsage}));
    if (!is_narrowed)
        return uploader.upload(scene.images[index], data.bytes(), formats::texelBytes(format));
    warn(device, pack.name(), "image " + std::to_string(index),
         "its 16 bits a channel are reduced to 8: the device cannot filter R16G16B16A16_UNORM");
    return uploader.upload(scene.images[index], formats::narrowTexels(data.bytes()),
                           formats::texelBytes(format));
}

Status uploadWhite(Uploader& uploader, Scene& scene)
{
    HEARTH_ASSIGN_OR_RETURN(
        Image white, scene.arena.createImage(
                         {.format = VK_FORMAT_R8G8B8A8_UNORM, .extent = {1, 1}, .usage = kTextureUsage}));
    const uint32_t texel = 0xFFFFFFFFu;
    HEARTH_TRY(uploader.upload(white, std::as_bytes(std::span(&texel, 1)), 4));
    scene.images.push_back(std::move(white));
    return success();
}

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
        owned_.emplace_back(device_, sampler);
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

Result<VkDescriptorSet> createMaterialSet(const Device& device, const DrawLayouts& layouts,
                                          const LayeredMaterial& material, BlockOffsets offsets,
                                          SamplerCache& samplers, Scene& scene)
{
    HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                            allocateSet(device, scene.pool.get(), layouts.material.get()));
    DescriptorWriter writer(set);
    writer
        .uniform(shared::kMaterialBlock, scene.buffers.materials, offsets.material, sizeof(shared::Material))
        .uniform(shared::kMaterialLayers, scene.buffers.materials, offsets.layers,
                 sizeof(shared::MaterialLayers));
    const MaterialTextures textures = materialTextures(material);
    for (uint32_t slot = 0; slot < shared::kTextureCount; ++slot)
    {
        const bool used = textures[slot].image != kInvalidIndex;
        HEARTH_ASSIGN_OR_RETURN(const VkSampler sampler,
                                samplers.get(used ? textures[slot] : formats::TextureRef{}));
        const Image& image = used ? scene.images[textures[slot].image] : scene.images.back();
        writer.texture(shared::kMaterialTextures + slot, image.view.get(), sampler);
    }
    writer.write(device);
    return set;
}

} // namespace

Status uploadMaterials(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                       Uploader& uploader, Scene& scene)
{
    const std::vector<LayeredMaterial> materials = readMaterials(pack);

    scene.images.resize(pack.images().size());
    std::vector<bool> used(pack.images().size(), false);
    for (const LayeredMaterial& material : materials)
        for (const formats::TextureRef& texture : materialTextures(material))
            if (texture.image != kInvalidIndex)
                used[texture.image] = true;
    for (uint32_t image = 0; image < used.size(); ++image)
        if (used[image])
            HEARTH_TRY(uploadImage(device, pack, image, uploader, scene));
    HEARTH_TRY(uploadWhite(uploader, scene));

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
        const shared::Material material = makeMaterial(materials[row]);
        std::memcpy(mapped.data() + row * stride, &material, sizeof(material));
        SceneMaterial entry;
        entry.variant = {.used_slices = scene.used_slices,
                         .textures = material.textures,
                         .uv_sets = material.uv_sets,
                         .unlit = (material.flags & formats::kMaterialUnlit) != 0 ? 1u : 0u,
                         .layers = layerBits(materials[row].layers)};
        BlockOffsets offsets{row * stride, neutral};
        if (entry.variant.layers != 0)
        {
            offsets.layers = std::exchange(end, end + layer_stride);
            writeLayers(offsets.layers, materials[row].layers);
        }
        HEARTH_ASSIGN_OR_RETURN(entry.set,
                                createMaterialSet(device, layouts, materials[row], offsets, samplers, scene));
        scene.materials.push_back(entry);
    }
    return success();
}

} // namespace hearth::gpu
