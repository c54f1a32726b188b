// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/gather_pass.h"

#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

void bind(const Device& device, VkCommandBuffer commands, const ComputePipeline& pipeline, uint32_t first_set,
          std::initializer_list<VkDescriptorSet> sets)
{
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                      first_set, static_cast<uint32_t>(sets.size()), sets.begin(), 0,
                                      nullptr);
}

} // namespace

Result<GatherPass> GatherPass::create(const Device& device, const DrawLayouts& layouts)
{
    GatherPass pass;
    const NumberedSet point_sets[] = {{shared::kSetScene, layouts.scene.get()},
                                      {shared::kSetGatherPoint, layouts.gather_point.get()}};
    for (const size_t slices : {size_t{0}, size_t{1}})
        for (const size_t deformed : {size_t{0}, size_t{1}})
        {
            DrawConstants constants{};
            constants[shared::kConstantUsedSlices] = slices == 0 ? 1 : shared::kPoolSlices;
            constants[shared::kConstantDeformed] =
                deformed == 0 ? shared::kDeformedNone : shared::kDeformedPreSkinned;
            HEARTH_ASSIGN_OR_RETURN(
                pass.points_[slices][deformed],
                createComputePipeline(device, shaders::gather_points_comp, point_sets, 0, constants));
        }
    const NumberedSet ray_sets[] = {{shared::kSetBricks, layouts.bricks.get()},
                                    {shared::kSetGather, layouts.gather.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.rays_, createComputePipeline(device, shaders::gather_rays_comp, ray_sets));
    const NumberedSet smooth_sets[] = {{shared::kSetGatherSmooth, layouts.gather.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.smooth_,
                            createComputePipeline(device, shaders::gather_smooth_comp, smooth_sets));
    return pass;
}

void GatherPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                        FrameTargets& targets, const shared::FrameView& view, bool light_changes) const
{
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    GatherTargets& gather = targets.gather();
    const shared::GatherView gather_view = gather.beginFrame(view, scene.bricks->grid.origin, light_changes);
    const auto [tiles_x, tiles_y] = gather.tiles();
    // waits for the gathering and shading of the last frame
    transition(device, commands, gather.texels(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0,
               VK_ACCESS_SHADER_WRITE_BIT, kCompute | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, kCompute);
    barrier(device, commands, kCompute | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
            kCompute | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT);
    device.vk.vkCmdUpdateBuffer(commands, gather.view().handle.get(), 0, sizeof(gather_view), &gather_view);
    barrier(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, kCompute,
            VK_ACCESS_UNIFORM_READ_BIT);

    const uint32_t groups_x = (tiles_x + shared::kGatherGroupTiles - 1) / shared::kGatherGroupTiles,
                   groups_y = (tiles_y + shared::kGatherGroupTiles - 1) / shared::kGatherGroupTiles;
    const auto wait = [&]
    {
        barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT,
                kCompute | VK_PIPELINE_STAGE_TRANSFER_BIT,
                VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT);
    };
    bind(device, commands, points_[scene.used_slices == 1 ? 0 : 1][scene.deformation != nullptr ? 1 : 0],
         shared::kSetScene, {scene.frame().main.draw_set, gather.pointSet()});
    device.vk.vkCmdDispatch(commands, groups_x, groups_y, 1);
    wait();
    bind(device, commands, rays_, shared::kSetBricks, {scene.frame().brick_set, gather.gatherSet()});
    device.vk.vkCmdDispatch(commands, (tiles_x + shared::kGatherGroupPoints - 1) / shared::kGatherGroupPoints,
                            tiles_y, 1);
    wait();
    bind(device, commands, smooth_, shared::kSetGatherSmooth, {gather.gatherSet()});
    device.vk.vkCmdDispatch(commands, groups_x, groups_y, 1);
    transition(device, commands, gather.texels(), VK_IMAGE_LAYOUT_GENERAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT, kCompute, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
}

} // namespace hearth::gpu
