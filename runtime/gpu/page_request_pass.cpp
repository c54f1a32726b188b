// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/page_request_pass.h"

#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

Result<PageRequestPass> PageRequestPass::create(const Device& device)
{
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    PageRequestPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_,
                            createComputePipeline(device, shaders::page_requests_comp,
                                                  {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStorage, kStorage,
                                                   kStorage, kStorage, kStorage, kStorage},
                                                  sizeof(uint32_t)));
    return pass;
}

Status PageRequestPass::createSet(const Device& device, Scene& scene) const
{
    const SceneBuffers& b = scene.buffers;
    HEARTH_ASSIGN_OR_RETURN(scene.page_request_set,
                            allocateSet(device, scene.pool.get(), pipeline_.set_layout.get()));
    DescriptorWriter writer(scene.page_request_set);
    writer.uniform(0, b.frame)
        .storage(1, b.instances)
        .storage(2, b.states)
        .storage(3, b.group_items)
        .storage(4, b.clusters)
        .storage(5, b.groups)
        .storage(6, b.page_requests);
    writer.write(device);
    return success();
}

void PageRequestPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    const uint32_t items = scene.group_item_count;
    if (items > 0)
    {
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.layout.get(), 0,
                                          1, &scene.page_request_set, 0, nullptr);
        device.vk.vkCmdPushConstants(commands, pipeline_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(items), &items);
        device.vk.vkCmdDispatch(commands, std::min(items, shared::kDispatchRow),
                                (items + shared::kDispatchRow - 1) / shared::kDispatchRow, 1);
    }
    // the late culling phase writes the states that this has read
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
