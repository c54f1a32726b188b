// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_stream.h"

#include "formats/gpu_shared/decisions.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/textures/streamed_textures.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
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

} // namespace

Result<SceneStream::Memory> SceneStream::createMemory(const Device& device, const PoolLayout& pool,
                                                      const StreamOptions& options)
{
    Memory memory{.arena = MemoryArena(device, 0), .staging = {}};
    HEARTH_ASSIGN_OR_RETURN(
        memory.staging, memory.arena.createBuffer(VkDeviceSize{2} * options.max_loads * pool.slot_bytes,
                                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::staging));
    return memory;
}

Result<std::unique_ptr<SceneStream>> SceneStream::create(const Device& device, const formats::PackView& pack,
                                                         const pack::PageGraph& graph, const PoolLayout& pool,
                                                         const StreamOptions& options)
{
    HEARTH_ASSERT(options.read != nullptr && options.max_loads >= 1);
    HEARTH_ASSIGN_OR_RETURN(Memory memory, createMemory(device, pool, options));
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
    if (textures_ != nullptr)
        textures_->beginFrame(serial, completed_serial);
    readRequests(completed_serial);
}

void SceneStream::readRequests(uint64_t completed_serial)
{
    uint64_t last = 0;
    for (RequestReadback& feedback : feedback_)
        if (feedback.serial != 0 && feedback.serial <= completed_serial)
        {
            takeRequests(feedback);
            last = std::max(last, feedback.serial);
            feedback.serial = 0;
        }
    if (last == 0)
        return;
    pages_.schedule(last);
    if (textures_ != nullptr)
    {
        textures_->request(material_requests_);
        textures_->schedule(last);
    }
    std::ranges::fill(material_requests_, 0u);
}

uint64_t SceneStream::settledSerial() const
{
    return textures_ == nullptr ? pages_.settledSerial()
                                : std::min(pages_.settledSerial(), textures_->stream().settledSerial());
}

void SceneStream::retryFailed()
{
    pages_.retryFailed();
    if (textures_ != nullptr)
        textures_->retryFailed();
}

VkDeviceSize SceneStream::allocatedBytes() const
{
    const VkDeviceSize own = memory_.arena.allocatedBytes();
    return textures_ == nullptr ? own
                                : own + textures_->stagingBytes() + textures_->statistics().bytes_on_device;
}

void SceneStream::takeRequests(const RequestReadback& feedback)
{
    const auto* requests = reinterpret_cast<const uint32_t*>(feedback.requests->mapped);
    for (uint32_t page = 0; page < pack_.pages().size(); ++page)
        if (requests[page] != 0)
            pages_.request(page, priorityFromRequest(requests[page]));
    const uint32_t* const materials = requests + pack_.pages().size();
    for (size_t row = 0; row < material_requests_.size(); ++row)
        material_requests_[row] = std::max(material_requests_[row], materials[row]);
}

shared::FrameView SceneStream::scaled(const shared::FrameView& view) const
{
    shared::FrameView result = view;
    if (const float scale = pages_.residency().errorScale(); scale > 1)
        result.threshold = std::max(view.threshold, shared::kMinRequestThreshold) * scale;
    return result;
}

void SceneStream::setFrames(std::span<const SceneFrame> frames)
{
    for (const SceneFrame& frame : frames)
        feedback_.push_back({&frame.page_requests, 0});
    material_requests_.resize(pack_.materials().size() + 1);
}

uint32_t SceneStream::maxCopyRegions() const
{
    const auto pages = static_cast<uint32_t>(memory_.staging.size / slot_bytes_);
    return pages * WordCopies::countRegions(slot_bytes_ / 4) + static_cast<uint32_t>(pack_.groups().size());
}

SceneStream::Copies SceneStream::takeChanges(const SceneBuffers& buffers, uint32_t number, WordCopies& copies)
{
    HEARTH_ASSERT(!recorded_);
    recorded_ = true;
    Copies ranges;
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        ranges[slice] = listUploads(slice, copies);
    for (const pack::PageUpload& upload : changes_.uploads)
        writeDraws(buffers, upload);
    copies.begin();
    constexpr size_t kAbsentWord = offsetof(shared::Group, absent) / sizeof(uint32_t);
    for (const auto& [group, resident] : changes_.groups)
        copies.addFlag(!resident, static_cast<uint32_t>(group * (sizeof(shared::Group) / sizeof(uint32_t)) +
                                                        kAbsentWord));
    ranges.back() = copies.range();

    RequestReadback& feedback = feedback_[number];
    std::memset(feedback.requests->mapped, 0, static_cast<size_t>(feedback.requests->size));
    feedback.serial = serial_;
    return ranges;
}

/// List the copies of pages whose slots lie in a slice of the pool.
CopyRange SceneStream::listUploads(uint32_t slice, WordCopies& copies) const
{
    copies.begin();
    for (const pack::PageUpload& upload : changes_.uploads)
    {
        const uint32_t address = slot_addresses_[upload.slot];
        if (address >> shared::kPoolSliceAddressBits == slice)
            copies.add(upload.staging_slot * (slot_bytes_ / 4),
                       address & ((1u << shared::kPoolSliceAddressBits) - 1),
                       (pack_.pages()[upload.page].size + 3) / 4);
    }
    return copies.range();
}

/// Write the rows of a page's clusters, which no frame in flight draws.
void SceneStream::writeDraws(const SceneBuffers& buffers, const pack::PageUpload& upload) const
{
    const formats::Range clusters = pack_.pages()[upload.page].clusters;
    for (uint32_t i = 0; i < clusters.count; ++i)
    {
        const shared::ClusterDraw row =
            makeClusterDraw(pack_, clusters.first + i, slot_addresses_[upload.slot]);
        std::memcpy(buffers.cluster_draws.mapped + size_t{clusters.first + i} * sizeof(row), &row,
                    sizeof(row));
    }
}

} // namespace hearth::gpu
