// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/shadow_pass.h"

#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kProxyTables[] = {shared::kTableInstances,      shared::kTableShadows,
                                     shared::kTableProxies,        shared::kTableProxyChunks,
                                     shared::kTableProxyPositions, shared::kTableProxyIndices};

/// Barrier for `count` layers from `first` on.
VkImageMemoryBarrier layerBarrier(const Image& image, uint32_t first, uint32_t count, VkImageLayout before,
                                  VkImageLayout after, VkAccessFlags access)
{
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.oldLayout = before;
    barrier.newLayout = after;
    barrier.dstAccessMask = access;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle.get();
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, first, count};
    return barrier;
}

/// Make all layers sampleable: the descriptor set has the view of all layers from the first frame on,
/// whatever has been drawn.
void makeSampleable(const Device& device, VkCommandBuffer commands, const Image& image)
{
    const VkImageMemoryBarrier barrier =
        layerBarrier(image, 0, VK_REMAINING_ARRAY_LAYERS, VK_IMAGE_LAYOUT_UNDEFINED,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT);
    device.vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                   VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                                   &barrier);
}

} // namespace

Result<ShadowPass> ShadowPass::create(const Device& device, const DrawLayouts& layouts,
                                      VkRenderPass render_pass)
{
    ShadowPass pass;
    pass.render_pass_ = render_pass;
    HEARTH_ASSIGN_OR_RETURN(pass.casters_, BinPass::createCasters(device, layouts, render_pass));
    return pass;
}

/// Culls no faces, as clusters.
Status ShadowPass::prepareProxies(const Device& device)
{
    if (proxies_)
        return success();
    Proxies proxies;
    HEARTH_ASSIGN_OR_RETURN(proxies.set_layout,
                            createSetLayout(device, tableBindings(kProxyTables, VK_SHADER_STAGE_VERTEX_BIT)));
    const NumberedSet sets[] = {{shared::kSetTables, proxies.set_layout.get()}};
    HEARTH_ASSIGN_OR_RETURN(proxies.layout,
                            createPipelineLayout(device, sets, kBinPushStages, sizeof(shared::BinPush)));
    HEARTH_ASSIGN_OR_RETURN(proxies.pipeline,
                            createGraphicsPipeline(device, {.vertex = shaders::caster_proxy_vert,
                                                            .fragment = shaders::caster_frag,
                                                            .layout = proxies.layout.get(),
                                                            .render_pass = render_pass_,
                                                            .subpass = 0,
                                                            .depth_compare = VK_COMPARE_OP_GREATER,
                                                            .depth_write = true,
                                                            .colors = 0}));
    proxies_ = std::move(proxies);
    return success();
}

Status ShadowPass::createProxySets(const Device& device, Scene& scene) const
{
    for (uint32_t number = 0; number < scene.frames.size(); ++number)
        for (SceneView& view : scene.frames[number].casters)
        {
            HEARTH_ASSIGN_OR_RETURN(view.proxy_set,
                                    allocateSet(device, scene.pool.get(), proxies_->set_layout.get()));
            writeTables(device, {scene, number, view}, view.proxy_set, kProxyTables);
        }
    return success();
}

Status ShadowPass::createMaps(const Device& device, const formats::PackView& pack,
                              const ShadowOptions& options, const ShadowDepthChoice& depth,
                              VkCommandBuffer commands, Scene& scene) const
{
    HEARTH_ASSIGN_OR_RETURN(scene.shadows,
                            SceneShadows::create(device, render_pass_, pack, scene.bounds, scene.motions,
                                                 scene.lights->layout().capacity, options, depth));
    const SceneShadows& shadows = *scene.shadows;
    if (scene.deformation != nullptr)
    {
        const DeformationLayout& deformed = scene.deformation->layout;
        const std::vector<PoseRows> poses = makeRestPoses(pack, deformed);
        for (size_t i = 0; i < poses.size(); ++i)
            scene.shadows->pose(deformed.instances[i], poses[i]);
    }
    makeSampleable(device, commands, shadows.image());
    if (scene.proxies_cast)
        HEARTH_TRY(createProxySets(device, scene));
    const auto write = [&](const SceneFrame& frame, const SceneView& view)
    {
        DescriptorWriter(view.draw_set)
            .uniform(shared::kSceneShadows, frame.shadow_block)
            .texture(shared::kSceneShadowMaps, shadows.image().view.get(), shadows.sampler())
            .write(device);
    };
    for (const SceneFrame& frame : scene.frames)
    {
        write(frame, frame.main);
        for (const SceneView& view : frame.casters)
            write(frame, view);
    }
    return success();
}

void ShadowPass::recordCounters(const Device& device, VkCommandBuffer commands, const Scene& scene,
                                std::span<const SceneView> views,
                                std::span<const ShadowCache::LayerUpdate> maps) const
{
    // an earlier frame may have counted the same layers
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT);
    for (size_t i = 0; i < maps.size(); ++i)
    {
        const VkBufferCopy counters{0, maps[i].layer * VkDeviceSize{sizeof(shared::FrameCounters)},
                                    sizeof(shared::FrameCounters)};
        device.vk.vkCmdCopyBuffer(commands, views[i].counters.handle.get(),
                                  scene.shadows->casters().handle.get(), 1, &counters);
        if (!scene.proxies_cast)
            continue;
        const VkBufferCopy triangles{offsetof(shared::ProxyDraw, triangle_count),
                                     maps[i].layer * VkDeviceSize{sizeof(uint32_t)}, sizeof(uint32_t)};
        device.vk.vkCmdCopyBuffer(commands, views[i].proxy_draw.handle.get(),
                                  scene.shadows->proxyTriangles().handle.get(), 1, &triangles);
    }
}

void ShadowPass::recordCopy(const Device& device, VkCommandBuffer commands, const Scene& scene,
                            const ShadowCache::LayerUpdate& map) const
{
    constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
    constexpr VkImageLayout kSampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    constexpr VkImageLayout kSource = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout kTarget = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    const SceneShadows& shadows = *scene.shadows;
    const VkImageMemoryBarrier before[] = {
        layerBarrier(shadows.image(), *map.copy_from, 1, kSampled, kSource, VK_ACCESS_TRANSFER_READ_BIT),
        layerBarrier(shadows.image(), map.layer, 1, VK_IMAGE_LAYOUT_UNDEFINED, kTarget,
                     VK_ACCESS_TRANSFER_WRITE_BIT)};
    device.vk.vkCmdPipelineBarrier(commands, kTransfer, kTransfer, 0, 0, nullptr, 0, nullptr, 2, before);
    const auto side = static_cast<uint32_t>(shadows.plan().block.maps[map.map].size);
    const VkImageCopy region{{VK_IMAGE_ASPECT_DEPTH_BIT, 0, *map.copy_from, 1},
                             {0, 0, 0},
                             {VK_IMAGE_ASPECT_DEPTH_BIT, 0, map.layer, 1},
                             {0, 0, 0},
                             {side, side, 1}};
    device.vk.vkCmdCopyImage(commands, shadows.image().handle.get(), kSource, shadows.image().handle.get(),
                             kTarget, 1, &region);
    const VkImageMemoryBarrier after =
        layerBarrier(shadows.image(), *map.copy_from, 1, kSource, kSampled, VK_ACCESS_SHADER_READ_BIT);
    device.vk.vkCmdPipelineBarrier(commands, kTransfer, kTransfer | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0,
                                   0, nullptr, 0, nullptr, 1, &after);
}

void ShadowPass::recordMap(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                           const Scene& scene, const SceneView& view,
                           const ShadowCache::LayerUpdate& map) const
{
    shared::BinPush push{};
    push.light_row = scene.shadows->plan().row_of[map.map];
    push.map_index = map.map;
    casters_.record(device, commands, layouts, scene, view, shared::kPhaseWhole, push);
    if (scene.proxies_cast)
        recordProxies(device, commands, view, push);
}

void ShadowPass::recordProxies(const Device& device, VkCommandBuffer commands, const SceneView& view,
                               const shared::BinPush& push) const
{
    const VkPipelineLayout layout = proxies_->layout.get();
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, proxies_->pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, shared::kSetTables,
                                      1, &view.proxy_set, 0, nullptr);
    device.vk.vkCmdPushConstants(commands, layout, kBinPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdDrawIndirect(commands, view.proxy_draw.handle.get(), 0, 1, sizeof(shared::ProxyDraw));
}

} // namespace hearth::gpu
