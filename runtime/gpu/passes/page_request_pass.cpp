// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/page_request_pass.h"

#include "runtime/shaders/shaders.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

struct RequestPush
{
    uint32_t first_item;
    uint32_t item_count;
};

} // namespace

Result<PageRequestPass> PageRequestPass::create(const Device& device)
{
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    PageRequestPass pass;
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_,
                            createComputePipeline(device, shaders::page_requests_comp,
                                                  {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStorage, kStorage,
                                                   kStorage, kStorage, kStorage, kStorage},
                                                  sizeof(RequestPush)));
    return pass;
}

Status PageRequestPass::prepareDeformed(const Device& device)
{
    if (!deformed_)
    {
        constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        HEARTH_ASSIGN_OR_RETURN(deformed_,
                                createComputePipeline(device, shaders::page_requests_deformed_comp,
                                                      {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStorage, kStorage,
                                                       kStorage, kStorage, kStorage, kStorage, kStorage},
                                                      sizeof(RequestPush)));
    }
    return success();
}

Status PageRequestPass::createSet(const Device& device, Scene& scene) const
{
    HEARTH_ASSIGN_OR_RETURN(scene.page_request_set,
                            allocateSet(device, scene.pool.get(), pipeline_.set_layout.get()));
    writeSet(device, scene, scene.page_request_set);
    if (scene.deformation != nullptr)
    {
        VkDescriptorSet& set = scene.deformation->page_request_set;
        HEARTH_ASSIGN_OR_RETURN(set, allocateSet(device, scene.pool.get(), deformed_->set_layout.get()));
        writeSet(device, scene, set);
        DescriptorWriter(set).storage(7, scene.deformation->buffer).write(device);
    }
    return success();
}

void PageRequestPass::writeSet(const Device& device, const Scene& scene, VkDescriptorSet set)
{
    const SceneBuffers& b = scene.buffers;
    DescriptorWriter writer(set);
    writer.uniform(0, b.frame)
        .storage(1, b.instances)
        .storage(2, b.states)
        .storage(3, b.group_items)
        .storage(4, b.clusters)
        .storage(5, b.groups)
        .storage(6, b.page_requests);
    writer.write(device);
}

void PageRequestPass::record(const Device& device, VkCommandBuffer commands, const Scene& scene) const
{
    const auto ask = [&](const ComputePipeline& pipeline, VkDescriptorSet set, const RequestPush& push)
    {
        if (push.item_count == 0)
            return;
        const VkPipelineLayout layout = pipeline.layout.get();
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0,
                                          nullptr);
        device.vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
        device.vk.vkCmdDispatch(commands, std::min(push.item_count, shared::kMaxDispatchX),
                                (push.item_count + shared::kMaxDispatchX - 1) / shared::kMaxDispatchX, 1);
    };
    const uint32_t items = scene.group_item_count;
    const uint32_t rigid = scene.deformation == nullptr ? items : scene.deformation->rigid_group_items;
    ask(pipeline_, scene.page_request_set, {0, rigid});
    if (scene.deformation != nullptr)
        ask(*deformed_, scene.deformation->page_request_set, {rigid, items - rigid});
    // the late culling phase overwrites the states that this pass has read
    barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
            VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_ACCESS_TRANSFER_READ_BIT);
}

} // namespace hearth::gpu
