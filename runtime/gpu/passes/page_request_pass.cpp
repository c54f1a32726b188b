// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/page_request_pass.h"

#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kRequestTables[] = {
    shared::kTableFrame,    shared::kTableInstances, shared::kTableStates,      shared::kTableGroupItems,
    shared::kTableClusters, shared::kTableGroups,    shared::kTablePageRequests};
constexpr uint32_t kDeformedRequestTables[] = {
    shared::kTableFrame,    shared::kTableInstances, shared::kTableStates,       shared::kTableGroupItems,
    shared::kTableClusters, shared::kTableGroups,    shared::kTablePageRequests, shared::kTableDeformation};

} // namespace

Result<PageRequestPass> PageRequestPass::create(const Device& device)
{
    PageRequestPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_,
                            createTablePipeline(device, shaders::page_requests_comp, kRequestTables,
                                                sizeof(shared::PageRequestPush)));
    return pass;
}

Status PageRequestPass::prepareDeformed(const Device& device)
{
    if (!deformed_)
    {
        HEARTH_ASSIGN_OR_RETURN(deformed_,
                                createTablePipeline(device, shaders::page_requests_deformed_comp,
                                                    kDeformedRequestTables, sizeof(shared::PageRequestPush)));
    }
    return success();
}

Status PageRequestPass::createSets(const Device& device, Scene& scene) const
{
    for (uint32_t number = 0; number < scene.frames.size(); ++number)
    {
        SceneFrame& frame = scene.frames[number];
        HEARTH_ASSIGN_OR_RETURN(frame.page_request_set,
                                createTableSet(device, mainView(scene, number), pipeline_, kRequestTables));
        if (scene.deformation != nullptr)
        {
            HEARTH_ASSIGN_OR_RETURN(
                frame.deformed_page_request_set,
                createTableSet(device, mainView(scene, number), *deformed_, kDeformedRequestTables));
        }
    }
    return success();
}

void PageRequestPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    const auto ask =
        [&](const ComputePipeline& pipeline, VkDescriptorSet set, const shared::PageRequestPush& push)
    {
        if (push.item_count == 0)
            return;
        const VkPipelineLayout layout = pipeline.layout.get();
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout,
                                          shared::kSetTables, 1, &set, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
        device.vk.vkCmdDispatch(commands, std::min(push.item_count, shared::kMaxDispatchX),
                                (push.item_count + shared::kMaxDispatchX - 1) / shared::kMaxDispatchX, 1);
    };
    const uint32_t items = scene.group_item_count;
    const uint32_t rigid = scene.deformation == nullptr ? items : scene.deformation->rigid_group_items;
    const auto pages = scene.stream->pages().residency().graph().pageCount();
    const auto default_row = static_cast<uint32_t>(scene.materials.size()) - 1;
    ask(pipeline_, scene.frame().page_request_set, {0, rigid, pages, default_row});
    if (scene.deformation != nullptr)
        ask(*deformed_, scene.frame().deformed_page_request_set, {rigid, items - rigid, pages, default_row});
    // the late culling phase overwrites the states that this pass has read; the host reads the requests
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_HOST_READ_BIT);
}

} // namespace hearth::gpu
