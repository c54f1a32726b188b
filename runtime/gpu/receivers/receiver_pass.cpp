// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/receivers/receiver_pass.h"

#include "formats/gpu_shared/receivers/receiver_points.h"
#include "formats/gpu_shared/records.h"
#include "runtime/gpu/vulkan/image_barrier.h"
#include "runtime/gpu/vulkan/sampler.h"
#include "runtime/shaders/shaders.h"

#include <cstring>
#include <string>

namespace hearth::gpu
{

namespace
{

constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkImageLayout kDrawn = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr VkBufferUsageFlags kTable = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// Create the image, without light.
/// usage  by the way of the update
Result<Image> createTexels(const formats::ReceiverAtlasRecord& atlas, VkImageUsageFlags usage,
                           MemoryArena& arena, Uploader& uploader)
{
    HEARTH_ASSIGN_OR_RETURN(Image image, arena.createImage({.format = VK_FORMAT_R32_UINT,
                                                            .extent = {atlas.width, atlas.height},
                                                            .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT |
                                                                     VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                                                     VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                                            .has_views = true}));
    const std::vector<uint32_t> dark(size_t{atlas.width} * atlas.height);
    HEARTH_TRY(uploader.upload(image, std::as_bytes(std::span(dark)), {.bytes = sizeof(uint32_t)}));
    return image;
}

/// Create the render pass in which points are drawn. Texels without a point stay.
Result<UniqueRenderPass> createPointsPass(const Device& device)
{
    VkAttachmentDescription attachment{};
    attachment.format = VK_FORMAT_R32_UINT;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = attachment.finalLayout = kDrawn;
    const VkAttachmentReference reference{0, kDrawn};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass handle;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &handle),
                  "create a render pass");
    return UniqueRenderPass(device, handle);
}

/// Create the tables of receivers.
/// frames  in flight, at least 1
Result<ReceiverBuffers> createBuffers(const formats::ReceiverTables& tables, uint32_t frames,
                                      MemoryArena& arena, Uploader& uploader)
{
    HEARTH_ASSERT(frames > 0);
    ReceiverBuffers buffers{.record = tables.atlas, .blocks = {}, .words = {}, .weights = {}};
    HEARTH_ASSIGN_OR_RETURN(buffers.blocks,
                            arena.createBuffer(tables.blocks.size_bytes(), kTable, MemoryKind::device));
    HEARTH_TRY(uploader.uploadRecords(buffers.blocks, tables.blocks));
    HEARTH_ASSIGN_OR_RETURN(buffers.words,
                            arena.createBuffer(tables.words.size_bytes(), kTable, MemoryKind::device));
    HEARTH_TRY(uploader.uploadRecords(buffers.words, tables.words));
    HEARTH_ASSIGN_OR_RETURN(buffers.weights,
                            arena.createBuffer(frames * tables.lamps.size() * sizeof(Float4),
                                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::upload));
    return buffers;
}

/// Write the weights of a frame. Returns the number of the first.
uint32_t writeWeights(const ReceiverBuffers& buffers, uint32_t frame, std::span<const Float3> weights)
{
    HEARTH_ASSERT(weights.size() == buffers.record.lamp_count);
    const uint32_t first_weight = frame * buffers.record.lamp_count;
    HEARTH_ASSERT((size_t{first_weight} + weights.size()) * sizeof(Float4) <= buffers.weights.size);
    for (size_t i = 0; i < weights.size(); ++i)
    {
        const Float4 weight{weights[i].x, weights[i].y, weights[i].z, 0};
        std::memcpy(buffers.weights.mapped + (first_weight + i) * sizeof(weight), &weight, sizeof(weight));
    }
    return first_weight;
}

/// Call visit(first block, number of blocks) for the blocks of some groups, with as many at a time as one
/// dispatch has.
template <typename Visit>
void forEachBlocks(const formats::ReceiverAtlasRecord& record, uint32_t groups, const Visit& visit)
{
    uint32_t first = 0;
    for (uint32_t group = 0; group < shared::kReceiverGroups; ++group)
    {
        const uint32_t end = first + record.group_blocks[group];
        for (; (groups >> group & 1) != 0 && first < end; first += shared::kMaxDispatchX)
            visit(first, std::min(end - first, shared::kMaxDispatchX));
        first = end;
    }
}

void writeTables(const ReceiverBuffers& buffers, DescriptorWriter& writer)
{
    writer.storage(shared::kReceiversBlocks, buffers.blocks)
        .storage(shared::kReceiversWords, buffers.words)
        .storage(shared::kReceiversWeights, buffers.weights);
}

/// Stages, accesses and layout by which a way writes texels.
struct TexelAccess
{
    VkPipelineStageFlags stages;
    VkAccessFlags reads, writes;
    VkImageLayout layout;
};

constexpr TexelAccess findAccess(ReceiverUpdate update)
{
    if (update == ReceiverUpdate::points)
        return {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_COLOR_ATTACHMENT_READ_BIT,
                VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, kDrawn};
    return {kCompute, 0, VK_ACCESS_SHADER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL};
}

} // namespace

Result<ReceiverPass> ReceiverPass::create(const Device& device, ReceiverUpdate update)
{
    const bool draws = update == ReceiverUpdate::points;
    const VkShaderStageFlags stage = draws ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_COMPUTE_BIT;
    std::vector<SetBinding> bindings{storageBinding(shared::kReceiversBlocks, stage),
                                     storageBinding(shared::kReceiversWords, stage),
                                     storageBinding(shared::kReceiversWeights, stage)};
    if (!draws)
        bindings.push_back({shared::kReceiversTexels, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, stage});
    ReceiverPass pass;
    pass.update_ = update;
    HEARTH_ASSIGN_OR_RETURN(UniqueSetLayout layout, createSetLayout(device, bindings));
    const NumberedSet sets[] = {{shared::kSetReceivers, layout.get()}};
    if (draws)
        HEARTH_TRY(pass.createPoints(device, sets));
    else
    {
        HEARTH_ASSIGN_OR_RETURN(pass.pipeline_, createComputePipeline(device, shaders::receivers_update_comp,
                                                                      sets, sizeof(shared::ReceiversPush)));
    }
    pass.pipeline_.set_layout = std::move(layout);
    return pass;
}

Status ReceiverPass::createPoints(const Device& device, std::span<const NumberedSet> sets)
{
    HEARTH_ASSIGN_OR_RETURN(render_pass_, createPointsPass(device));
    HEARTH_ASSIGN_OR_RETURN(pipeline_.layout, createPipelineLayout(device, sets, VK_SHADER_STAGE_VERTEX_BIT,
                                                                   sizeof(shared::ReceiverPointsPush)));
    HEARTH_ASSIGN_OR_RETURN(pipeline_.pipeline,
                            createGraphicsPipeline(device, {.vertex = shaders::receivers_points_vert,
                                                            .fragment = shaders::receivers_points_frag,
                                                            .layout = pipeline_.layout.get(),
                                                            .render_pass = render_pass_.get(),
                                                            .subpass = 0,
                                                            .depth_compare = VK_COMPARE_OP_ALWAYS,
                                                            .depth_write = false,
                                                            .colors = 1,
                                                            .topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST}));
    return success();
}

Status ReceiverPass::createFramebuffer(const Device& device, ReceiverAtlas& atlas) const
{
    const uint32_t width = atlas.buffers.record.width, height = atlas.buffers.record.height;
    if (width > device.limits.maxFramebufferWidth || height > device.limits.maxFramebufferHeight)
        return Error{Issue::device_limit, "", "receivers",
                     "an atlas of " + std::to_string(width) + " x " + std::to_string(height) +
                         " texels cannot be updated by points: the device draws to " +
                         std::to_string(device.limits.maxFramebufferWidth) + " x " +
                         std::to_string(device.limits.maxFramebufferHeight)};
    const VkImageView view = atlas.texels.view.get();
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass_.get();
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = width;
    info.height = height;
    info.layers = 1;
    VkFramebuffer framebuffer;
    HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &framebuffer),
                  "create a framebuffer");
    atlas.framebuffer = UniqueFramebuffer(device, framebuffer);
    return success();
}

Result<ReceiverAtlas> ReceiverPass::upload(const Device& device, const formats::ReceiverTables& tables,
                                           uint32_t frames, Uploader& uploader) const
{
    const bool draws = update_ == ReceiverUpdate::points;
    ReceiverAtlas atlas(device);
    HEARTH_ASSIGN_OR_RETURN(atlas.buffers, createBuffers(tables, frames, atlas.arena, uploader));
    HEARTH_ASSIGN_OR_RETURN(
        atlas.texels,
        createTexels(tables.atlas, draws ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT : VK_IMAGE_USAGE_STORAGE_BIT,
                     atlas.arena, uploader));
    if (draws)
        HEARTH_TRY(createFramebuffer(device, atlas));
    HEARTH_ASSIGN_OR_RETURN(atlas.colors, createView(device, atlas.texels, VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
                                                     VK_IMAGE_USAGE_SAMPLED_BIT));
    HEARTH_ASSIGN_OR_RETURN(atlas.sampler, createClampingSampler(device, VK_FILTER_LINEAR));
    HEARTH_ASSIGN_OR_RETURN(atlas.pool,
                            createDescriptorPool(device, 1, {.storages = 3, .images = draws ? 0u : 1u}));
    HEARTH_ASSIGN_OR_RETURN(atlas.set, allocateSet(device, atlas.pool.get(), pipeline_.set_layout.get()));
    DescriptorWriter writer(atlas.set);
    writeTables(atlas.buffers, writer);
    if (!draws)
        writer.image(shared::kReceiversTexels, atlas.texels.view.get());
    writer.write(device);
    return atlas;
}

void ReceiverPass::record(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas,
                          uint32_t frame, std::span<const Float3> weights, uint32_t groups,
                          bool shows_drops) const
{
    if (groups == 0)
        return;
    const uint32_t first_weight = writeWeights(atlas.buffers, frame, weights);
    const uint32_t codec = atlas.buffers.record.codec | (shows_drops ? shared::kReceiverShowsDrops : 0u);
    constexpr VkPipelineStageFlags kReaders = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | kCompute;
    const TexelAccess access = findAccess(update_);
    transition(device, commands, atlas.texels, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, access.layout,
               access.writes, access.reads | access.writes, kReaders | access.stages, access.stages);
    beginUpdate(device, commands, atlas);
    forEachBlocks(atlas.buffers.record, groups,
                  [&](uint32_t first, uint32_t count) {
                      recordBlocks(device, commands, atlas, {first, first_weight, codec, 0}, count);
                  });
    if (update_ == ReceiverUpdate::points)
        device.vk.vkCmdEndRenderPass(commands);
    transition(device, commands, atlas.texels, access.layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               access.writes, VK_ACCESS_SHADER_READ_BIT, access.stages, kReaders);
}

Status ReceiverPass::prepareFaces(const Device& device)
{
    if (faces_.pipeline.get() != VK_NULL_HANDLE)
        return success();
    constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
    const SetBinding bindings[] = {
        storageBinding(shared::kReceiversBlocks, kStage), storageBinding(shared::kReceiversWords, kStage),
        storageBinding(shared::kReceiversWeights, kStage), storageBinding(shared::kReceiversFaces, kStage)};
    HEARTH_ASSIGN_OR_RETURN(UniqueSetLayout layout, createSetLayout(device, bindings));
    const NumberedSet sets[] = {{shared::kSetReceivers, layout.get()}};
    HEARTH_ASSIGN_OR_RETURN(faces_, createComputePipeline(device, shaders::receivers_faces_comp, sets,
                                                          sizeof(shared::ReceiversPush)));
    faces_.set_layout = std::move(layout);
    return success();
}

Result<ReceiverFaces> ReceiverPass::upload(const Device& device, const formats::ReceiverTables& tables,
                                           uint32_t frames, const Buffer& light, uint32_t first_word,
                                           Uploader& uploader) const
{
    ReceiverFaces faces(device);
    faces.first_word = first_word;
    HEARTH_ASSIGN_OR_RETURN(faces.buffers, createBuffers(tables, frames, faces.arena, uploader));
    HEARTH_ASSIGN_OR_RETURN(faces.pool, createDescriptorPool(device, 1, {.storages = 4}));
    HEARTH_ASSIGN_OR_RETURN(faces.set, allocateSet(device, faces.pool.get(), faces_.set_layout.get()));
    DescriptorWriter writer(faces.set);
    writeTables(faces.buffers, writer);
    writer.storage(shared::kReceiversFaces, light).write(device);
    return faces;
}

void ReceiverPass::record(const Device& device, VkCommandBuffer commands, const ReceiverFaces& faces,
                          uint32_t frame, std::span<const Float3> weights, uint32_t groups,
                          bool is_shown) const
{
    if (groups == 0)
        return;
    const uint32_t first_weight = writeWeights(faces.buffers, frame, weights);
    constexpr VkPipelineStageFlags kFragments = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    barrier(device, commands, kCompute | (is_shown ? kFragments : 0), 0, kCompute, 0);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, faces_.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, faces_.layout.get(),
                                      shared::kSetReceivers, 1, &faces.set, 0, nullptr);
    forEachBlocks(faces.buffers.record, groups,
                  [&](uint32_t first, uint32_t count)
                  {
                      const shared::ReceiversPush push{first, first_weight, faces.buffers.record.codec,
                                                       faces.first_word};
                      device.vk.vkCmdPushConstants(commands, faces_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT,
                                                   0, sizeof(push), &push);
                      device.vk.vkCmdDispatch(commands, count, 1, 1);
                  });
    barrier(device, commands, kCompute, VK_ACCESS_SHADER_WRITE_BIT, kCompute | kFragments,
            VK_ACCESS_SHADER_READ_BIT);
}

void ReceiverPass::beginUpdate(const Device& device, VkCommandBuffer commands,
                               const ReceiverAtlas& atlas) const
{
    const VkPipelineBindPoint point =
        update_ == ReceiverUpdate::points ? VK_PIPELINE_BIND_POINT_GRAPHICS : VK_PIPELINE_BIND_POINT_COMPUTE;
    device.vk.vkCmdBindPipeline(commands, point, pipeline_.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, point, pipeline_.layout.get(), shared::kSetReceivers, 1,
                                      &atlas.set, 0, nullptr);
    if (update_ == ReceiverUpdate::compute)
        return;
    const formats::ReceiverAtlasRecord& record = atlas.buffers.record;
    const VkRect2D area{{0, 0}, {record.width, record.height}};
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = render_pass_.get();
    begin.framebuffer = atlas.framebuffer.get();
    begin.renderArea = area;
    device.vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, static_cast<float>(record.width), static_cast<float>(record.height),
                              0, 1};
    device.vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    device.vk.vkCmdSetScissor(commands, 0, 1, &area);
}

void ReceiverPass::recordBlocks(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas,
                                const shared::ReceiversPush& push, uint32_t count) const
{
    if (update_ == ReceiverUpdate::compute)
    {
        device.vk.vkCmdPushConstants(commands, pipeline_.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
        device.vk.vkCmdDispatch(commands, count, 1, 1);
        return;
    }
    const shared::ReceiverPointsPush points{push.first_block, push.first_weight, push.codec,
                                            2 / static_cast<float>(atlas.buffers.record.width),
                                            2 / static_cast<float>(atlas.buffers.record.height)};
    device.vk.vkCmdPushConstants(commands, pipeline_.layout.get(), VK_SHADER_STAGE_VERTEX_BIT, 0,
                                 sizeof(points), &points);
    device.vk.vkCmdDraw(commands, shared::kReceiverBlockTexels, count, 0, 0);
}

} // namespace hearth::gpu
