// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/light_passes/light_lists_pass.h"

#include "formats/gpu_shared/push_constants.h"
#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

/// Cells of a workgroup each way: kBlockCells of cell_lights.comp.
constexpr uint32_t kBlockCells = 8;

/// Workgroups that take slots in turn: they fill a large device, and most visible lists are not much longer.
constexpr uint32_t kSlotGroups = 1024;

constexpr uint32_t kSlotTables[] = {shared::kTableFrame,    shared::kTableInstances, shared::kTableStates,
                                    shared::kTableClusters, shared::kTableCounters,  shared::kTableVisible};
constexpr uint32_t kDeformedSlotTables[] = {
    shared::kTableFrame,    shared::kTableInstances, shared::kTableStates,     shared::kTableClusters,
    shared::kTableCounters, shared::kTableVisible,   shared::kTableDeformation};

constexpr uint32_t blocksOver(uint32_t cells)
{
    return (cells + kBlockCells - 1) / kBlockCells;
}

struct Groups
{
    uint32_t x = 1, y = 1, z = 1;
};

/// Commands of a frame that lists lights; each run waits for the one before.
class ListCommands
{
public:
    ListCommands(const Device& device, VkCommandBuffer commands) : device_(device), commands_(commands) {}

    /// sets  from set 0 on
    void run(const ComputePipeline& pipeline, std::initializer_list<VkDescriptorSet> sets, Groups groups,
             std::optional<shared::LightListsPush> push = {})
    {
        constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
        if (has_run_)
            barrier(device_, commands_, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kCompute,
                    VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
        has_run_ = true;
        device_.vk.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        device_.vk.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(),
                                           0, static_cast<uint32_t>(sets.size()), sets.begin(), 0, nullptr);
        if (push)
            device_.vk.vkCmdPushConstants(commands_, pipeline.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                          sizeof(*push), &*push);
        device_.vk.vkCmdDispatch(commands_, groups.x, groups.y, groups.z);
    }

    /// Count the lights of each area, give the lists their places, and write them.
    /// find  pipeline that does the first and the last
    void list(const ComputePipeline& find, std::initializer_list<VkDescriptorSet> sets, Groups groups,
              const ComputePipeline& place, VkDescriptorSet lights, bool marked_only = false)
    {
        const uint32_t marked = marked_only ? 1 : 0;
        run(find, sets, groups, shared::LightListsPush{0, marked});
        run(place, {lights}, {});
        run(find, sets, groups, shared::LightListsPush{1, marked});
    }

private:
    const Device& device_;
    VkCommandBuffer commands_;
    bool has_run_ = false;
};

Groups cellGroups(const shared::LightGrid& grid)
{
    return {blocksOver(grid.max_columns), blocksOver(grid.max_rows), grid.slab_count};
}

} // namespace

Result<LightListsPass> LightListsPass::create(const Device& device, const DrawLayouts& layouts)
{
    LightListsPass pass;
    const NumberedSet sets[] = {{shared::kSetLights, layouts.lights.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.list_lights_, createComputePipeline(device, shaders::list_lights_comp, sets,
                                                                     sizeof(shared::LightListsPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.cell_lights_, createComputePipeline(device, shaders::cell_lights_comp, sets,
                                                                     sizeof(shared::LightListsPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.place_lists_,
                            createComputePipeline(device, shaders::place_lists_comp, sets));
    return pass;
}

LightListsPass::MarkVariant LightListsPass::markVariant(const Scene& scene, LightAreas areas)
{
    return {scene.used_slices,
            scene.deformation == nullptr ? shared::kDeformedNone : shared::kDeformedPreSkinned,
            areas == LightAreas::tiles ? shared::kLightListTiles : shared::kLightListCells};
}

Status LightListsPass::prepare(const Device& device, const DrawLayouts& layouts, Scene& scene,
                               LightAreas areas)
{
    if (areas == LightAreas::slots)
        return prepareSlots(device, layouts, scene);
    if (areas == LightAreas::tiles && tile_lights_.pipeline.get() == VK_NULL_HANDLE)
    {
        const NumberedSet sets[] = {{shared::kSetLights, layouts.lights.get()}};
        HEARTH_ASSIGN_OR_RETURN(tile_lights_, createComputePipeline(device, shaders::tile_lights_comp, sets,
                                                                    sizeof(shared::LightListsPush)));
    }
    if (!needPixels(areas) || mark_lists_.contains(markVariant(scene, areas)))
        return success();
    const MarkVariant variant = markVariant(scene, areas);
    DrawConstants constants{};
    constants[shared::kConstantUsedSlices] = variant[0];
    constants[shared::kConstantDeformed] = variant[1];
    constants[shared::kConstantLightList] = variant[2];
    const NumberedSet sets[] = {{shared::kSetScene, layouts.scene.get()},
                                {shared::kSetSceneLights, layouts.lights.get()},
                                {shared::kSetPixels, layouts.pixels.get()}};
    HEARTH_ASSIGN_OR_RETURN(ComputePipeline marks,
                            createComputePipeline(device, shaders::mark_lists_comp, sets, 0, constants));
    mark_lists_.emplace(variant, std::move(marks));
    return success();
}

Status LightListsPass::prepareSlots(const Device& device, const DrawLayouts& layouts, Scene& scene)
{
    const bool is_deformed = scene.deformation != nullptr;
    const std::span<const uint32_t> tables =
        is_deformed ? std::span<const uint32_t>(kDeformedSlotTables) : std::span<const uint32_t>(kSlotTables);
    std::optional<ComputePipeline>& pipeline = slot_lights_[is_deformed ? 1 : 0];
    if (!pipeline)
    {
        HEARTH_ASSIGN_OR_RETURN(
            pipeline,
            createTablePipeline(
                device, is_deformed ? shaders::slot_lights_deformed_comp : shaders::slot_lights_comp, tables,
                sizeof(shared::LightListsPush), NumberedSet{shared::kSetSceneLights, layouts.lights.get()}));
    }
    for (uint32_t number = 0; number < scene.frames.size(); ++number)
    {
        VkDescriptorSet& set = scene.frames[number].slot_light_set;
        if (set == VK_NULL_HANDLE)
        {
            HEARTH_ASSIGN_OR_RETURN(set, createTableSet(device, mainView(scene, number), *pipeline, tables));
        }
    }
    return success();
}

void LightListsPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene,
                            LightAreas areas) const
{
    ListCommands listing(device, commands);
    const VkDescriptorSet lights = scene.frame().light_set;
    listing.run(
        list_lights_, {lights}, {},
        shared::LightListsPush{.writes = 1, .marked_only = areas == LightAreas::visible_cells ? 1u : 0u});
    if (areas == LightAreas::cells)
        listing.list(cell_lights_, {lights}, cellGroups(scene.lights->grid()), place_lists_, lights);
}

void LightListsPass::recordSlots(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    const SceneFrame& frame = scene.frame();
    ListCommands(device, commands)
        .list(*slot_lights_[scene.deformation != nullptr ? 1 : 0], {frame.slot_light_set, frame.light_set},
              {kSlotGroups}, place_lists_, frame.light_set);
}

void LightListsPass::recordVisible(const Device& device, VkCommandBuffer commands, const Scene& scene,
                                   const FrameTargets& targets, LightAreas areas) const
{
    const SceneFrame& frame = scene.frame();
    const shared::LightCascade& tiles = scene.lights->tiles();
    const Groups tile_groups{tiles.columns, tiles.rows};
    ListCommands listing(device, commands);
    listing.run(mark_lists_.at(markVariant(scene, areas)),
                {frame.main.draw_set, frame.light_set, targets.pixelSet()}, tile_groups);
    if (areas == LightAreas::tiles)
        listing.list(tile_lights_, {frame.light_set}, tile_groups, place_lists_, frame.light_set);
    else
        listing.list(cell_lights_, {frame.light_set}, cellGroups(scene.lights->grid()), place_lists_,
                     frame.light_set, true);
}

} // namespace hearth::gpu
