// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/brick_light_pass.h"

#include "formats/gpu_shared/brick_lighting.h"
#include "runtime/shaders/shaders.h"

#include <algorithm>
#include <cstring>

namespace hearth::gpu
{

namespace
{

constexpr VkPipelineStageFlags kLightStage = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;

shared::BrickView makeView(const SceneBricks& bricks, std::span<const EmissionScale> emission)
{
    shared::BrickView view{};
    view.grid = formats::toBrickGrid(bricks.grid);
    view.face_count = bricks.grid.face_count;
    view.first_brick = bricks.share.first_brick;
    view.slice_bricks = bricks.share.brick_count;
    view.slice_faces = bricks.share.face_count;
    view.light_rays = bricks.rays;
    view.baked_scale = bricks.baked_scale;
    const float scale = 1 / view.grid.voxel_size;
    for (const EmissionScale& change :
         emission.first(std::min<size_t>(emission.size(), shared::kMaxEmissionBoxes)))
        view.emission_boxes[view.emission_box_count++] = {
            .box_min = (change.box.min - view.grid.origin) * scale,
            .factor = change.factor,
            .box_max = (change.box.max - view.grid.origin) * scale,
            .reserved = 0};
    return view;
}

/// After a light change, gathered history has a low weight for this many sweeps over all faces, and for this
/// many more frames. After the sweeps less than 3 % of the old light is left at an albedo of .8; after the
/// frames less than 1 % of the old gathered light is left.
constexpr uint32_t kQuickSweeps = 16;
constexpr uint32_t kQuickFrames = 16;

/// Sweeps over all faces after which light that is off has left them: a ten-thousandth of it at the largest
/// albedo.
constexpr uint32_t kDecaySweeps = 180;

/// Return the parts of the faces' light in a frame, and count frames with light that is not baked.
uint32_t findLightParts(const Scene& scene)
{
    SceneBricks& bricks = *scene.bricks;
    if (scene.receivers == nullptr || !scene.receivers->faces)
        return shared::kLiveFaceLight;
    if (scene.receivers->hasLiveLight())
        bricks.live_frames = kDecaySweeps * bricks.period;
    else if (bricks.live_frames > 0)
        --bricks.live_frames;
    return shared::kBakedFaceLight | (bricks.live_frames > 0 ? shared::kLiveFaceLight : 0u);
}

bool sameEmission(const shared::BrickView& a, const shared::BrickView& b)
{
    return a.emission_box_count == b.emission_box_count &&
           std::memcmp(&a.emission_boxes, &b.emission_boxes, sizeof(a.emission_boxes)) == 0;
}

} // namespace

Result<BrickLightPass> BrickLightPass::create(const Device& device, const DrawLayouts& layouts)
{
    BrickLightPass pass;
    const NumberedSet sets[] = {{shared::kSetBricks, layouts.bricks.get()},
                                {shared::kSetFreshLight, layouts.fresh_light.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.faces_, createComputePipeline(device, shaders::light_faces_comp, sets));
    return pass;
}

void BrickLightPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                            const WordCopyPass& copy_words, WordCopies& copies, bool lights_change,
                            std::span<const EmissionScale> emission) const
{
    HEARTH_ASSERT(emission.empty() || scene.receivers == nullptr || !scene.receivers->faces);
    SceneBricks& bricks = *scene.bricks;
    bricks.share = nextBrickShare(bricks, bricks.frame++);
    shared::BrickView view = makeView(bricks, emission);
    view.light_parts = findLightParts(scene);
    const bool is_live = (view.light_parts & shared::kLiveFaceLight) != 0;
    if (lights_change || !sameEmission(view, bricks.last_view))
        bricks.quick_frames = (is_live ? kQuickSweeps * bricks.period : 0) + kQuickFrames;
    else if (bricks.quick_frames > 0)
        --bricks.quick_frames;
    bricks.last_view = view;
    const SceneFrame& frame = scene.frame();
    std::memcpy(frame.brick_view.mapped, &view, sizeof(view));
    if (bricks.share.face_count == 0 || !is_live)
        return;

    // a debug view of the last frame shows the light, which the table leaves out: no other frame waits for it
    if (bricks.is_shown)
        barrier(device, commands, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, kLightStage, 0);
    const VkDescriptorSet sets[] = {frame.brick_set, bricks.fresh_set};
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, faces_.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, faces_.layout.get(),
                                      shared::kSetBricks, 2, sets, 0, nullptr);
    const uint32_t groups = (bricks.share.face_count + shared::kGroupFaces - 1) / shared::kGroupFaces;
    device.vk.vkCmdDispatch(commands, std::min(groups, shared::kMaxDispatchX),
                            (groups + shared::kMaxDispatchX - 1) / shared::kMaxDispatchX, 1);
    // all threads have read the old values: a frame sees the light of the frame before, whatever the order of
    // threads
    barrier(device, commands, kLightStage, VK_ACCESS_SHADER_WRITE_BIT, kLightStage,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    constexpr uint32_t kFaceWords = sizeof(shared::BrickLight) / sizeof(uint32_t);
    copies.begin();
    copies.add(0, kFaceWords * bricks.share.first_face, kFaceWords * bricks.share.face_count);
    copy_words.record(device, commands, frame.brick_copy_set, copies.range());
    barrier(device, commands, kLightStage, VK_ACCESS_SHADER_WRITE_BIT,
            kLightStage | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
