// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/reflectance.h"
#include "formats/scene/sheen.h"
#include "formats/scene/sky_table.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kNodes = shared::kSpecularNodes;

constexpr VkImageUsageFlags kTableUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

/// Create a linear sampler that clamps to the last node of an axis.
Result<VkSampler> createSampler(const Device& device, Scene& scene)
{
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler;
    HEARTH_TRY_VK(device.vk.vkCreateSampler(device.handle, &info, device.allocator, &sampler),
                  "create a sampler");
    scene.samplers.emplace_back(device, sampler);
    return sampler;
}

/// Upload the pack's table of specular occlusion, if it has one.
Status uploadSpecularTable(const Device& device, const formats::PackView& pack, VkSampler sampler,
                           Uploader& uploader, Scene& scene)
{
    if (pack.specularTables().empty())
        return success();
    const formats::SpecularTableRecord& table = pack.specularTables()[0];
    // same layout as in the file: the squares of the nodes of beta, one below the other
    HEARTH_ASSIGN_OR_RETURN(
        scene.specular_table,
        scene.arena.createImage(
            {.format = VK_FORMAT_R8_UNORM, .extent = {kNodes, kNodes * kNodes}, .usage = kTableUsage}));
    HEARTH_TRY(uploader.upload(scene.specular_table, std::as_bytes(std::span(table.values)), 1));
    scene.specular_spacing = table.spacing;
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .texture(shared::kSceneSpecularTable, scene.specular_table.view.get(), sampler)
                        .write(device);
                });
    return success();
}

} // namespace

Status uploadShadingTables(const Device& device, const formats::PackView& pack, Uploader& uploader,
                           Scene& scene)
{
    HEARTH_ASSIGN_OR_RETURN(const VkSampler sampler, createSampler(device, scene));
    HEARTH_ASSIGN_OR_RETURN(
        scene.reflectance_table,
        scene.arena.createImage({.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                 .extent = {shared::kReflectanceColumns, 2 * shared::kReflectanceRows},
                                 .usage = kTableUsage}));
    std::vector<uint64_t> reflectance(shared::kReflectanceTable.begin(), shared::kReflectanceTable.end());
    reflectance.insert(reflectance.end(), shared::kSheenTable.begin(), shared::kSheenTable.end());
    HEARTH_TRY(
        uploader.upload(scene.reflectance_table, std::as_bytes(std::span(reflectance)), sizeof(uint64_t)));
    HEARTH_ASSIGN_OR_RETURN(scene.sky_table, scene.arena.createImage({.format = VK_FORMAT_R16G16_SFLOAT,
                                                                      .extent = {shared::kSkyTableHeights,
                                                                                 shared::kSkyTableAngles},
                                                                      .usage = kTableUsage}));
    HEARTH_TRY(
        uploader.upload(scene.sky_table, std::as_bytes(std::span(shared::skyTable())), sizeof(uint32_t)));
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .texture(shared::kSceneReflectance, scene.reflectance_table.view.get(), sampler)
                        .texture(shared::kSceneSkyTable, scene.sky_table.view.get(), sampler)
                        .write(device);
                });
    return uploadSpecularTable(device, pack, sampler, uploader, scene);
}

} // namespace hearth::gpu
