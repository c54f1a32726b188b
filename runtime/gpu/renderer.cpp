// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/renderer.h"

#include "runtime/gpu/passes/frame_update.h"
#include "runtime/gpu/vulkan/debug_label.h"

namespace hearth::gpu
{

namespace
{

void writeTimestamp(const Device& device, VkCommandBuffer commands, VkQueryPool pool, FrameTimestamp which)
{
    if (pool != VK_NULL_HANDLE)
        device.vk.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, which);
}

/// True if the frame is culled and drawn in two phases.
bool hasTwoPhases(const FrameInput& input)
{
    return (input.view.flags & shared::kCullOcclusion) != 0;
}

/// Pass the moves and changes of the frame to the shadow cache, before the frame is recorded.
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
    if (scene->deformation != nullptr)
    {
        HEARTH_TRY(prepareDeformed());
        HEARTH_TRY(skinning_->createSet(device_, *scene));
    }
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
        if (scene->deformation != nullptr)
            HEARTH_TRY(shadows_->prepareDeformed(device_));
        HEARTH_TRY(shadows_->createMaps(device_, pack, options.shadows, commands, *scene));
    }
    if (scene->bricks != nullptr && !gather_)
    {
        HEARTH_ASSIGN_OR_RETURN(brick_light_, BrickLightPass::create(device_, layouts_));
        HEARTH_ASSIGN_OR_RETURN(gather_, GatherPass::create(device_, layouts_));
    }
    for (SceneMaterial& material : scene->materials)
    {
        material.variant.bricks = scene->bricks != nullptr ? 1 : 0;
        material.variant.shadows = scene->shadows != nullptr ? 1 : 0;
        HEARTH_ASSIGN_OR_RETURN(material.pipelines, shading_.prepare(device_, layouts_, material.variant));
    }
    if (scene->dropped_lights > 0)
        warn(device_, pack.name(), "",
             std::to_string(scene->dropped_lights) + " lights are more than the " +
                 std::to_string(shared::kMaxLights) + " that are drawn");
    return scene;
}

/// Create the pipelines for scenes with deformed meshes.
Status Renderer::prepareDeformed()
{
    if (!skinning_)
    {
        HEARTH_ASSIGN_OR_RETURN(skinning_, SkinningPass::create(device_, layouts_));
    }
    HEARTH_TRY(cull_.prepareDeformed(device_, layouts_));
    HEARTH_TRY(page_requests_.prepareDeformed(device_));
    if (overdraw_)
        HEARTH_TRY(overdraw_->prepareDeformed(device_));
    return visibility_.prepareDeformed(device_);
}

Status Renderer::prepareOverdraw()
{
    if (!overdraw_)
    {
        HEARTH_ASSIGN_OR_RETURN(overdraw_, BinPass::createOverdraw(device_, layouts_, passes_.whole.get()));
    }
    return skinning_ ? overdraw_->prepareDeformed(device_) : success();
}

void Renderer::record(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                      const FrameInput& input) const
{
    recordCull(commands, scene, targets, input);
    if (shadesTiles(scene, input.shading.area) || usesGi(scene, input.shading))
    {
        recordVisibility(commands, scene, targets, input);
        recordMaterials(commands, scene, targets, input);
        return;
    }
    recordEarly(commands, scene, targets, input);
    beginPass(commands, targets, (hasTwoPhases(input) ? passes_.late : passes_.whole).get());
    drawVisibility(commands, scene, input);
    writeTimestamp(device_, commands, input.timestamps, kTimestampVisibility);
    writeTimestamp(device_, commands, input.timestamps, kTimestampMaterialTiles);
    recordShading(commands, scene, targets, input);
}

void Renderer::recordCull(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                          const FrameInput& input) const
{
    HEARTH_ASSERT(input.view.instance_count == scene.instance_count);
    if (input.timestamps != VK_NULL_HANDLE)
        device_.vk.vkCmdResetQueryPool(commands, input.timestamps, 0, kTimestampCount);
    writeTimestamp(device_, commands, input.timestamps, kTimestampBegin);
    const shared::FrameView view = scene.stream == nullptr ? input.view : scene.stream->scaled(input.view);
    trackShadows(scene, input.moves);
    recordFrameUpdate(device_, commands, scene, targets, view, {input.moves, input.poses, input.lights});
    if (scene.bricks != nullptr)
        recordBrickLight(commands, scene, input);
    if (scene.shadows != nullptr)
        recordShadows(commands, scene, targets, view, input.shadow_spheres);
    writeTimestamp(device_, commands, input.timestamps, kTimestampShadows);
    const DebugLabel label(device_, commands, "cull");
    cull_.record(device_, commands, scene, targets,
                 hasTwoPhases(input) ? shared::kPhaseEarly : shared::kPhaseWhole);
    recordSkinning(commands, scene, hasTwoPhases(input) ? shared::kPhaseEarly : shared::kPhaseWhole);
    if (scene.stream != nullptr)
        recordRequests(commands, scene);
    writeTimestamp(device_, commands, input.timestamps, kTimestampCull);
}

void Renderer::recordVisibility(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                                const FrameInput& input) const
{
    recordEarly(commands, scene, targets, input);
    beginPass(commands, targets,
              (hasTwoPhases(input) ? passes_.late_visibility : passes_.whole_visibility).get());
    drawVisibility(commands, scene, input);
    endAtVisibility(commands);
    writeTimestamp(device_, commands, input.timestamps, kTimestampVisibility);
}

void Renderer::recordMaterials(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                               const FrameInput& input) const
{
    if (shadesTiles(scene, input.shading.area))
    {
        const DebugLabel label(device_, commands, "material tiles");
        material_tiles_.record(device_, commands, scene, targets);
    }
    if (usesGi(scene, input.shading))
    {
        const DebugLabel label(device_, commands, "gather light");
        for (uint32_t i = 0; i < input.gathers; ++i)
            gather_->record(device_, commands, scene, targets, input.view, scene.bricks->quick_frames > 0);
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampMaterialTiles);
    beginPass(commands, targets, passes_.shading.get());
    recordShading(commands, scene, targets, input);
}

void Renderer::recordPrefetch(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                              const shared::FrameView& view, std::span<const InstanceMove> moves,
                              std::span<const InstancePose> poses) const
{
    HEARTH_ASSERT(scene.stream != nullptr && view.instance_count == scene.instance_count);
    trackShadows(scene, moves);
    recordFrameUpdate(device_, commands, scene, targets, scene.stream->scaled(view), {moves, poses});
    cull_.record(device_, commands, scene, targets, shared::kPhaseWhole);
    recordRequests(commands, scene);
}

/// Draw each shadow map that is stale as a view of its own, culled in the work buffers of the frame;
/// afterwards the buffers have the frame's own view again.
void Renderer::recordShadows(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                             const shared::FrameView& view, std::span<const ShadowSphere> spheres) const
{
    const DebugLabel label(device_, commands, "shadows");
    const std::span<const ShadowCache::LayerUpdate> stale = scene.shadows->planFrame(view, spheres);
    shadows_->recordBlock(device_, commands, scene);
    for (const ShadowCache::LayerUpdate& map : stale)
    {
        recordViewChange(device_, commands, scene, targets, map.casters);
        cull_.record(device_, commands, scene, targets, shared::kPhaseWhole);
        shadows_->recordMap(device_, commands, layouts_, scene, map);
    }
    if (!stale.empty())
        recordViewChange(device_, commands, scene, targets, view);
}

/// Update a share of the brick faces, if the frame shows their light.
void Renderer::recordBrickLight(VkCommandBuffer commands, const Scene& scene, const FrameInput& input) const
{
    if (!input.shading.gi && !shared::viewNeedsBricks(input.shading.debug_view))
        return;
    const DebugLabel label(device_, commands, "light bricks");
    brick_light_->record(device_, commands, scene, !input.lights.empty(), input.emission);
}

/// Record after each culling phase of the frame.
void Renderer::recordSkinning(VkCommandBuffer commands, const Scene& scene, uint32_t phase) const
{
    if (scene.deformation == nullptr)
        return;
    const DebugLabel label(device_, commands, "skinning");
    skinning_->record(device_, commands, scene, phase);
}

/// Record after the first culling phase.
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
    clear[kVisibility].color.uint32[0] = shared::kVisibilitySky;
    clear[kDepth].depthStencil.depth = 0; // at infinity
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

/// Record the early phase: draw the clusters that the last frame's depth does not occlude, build the pyramid,
/// then cull the rest against it. Does nothing if the frame has one phase.
void Renderer::recordEarly(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                           const FrameInput& input) const
{
    const bool has_two_phases = hasTwoPhases(input);
    if (has_two_phases)
    {
        const DebugLabel label(device_, commands, "early visibility");
        beginPass(commands, targets, passes_.early.get());
        visibility_.record(device_, commands, layouts_, scene, shared::kPhaseEarly);
        endAtVisibility(commands);
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampEarlyVisibility);
    if (has_two_phases)
    {
        const DebugLabel label(device_, commands, "pyramid");
        pyramid_.record(device_, commands, targets);
        targets.setPyramidView(shared::makeOcclusionView(input.view));
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampPyramid);
    if (has_two_phases)
    {
        const DebugLabel label(device_, commands, "late cull");
        cull_.record(device_, commands, scene, targets, shared::kPhaseLate);
        recordSkinning(commands, scene, shared::kPhaseLate);
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampLateCull);
}

/// Record in the first subpass.
void Renderer::drawVisibility(VkCommandBuffer commands, const Scene& scene, const FrameInput& input) const
{
    const DebugLabel label(device_, commands, "visibility");
    visibility_.record(device_, commands, layouts_, scene,
                       hasTwoPhases(input) ? shared::kPhaseLate : shared::kPhaseWhole);
}

/// End the render pass. The other two subpasses exist for compatibility and store nothing.
void Renderer::endAtVisibility(VkCommandBuffer commands) const
{
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    device_.vk.vkCmdEndRenderPass(commands);
}

/// Draw the clusters of both phases; the late draws are empty if culling had one phase.
void Renderer::recordOverdraw(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets) const
{
    HEARTH_ASSERT(overdraw_);
    const VkClearAttachment black{VK_IMAGE_ASPECT_COLOR_BIT, 0, {.color = {.float32 = {0, 0, 0, 1}}}};
    const VkClearRect everywhere{{{0, 0}, targets.extent()}, 0, 1};
    device_.vk.vkCmdClearAttachments(commands, 1, &black, 1, &everywhere);
    for (const uint32_t phase : {shared::kPhaseEarly, shared::kPhaseLate})
        overdraw_->record(device_, commands, layouts_, scene, phase);
}

/// Record from after the first subpass to the end of the render pass.
void Renderer::recordShading(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                             const FrameInput& input) const
{
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    {
        const DebugLabel label(device_, commands, "material depth");
        material_depth_.record(device_, commands, layouts_, scene, targets);
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampMaterialDepth);
    device_.vk.vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    {
        const DebugLabel label(device_, commands, "shading");
        if (input.shading.debug_view == shared::kViewOverdraw)
            recordOverdraw(commands, scene, targets);
        else
            shading_.record(device_, commands, layouts_, scene, targets, input.shading);
    }
    device_.vk.vkCmdEndRenderPass(commands);
    writeTimestamp(device_, commands, input.timestamps, kTimestampShading);
}

} // namespace hearth::gpu
