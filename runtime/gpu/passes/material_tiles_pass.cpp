// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/material_tiles_pass.h"

#include "formats/gpu_shared/material_tiles.h"
#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

/// Tables of all three pipelines, so that one set fits all.
constexpr uint32_t kTileTables[] = {shared::kTableVisible, shared::kTableDraws, shared::kTableTileDraws};

static_assert(sizeof(shared::TileDraw) == sizeof(VkDrawIndirectCommand));

} // namespace

Result<MaterialTilesPass> MaterialTilesPass::create(const Device& device, const DrawLayouts& layouts)
{
    const auto createPipeline = [&](std::span<const uint32_t> spirv)
    {
        return createTablePipeline(device, spirv, kTileTables, sizeof(shared::TilesPush),
                                   NumberedSet{shared::kSetTiles, layouts.tiles.get()});
    };
    MaterialTilesPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.materials_, createPipeline(shaders::tile_materials_comp));
    HEARTH_ASSIGN_OR_RETURN(pass.offsets_, createPipeline(shaders::tile_offsets_comp));
    HEARTH_ASSIGN_OR_RETURN(pass.lists_, createPipeline(shaders::tile_lists_comp));
    return pass;
}

Status MaterialTilesPass::createSets(const Device& device, Scene& scene) const
{
    for (uint32_t number = 0; number < scene.frames.size(); ++number)
    {
        HEARTH_ASSIGN_OR_RETURN(scene.frames[number].tile_set,
                                createTableSet(device, mainView(scene, number), materials_, kTileTables));
    }
    return success();
}

void MaterialTilesPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                               const FrameTargets& targets) const
{
    const auto [width, height] = targets.extent();
    const shared::TilesPush push{width, height, static_cast<uint32_t>(scene.materials.size()) + 1};
    const auto dispatch = [&](const ComputePipeline& pipeline, uint32_t x, uint32_t y)
    {
        const VkDescriptorSet sets[] = {scene.frame().tile_set, targets.tileSet()};
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                          shared::kSetTables, 2, sets, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, pipeline.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
        device.vk.vkCmdDispatch(commands, x, y, 1);
    };
    const auto wait = [&]
    {
        barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    };
    dispatch(materials_, shared::materialTiles(width), shared::materialTiles(height));
    wait();
    dispatch(offsets_, 1, 1);
    wait();
    dispatch(lists_, std::min(push.draw_count, shared::kMaxDispatchX),
             (push.draw_count + shared::kMaxDispatchX - 1) / shared::kMaxDispatchX);
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
