// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_stream.h"

#include "formats/gpu_shared/decisions.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/vulkan/pipelines.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>

namespace hearth::gpu
{

namespace
{

/// Decode a request of shared::groupPriority to error / threshold, to within an eighth; > 1.
float priorityFromRequest(uint32_t request)
{
    constexpr auto kOne = std::bit_cast<uint32_t>(1.0f);
    constexpr auto kMaxBits = std::bit_cast<uint32_t>(std::numeric_limits<float>::max());
    return std::bit_cast<float>(kOne + std::min(request, kMaxBits - kOne));
}

/// Slice and offset of a pool address.
struct PoolAddress
{
    uint32_t slice;
    VkDeviceSize offset_bytes;
};

PoolAddress splitAddress(uint32_t address)
{
    return {address >> shared::kPoolSliceAddressBits,
            VkDeviceSize{address & ((1u << shared::kPoolSliceAddressBits) - 1)} * 4};
}

} // namespace

Result<SceneStream::Memory> SceneStream::createMemory(const Device& device, const formats::PackView& pack,
                                                      const PoolLayout& pool, const StreamOptions& options)
{
    Memory memory{.arena = MemoryArena(device, 0), .staging = {}, .feedback = {}};
    HEARTH_ASSIGN_OR_RETURN(memory.staging,
                            memory.arena.createBuffer(VkDeviceSize{2} * options.max_loads * pool.slot_bytes,
                                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::staging));
    for (uint32_t frame = 0; frame < options.frames_in_flight; ++frame)
    {
        RequestReadback feedback;
        HEARTH_ASSIGN_OR_RETURN(feedback.requests,
                                memory.arena.createBuffer(pack.pages().size() * sizeof(uint32_t),
                                                          VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                          MemoryKind::readback));
        memory.feedback.push_back(std::move(feedback));
    }
    return memory;
}

Result<std::unique_ptr<SceneStream>> SceneStream::create(const Device& device, const formats::PackView& pack,
                                                         const pack::PageGraph& graph, const PoolLayout& pool,
                                                         const StreamOptions& options)
{
    HEARTH_ASSERT(options.read != nullptr && options.max_loads >= 1 && options.frames_in_flight >= 1);
    HEARTH_ASSIGN_OR_RETURN(Memory memory, createMemory(device, pack, pool, options));
    const auto slot_count = static_cast<uint32_t>(pool.slot_addresses.size());
    const uint64_t budget_bytes = graph.pinnedBytes() + uint64_t{slot_count} * pool.slot_bytes;
    const std::span<std::byte> staging(memory.staging.mapped,
                                       size_t{2} * options.max_loads * pool.slot_bytes);
    HEARTH_ASSIGN_OR_RETURN(
        pack::PageStream pages,
        pack::PageStream::create(pack, graph.withSlotSize(pool.slot_bytes),
                                 {.residency = {.budget_bytes = budget_bytes, .max_loads = options.max_loads},
                                  .slot_count = slot_count,
                                  .slot_bytes = pool.slot_bytes,
                                  .read = options.read},
                                 staging));
    return std::unique_ptr<SceneStream>(
        new SceneStream(device, pack, pool, std::move(memory), std::move(pages)));
}

void SceneStream::beginFrame(uint64_t serial, uint64_t completed_serial)
{
    HEARTH_ASSERT(recorded_);
    recorded_ = false;
    serial_ = serial;
    changes_ = pages_.beginFrame(serial, completed_serial);
    for (const uint32_t page : changes_.failed)
        warn(device_, pack_.name(), "page " + std::to_string(page),
             "cannot be read: what it refines stays coarse");
    readRequests(completed_serial);
}

void SceneStream::readRequests(uint64_t completed_serial)
{
    uint64_t last = 0;
    for (RequestReadback& feedback : memory_.feedback)
        if (feedback.serial != 0 && feedback.serial <= completed_serial)
        {
            takeRequests(feedback);
            last = std::max(last, feedback.serial);
            feedback.serial = 0;
        }
    if (last != 0)
        pages_.schedule(last);
}

void SceneStream::takeRequests(const RequestReadback& feedback)
{
    const auto* requests = reinterpret_cast<const uint32_t*>(feedback.requests.mapped);
    for (uint32_t page = 0; page < pack_.pages().size(); ++page)
        if (requests[page] != 0)
            pages_.request(page, priorityFromRequest(requests[page]));
}

shared::FrameView SceneStream::scaled(const shared::FrameView& view) const
{
    shared::FrameView result = view;
    if (const float scale = pages_.residency().errorScale(); scale > 1)
        result.threshold = std::max(view.threshold, shared::kMinRequestThreshold) * scale;
    return result;
}

void SceneStream::recordChanges(VkCommandBuffer commands, const SceneBuffers& buffers)
{
    HEARTH_ASSERT(!recorded_);
    recorded_ = true;
    for (const pack::PageUpload& upload : changes_.uploads)
        recordUpload(commands, buffers, upload);
    for (const auto& [group, resident] : changes_.groups)
    {
        const uint32_t absent = resident ? 0 : 1;
        device_.vk.vkCmdUpdateBuffer(commands, buffers.groups.handle.get(),
                                     group * VkDeviceSize{sizeof(shared::Group)} +
                                         offsetof(shared::Group, absent),
                                     sizeof(absent), &absent);
    }
    device_.vk.vkCmdFillBuffer(commands, buffers.page_requests.handle.get(), 0, VK_WHOLE_SIZE, 0);
}

void SceneStream::recordUpload(VkCommandBuffer commands, const SceneBuffers& buffers,
                               const pack::PageUpload& upload) const
{
    const uint32_t address = slot_addresses_[upload.slot];
    const auto [slice, offset_bytes] = splitAddress(address);
    const VkBufferCopy region{upload.staging_slot * VkDeviceSize{slot_bytes_}, offset_bytes,
                              pack_.pages()[upload.page].size};
    device_.vk.vkCmdCopyBuffer(commands, memory_.staging.handle.get(), buffers.pool[slice].handle.get(), 1,
                               &region);
    recordDraws(commands, buffers, upload.page, address);
}

/// The rows of the page's clusters are adjacent, but one command takes only so many bytes.
void SceneStream::recordDraws(VkCommandBuffer commands, const SceneBuffers& buffers, uint32_t page,
                              uint32_t page_address) const
{
    std::array<shared::ClusterDraw, 128> rows;
    const formats::Range clusters = pack_.pages()[page].clusters;
    for (uint32_t done = 0; done < clusters.count; done += static_cast<uint32_t>(rows.size()))
    {
        const uint32_t first = clusters.first + done;
        const uint32_t count = std::min(clusters.count - done, static_cast<uint32_t>(rows.size()));
        for (uint32_t i = 0; i < count; ++i)
            rows[i] = makeClusterDraw(pack_, first + i, page_address);
        device_.vk.vkCmdUpdateBuffer(commands, buffers.cluster_draws.handle.get(),
                                     first * VkDeviceSize{sizeof(shared::ClusterDraw)},
                                     count * VkDeviceSize{sizeof(shared::ClusterDraw)}, rows.data());
    }
}

void SceneStream::recordFeedback(VkCommandBuffer commands, const SceneBuffers& buffers)
{
    const auto free = std::find_if(memory_.feedback.begin(), memory_.feedback.end(),
                                   [](const RequestReadback& feedback) { return feedback.serial == 0; });
    if (free == memory_.feedback.end())
        return;
    free->serial = serial_;
    const VkBufferCopy region{0, 0, free->requests.size};
    device_.vk.vkCmdCopyBuffer(commands, buffers.page_requests.handle.get(), free->requests.handle.get(), 1,
                               &region);
    barrier(device_, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

} // namespace hearth::gpu
