// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/renderer.h"

namespace hearth::gpu
{

namespace
{

void writeTimestamp(const Device& device, VkCommandBuffer commands, VkQueryPool pool, FrameTimestamp which)
{
    if (pool != VK_NULL_HANDLE)
        device.vk.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, which);
}

/// What changes with the frame, before it is recorded.
void trackShadows(const Scene& scene, std::span<const InstanceMove> moves)
{
    if (scene.shadows != nullptr)
        scene.shadows->track(moves, scene.stream == nullptr ? std::span<const pack::ResidentGroups::Change>()
                                                            : scene.stream->changedGroups());
}

} // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const DeviceDescription& description)
{
    std::unique_ptr<Renderer> renderer(new Renderer);
    Renderer& r = *renderer;
    HEARTH_ASSIGN_OR_RETURN(r.device_, makeDevice(description));
    HEARTH_ASSIGN_OR_RETURN(r.layouts_, DrawLayouts::create(r.device_));
    HEARTH_ASSIGN_OR_RETURN(r.passes_, FramePasses::create(r.device_));
    HEARTH_ASSIGN_OR_RETURN(r.cull_, CullPass::create(r.device_, r.layouts_));
    HEARTH_ASSIGN_OR_RETURN(r.page_requests_, PageRequestPass::create(r.device_));
    HEARTH_ASSIGN_OR_RETURN(r.pyramid_, PyramidPass::create(r.device_, r.layouts_));
    HEARTH_ASSIGN_OR_RETURN(r.material_tiles_, MaterialTilesPass::create(r.device_, r.layouts_));
    const VkRenderPass render_pass = r.passes_.whole.get();
    HEARTH_ASSIGN_OR_RETURN(r.visibility_, BinPass::createVisibility(r.device_, r.layouts_, render_pass));
    HEARTH_ASSIGN_OR_RETURN(r.material_depth_, MaterialDepthPass::create(r.device_, r.layouts_, render_pass));
    HEARTH_ASSIGN_OR_RETURN(r.shading_, ShadingPass::create(r.device_, r.layouts_, render_pass));
    return renderer;
}

Result<FrameTargets> Renderer::createTargets(VkExtent2D extent) const
{
    return FrameTargets::create(device_, passes_.whole.get(), layouts_, extent);
}

Result<std::unique_ptr<Scene>> Renderer::upload(const formats::PackView& pack, VkCommandBuffer commands,
                                                const SceneOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<Scene> scene,
                            uploadScene(device_, layouts_, pack, commands, options));
    HEARTH_TRY(cull_.createSets(device_, *scene));
    HEARTH_TRY(material_tiles_.createSet(device_, *scene));
    if (scene->stream != nullptr)
        HEARTH_TRY(page_requests_.createSet(device_, *scene));
    if (options.shadows.max_maps > 0)
    {
        if (!shadows_)
        {
            HEARTH_ASSIGN_OR_RETURN(shadows_, ShadowPass::create(device_, layouts_));
        }
        HEARTH_TRY(shadows_->createMaps(device_, pack, options.shadows, commands, *scene));
    }
    for (SceneMaterial& material : scene->materials)
    {
        material.variant.shadows = scene->shadows != nullptr ? 1 : 0;
        HEARTH_ASSIGN_OR_RETURN(material.pipelines, shading_.prepare(device_, layouts_, material.variant));
    }
    return scene;
}

Status Renderer::prepareOverdraw()
{
    if (!overdraw_)
    {
        HEARTH_ASSIGN_OR_RETURN(overdraw_, BinPass::createOverdraw(device_, layouts_, passes_.whole.get()));
    }
    return success();
}

void Renderer::record(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                      const FrameInput& input) const
{
    HEARTH_ASSERT(input.view.instance_count == scene.instance_count);
    if (input.timestamps != VK_NULL_HANDLE)
        device_.vk.vkCmdResetQueryPool(commands, input.timestamps, 0, kTimestampCount);
    const auto stamp = [&](FrameTimestamp which)
    { writeTimestamp(device_, commands, input.timestamps, which); };
    stamp(kTimestampBegin);
    const shared::FrameView view = scene.stream == nullptr ? input.view : scene.stream->scaled(input.view);
    trackShadows(scene, input.moves);
    cull_.recordConstants(device_, commands, scene, targets, view, input.moves);
    if (scene.shadows != nullptr)
        recordShadows(commands, scene, targets, view, input.shadow_spheres);
    stamp(kTimestampShadows);
    const bool in_phases = (input.view.flags & shared::kCullOcclusion) != 0;
    cull_.record(device_, commands, scene, targets, in_phases ? shared::kPhaseEarly : shared::kPhaseWhole);
    if (scene.stream != nullptr)
        recordRequests(commands, scene);
    stamp(kTimestampCull);
    if (in_phases)
        recordEarly(commands, scene, targets);
    stamp(kTimestampEarlyVisibility);
    if (in_phases)
        pyramid_.record(device_, commands, targets);
    stamp(kTimestampPyramid);
    if (in_phases)
        cull_.record(device_, commands, scene, targets, shared::kPhaseLate);
    stamp(kTimestampLateCull);
    recordPicture(commands, scene, targets, input, in_phases);
    if (in_phases)
        targets.setPyramidView(shared::makeOcclusionView(input.view));
}

void Renderer::recordPrefetch(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                              const shared::FrameView& view) const
{
    HEARTH_ASSERT(scene.stream != nullptr && view.instance_count == scene.instance_count);
    trackShadows(scene, {});
    cull_.recordConstants(device_, commands, scene, targets, scene.stream->scaled(view), {});
    cull_.record(device_, commands, scene, targets, shared::kPhaseWhole);
    recordRequests(commands, scene);
}

/// Each map that must be drawn is a view of its own, culled in the work buffers of the frame; then those are the
/// picture's again.
void Renderer::recordShadows(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                             const shared::FrameView& view, std::span<const ShadowSphere> spheres) const
{
    const std::span<const ShadowCache::StaleMap> stale = scene.shadows->planFrame(view, spheres);
    shadows_->recordBlock(device_, commands, scene);
    for (const ShadowCache::StaleMap& map : stale)
    {
        cull_.recordView(device_, commands, scene, targets, map.casters);
        cull_.record(device_, commands, scene, targets, shared::kPhaseWhole);
        shadows_->recordMap(device_, commands, layouts_, scene, map);
    }
    if (!stale.empty())
        cull_.recordView(device_, commands, scene, targets, view);
}

/// After the first culling phase.
void Renderer::recordRequests(VkCommandBuffer commands, const Scene& scene) const
{
    page_requests_.record(device_, commands, scene);
    scene.stream->recordFeedback(commands, scene.buffers);
}

void Renderer::beginPass(VkCommandBuffer commands, const FrameTargets& targets,
                         VkRenderPass render_pass) const
{
    const VkRect2D area{{0, 0}, targets.extent()};
    VkClearValue clear[2] = {};
    clear[kVisibility].color.uint32[0] = shared::kNothingVisible;
    clear[kDepth].depthStencil.depth = 0; // infinitely far away
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = render_pass;
    begin.framebuffer = targets.framebuffer();
    begin.renderArea = area;
    begin.clearValueCount = 2;
    begin.pClearValues = clear;
    device_.vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{
        0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1};
    device_.vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    device_.vk.vkCmdSetScissor(commands, 0, 1, &area);
}

void Renderer::recordEarly(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets) const
{
    beginPass(commands, targets, passes_.early.get());
    visibility_.record(device_, commands, layouts_, scene, shared::kPhaseEarly);
    endAtVisibility(commands);
}

/// The other two subpasses are there to be compatible, and store nothing.
void Renderer::endAtVisibility(VkCommandBuffer commands) const
{
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    device_.vk.vkCmdEndRenderPass(commands);
}

/// What both phases have drawn; the late one nothing where culling had only one.
void Renderer::recordOverdraw(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets) const
{
    HEARTH_ASSERT(overdraw_);
    const VkClearAttachment black{VK_IMAGE_ASPECT_COLOR_BIT, 0, {.color = {.float32 = {0, 0, 0, 1}}}};
    const VkClearRect everywhere{{{0, 0}, targets.extent()}, 0, 1};
    device_.vk.vkCmdClearAttachments(commands, 1, &black, 1, &everywhere);
    for (const uint32_t phase : {shared::kPhaseEarly, shared::kPhaseLate})
        overdraw_->record(device_, commands, layouts_, scene, phase);
}

/// late  goes on from what recordEarly drew
void Renderer::recordPicture(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                             const FrameInput& input, bool late) const
{
    const bool tiles = shadesTiles(scene, input.shading.area);
    const UniqueRenderPass& to_picture = late ? passes_.late : passes_.whole;
    const UniqueRenderPass& to_visibility = late ? passes_.late_visibility : passes_.whole_visibility;
    beginPass(commands, targets, (tiles ? to_visibility : to_picture).get());
    visibility_.record(device_, commands, layouts_, scene, late ? shared::kPhaseLate : shared::kPhaseWhole);
    if (tiles)
        endAtVisibility(commands);
    writeTimestamp(device_, commands, input.timestamps, kTimestampVisibility);
    if (tiles)
        material_tiles_.record(device_, commands, scene, targets);
    writeTimestamp(device_, commands, input.timestamps, kTimestampMaterialTiles);
    if (tiles)
        beginPass(commands, targets, passes_.picture.get());
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    material_depth_.record(device_, commands, layouts_, scene, targets);
    writeTimestamp(device_, commands, input.timestamps, kTimestampMaterialDepth);
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    if (input.shading.shown == shared::kViewOverdraw)
        recordOverdraw(commands, scene, targets);
    else
        shading_.record(device_, commands, layouts_, scene, targets, input.shading);
    device_.vk.vkCmdEndRenderPass(commands);
    writeTimestamp(device_, commands, input.timestamps, kTimestampShading);
}

} // namespace hearth::gpu
