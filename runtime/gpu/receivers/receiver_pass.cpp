// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/receivers/receiver_pass.h"

#include "formats/gpu_shared/records.h"
#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/gpu/vulkan/sampler.h"
#include "runtime/shaders/shaders.h"

#include <cstring>

namespace hearth::gpu
{

namespace
{

constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkBufferUsageFlags kTable = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// Create the image, without light.
Result<Image> createTexels(const formats::ReceiverAtlasRecord& atlas, MemoryArena& arena, Uploader& uploader)
{
    HEARTH_ASSIGN_OR_RETURN(
        Image image,
        arena.createImage({.format = VK_FORMAT_R32_UINT,
                           .extent = {atlas.width, atlas.height},
                           .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                           .has_views = true}));
    const std::vector<uint32_t> dark(size_t{atlas.width} * atlas.height);
    HEARTH_TRY(uploader.upload(image, std::as_bytes(std::span(dark)), {.bytes = sizeof(uint32_t)}));
    return image;
}

} // namespace

Result<ReceiverPass> ReceiverPass::create(const Device& device)
{
    constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
    const SetBinding bindings[] = {storageBinding(shared::kReceiversBlocks, kStage),
                                   storageBinding(shared::kReceiversWords, kStage),
                                   storageBinding(shared::kReceiversWeights, kStage),
                                   {shared::kReceiversTexels, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kStage}};
    ReceiverPass pass;
    HEARTH_ASSIGN_OR_RETURN(UniqueSetLayout layout, createSetLayout(device, bindings));
    const NumberedSet sets[] = {{shared::kSetReceivers, layout.get()}};
    HEARTH_ASSIGN_OR_RETURN(pass.pipeline_, createComputePipeline(device, shaders::receivers_update_comp,
                                                                  sets, sizeof(shared::ReceiversPush)));
    pass.pipeline_.set_layout = std::move(layout);
    return pass;
}

Result<ReceiverAtlas> ReceiverPass::upload(const Device& device, const formats::ReceiverTables& tables,
                                           uint32_t frames, Uploader& uploader) const
{
    HEARTH_ASSERT(frames > 0);
    ReceiverAtlas atlas(device);
    atlas.record = tables.atlas;
    HEARTH_ASSIGN_OR_RETURN(atlas.blocks,
                            atlas.arena.createBuffer(tables.blocks.size_bytes(), kTable, MemoryKind::device));
    HEARTH_TRY(uploader.uploadRecords(atlas.blocks, tables.blocks));
    HEARTH_ASSIGN_OR_RETURN(atlas.words,
                            atlas.arena.createBuffer(tables.words.size_bytes(), kTable, MemoryKind::device));
    HEARTH_TRY(uploader.uploadRecords(atlas.words, tables.words));
    HEARTH_ASSIGN_OR_RETURN(atlas.weights,
                            atlas.arena.createBuffer(frames * tables.lamps.size() * sizeof(Float4),
                                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::upload));
    HEARTH_ASSIGN_OR_RETURN(atlas.texels, createTexels(tables.atlas, atlas.arena, uploader));
    HEARTH_ASSIGN_OR_RETURN(atlas.colors, createView(device, atlas.texels, VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
                                                     VK_IMAGE_USAGE_SAMPLED_BIT));
    HEARTH_ASSIGN_OR_RETURN(atlas.sampler, createClampingSampler(device, VK_FILTER_LINEAR));
    HEARTH_ASSIGN_OR_RETURN(atlas.pool, createDescriptorPool(device, 1, {.storages = 3, .images = 1}));
    HEARTH_ASSIGN_OR_RETURN(atlas.set, allocateSet(device, atlas.pool.get(), pipeline_.set_layout.get()));
    DescriptorWriter(atlas.set)
        .storage(shared::kReceiversBlocks, atlas.blocks)
        .storage(shared::kReceiversWords, atlas.words)
        .storage(shared::kReceiversWeights, atlas.weights)
        .image(shared::kReceiversTexels, atlas.texels.view.get())
        .write(device);
    return atlas;
}

void ReceiverPass::record(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas,
                          uint32_t frame, std::span<const Float3> weights, uint32_t groups) const
{
    HEARTH_ASSERT(weights.size() == atlas.record.lamp_count);
    if (groups == 0)
        return;
    const uint32_t first_weight = frame * atlas.record.lamp_count;
    HEARTH_ASSERT((size_t{first_weight} + weights.size()) * sizeof(Float4) <= atlas.weights.size);
    for (size_t i = 0; i < weights.size(); ++i)
    {
        const Float4 weight{weights[i].x, weights[i].y, weights[i].z, 0};
        std::memcpy(atlas.weights.mapped + (first_weight + i) * sizeof(weight), &weight, sizeof(weight));
    }
    constexpr VkPipelineStageFlags kReaders = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | kCompute;
    transition(device, commands, atlas.texels, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_SHADER_WRITE_BIT, kReaders,
               kCompute);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.layout.get(),
                                      shared::kSetReceivers, 1, &atlas.set, 0, nullptr);
    uint32_t first = 0;
    for (uint32_t group = 0; group < shared::kReceiverGroups; ++group)
    {
        const uint32_t end = first + atlas.record.group_blocks[group];
        for (; (groups >> group & 1) != 0 && first < end; first += shared::kMaxDispatchX)
        {
            const shared::ReceiversPush push{first, first_weight, atlas.record.codec};
            device.vk.vkCmdPushConstants(commands, pipeline_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                         sizeof(push), &push);
            device.vk.vkCmdDispatch(commands, std::min(end - first, shared::kMaxDispatchX), 1, 1);
        }
        first = end;
    }
    transition(device, commands, atlas.texels, VK_IMAGE_LAYOUT_GENERAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_WRITE_BIT,
               VK_ACCESS_SHADER_READ_BIT, kCompute, kReaders);
}

} // namespace hearth::gpu
