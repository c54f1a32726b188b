// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/word_copy_pass.h"

#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

Result<WordCopyPass> WordCopyPass::create(const Device& device)
{
    constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
    const SetBinding bindings[] = {storageBinding(shared::kWordCopyRegions, kStage),
                                   storageBinding(shared::kWordCopySource, kStage),
                                   storageBinding(shared::kWordCopyTarget, kStage)};
    WordCopyPass pass;
    HEARTH_ASSIGN_OR_RETURN(UniqueSetLayout layout, createSetLayout(device, bindings));
    const NumberedSet sets[] = {{shared::kSetWordCopy, layout.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_, createComputePipeline(device, shaders::copy_words_comp, sets,
                                                                  sizeof(shared::WordCopyPush)));
    pass.pipeline_.set_layout = std::move(layout);
    return pass;
}

Result<VkDescriptorSet> WordCopyPass::createSet(const Device& device, const Scene& scene,
                                                const SceneFrame& frame, const Buffer& source,
                                                const Buffer& target) const
{
    HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                            allocateSet(device, scene.pool.get(), pipeline_.set_layout.get()));
    DescriptorWriter(set)
        .storage(shared::kWordCopyRegions, frame.copy_regions)
        .storage(shared::kWordCopySource, source)
        .storage(shared::kWordCopyTarget, target)
        .write(device);
    return set;
}

Status WordCopyPass::createSets(const Device& device, Scene& scene) const
{
    for (SceneFrame& frame : scene.frames)
    {
        if (scene.stream != nullptr)
        {
            for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
            {
                HEARTH_ASSIGN_OR_RETURN(
                    frame.stream_copy_sets[slice],
                    createSet(device, scene, frame, scene.stream->staging(), scene.buffers.pool[slice]));
            }
            HEARTH_ASSIGN_OR_RETURN(
                frame.stream_copy_sets.back(),
                createSet(device, scene, frame, frame.copy_regions, scene.buffers.groups));
        }
        if (scene.bricks != nullptr)
        {
            HEARTH_ASSIGN_OR_RETURN(frame.brick_copy_set, createSet(device, scene, frame, scene.bricks->fresh,
                                                                    scene.bricks->lighting));
        }
    }
    return success();
}

void WordCopyPass::record(const Device& device, VkCommandBuffer commands, VkDescriptorSet set,
                          const CopyRange& range) const
{
    if (range.count == 0)
        return;
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.layout.get(),
                                      shared::kSetWordCopy, 1, &set, 0, nullptr);
    for (uint32_t done = 0; done < range.count; done += shared::kMaxDispatchX)
    {
        const shared::WordCopyPush push{range.first + done};
        device.vk.vkCmdPushConstants(commands, pipeline_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
        device.vk.vkCmdDispatch(commands, std::min(range.count - done, shared::kMaxDispatchX), 1, 1);
    }
}

} // namespace hearth::gpu
