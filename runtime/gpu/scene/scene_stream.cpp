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
                                                         const std::optional<pack::ExchangeLayout>& exchange,
                                                         const StreamOptions& options)
{
    HEARTH_ASSERT(options.read != nullptr && options.max_loads >= 1);
    HEARTH_ASSIGN_OR_RETURN(Memory memory, createMemory(device, pool, options));
    const auto slot_count =
        exchange ? exchange->fixed_slots : static_cast<uint32_t>(pool.slot_addresses.size());
    const uint64_t budget_bytes = graph.pinnedBytes() + uint64_t{slot_count} * pool.slot_bytes;
    const std::span<std::byte> staging(memory.staging.mapped,
                                       size_t{2} * options.max_loads * pool.slot_bytes);
    HEARTH_ASSIGN_OR_RETURN(
        pack::PageStream pages,
        pack::PageStream::create(pack, graph.withSlotSize(pool.slot_bytes),
                                 {.residency = {.budget_bytes = budget_bytes, .max_loads = options.max_loads},
                                  .slot_count = slot_count,
                                  .movable_parts = exchange ? exchange->parts : 0,
                                  .part_slots = exchange ? exchange->part_slots : 0,
                                  .slot_bytes = pool.slot_bytes,
                                  .read = options.read},
                                 staging));
    std::unique_ptr<SceneStream> stream(
        new SceneStream(device, pack, pool, std::move(memory), std::move(pages)));
    if (exchange)
    {
        stream->exchange_.emplace(*exchange);
        for (uint32_t part = 0; part < exchange->parts; ++part)
            if (const uint32_t slots = stream->exchange_->slots(part); slots > 0)
                stream->pages_.openPart(1 + part, slots);
        stream->pages_.setDemandSlots(stream->exchange_->demandSlots());
    }
    return stream;
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
    if (exchange_ && exchange_->isMoving())
        moveMemory(completed_serial);
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
    if (exchange_)
        balanceMemory(last);
}

/// Begin a move of memory if the error scales of both sides call for it.
void SceneStream::balanceMemory(uint64_t feedback_serial)
{
    const pack::Residency& pages = pages_.residency();
    const pack::TextureStream& textures = textures_->stream();
    if (exchange_->update({pages.errorScale(), pages.wantedBytes()},
                          {textures.errorScale(), textures.residency().wantedBytes()}))
    {
        for (uint32_t part = 0; part < exchange_->layout().parts; ++part)
            if (exchange_->isClosing(part))
                pages_.closePart(1 + part);
        fitBudgets();
    }
    if (exchange_->atRest())
        balanced_serial_ = feedback_serial;
}

/// Go on with a move: free slices that no frame reads any more, make others once textures have left room.
void SceneStream::moveMemory(uint64_t completed_serial)
{
    closeParts(completed_serial);
    openParts();
    fitBudgets();
}

void SceneStream::closeParts(uint64_t completed_serial)
{
    for (uint32_t part = 0; part < exchange_->layout().parts; ++part)
    {
        const uint32_t slice = first_movable_slice_ + part;
        if (!exchange_->isClosing(part))
            continue;
        if (pool_->isOpen(slice) && pages_.isPartFree(1 + part))
        {
            pool_->close(slice, serial_ - 1);
            markPoolChanged();
        }
        pool_->release(completed_serial);
        if (!pool_->hasMemory(slice))
            exchange_->closed(part);
    }
}

void SceneStream::openParts()
{
    while (const auto opening = exchange_->nextPart(textures_->stream().residency().bytesInUse()))
    {
        const Status opened = pool_->open(device_, first_movable_slice_ + opening->part,
                                          VkDeviceSize{opening->slots} * slot_bytes_);
        if (!opened.ok())
        {
            warn(device_, pack_.name(), "",
                 "geometry keeps the memory that it has: " + opened.error().detail);
            exchange_->failed();
            return;
        }
        pages_.openPart(1 + opening->part, opening->slots);
        exchange_->opened(*opening);
        markPoolChanged();
    }
}

void SceneStream::fitBudgets()
{
    pages_.setDemandSlots(exchange_->demandSlots());
    textures_->setBudget(exchange_->textureBytes());
}

bool SceneStream::takePoolChange(uint32_t number)
{
    const bool has_changed = outdated_pools_[number];
    outdated_pools_[number] = false;
    return has_changed;
}

uint64_t SceneStream::settledSerial() const
{
    uint64_t serial = pages_.settledSerial();
    if (textures_ != nullptr)
        serial = std::min(serial, textures_->stream().settledSerial());
    return exchange_ ? std::min(serial, balanced_serial_) : serial;
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

void SceneStream::setFrames(std::span<const SceneFrame> frames, PoolBuffers& pool)
{
    pool_ = &pool;
    outdated_pools_.resize(frames.size(), false);
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

/// Record copies within the pool. The frames before have read the old slots and rows; the page stays
/// resident.
void SceneStream::recordMoves(VkCommandBuffer commands, const SceneBuffers& buffers) const
{
    if (changes_.moves.empty())
        return;
    constexpr VkPipelineStageFlags kShaders = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                              VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                              VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    barrier(device_, commands, kShaders, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT);
    constexpr uint32_t kOffsetMask = (1u << shared::kPoolSliceAddressBits) - 1;
    constexpr size_t kMaxRows = 65536 / sizeof(shared::ClusterDraw); // of one vkCmdUpdateBuffer
    std::vector<shared::ClusterDraw> rows;
    for (const pack::PageMove& move : changes_.moves)
    {
        const uint32_t from = slot_addresses_[move.from_slot], to = slot_addresses_[move.slot];
        const VkBufferCopy region{VkDeviceSize{from & kOffsetMask} * 4, VkDeviceSize{to & kOffsetMask} * 4,
                                  slot_bytes_};
        device_.vk.vkCmdCopyBuffer(commands, buffers.pool[from >> shared::kPoolSliceAddressBits].handle.get(),
                                   buffers.pool[to >> shared::kPoolSliceAddressBits].handle.get(), 1,
                                   &region);
        const formats::Range clusters = pack_.pages()[move.page].clusters;
        rows.clear();
        for (uint32_t i = 0; i < clusters.count; ++i)
            rows.push_back(makeClusterDraw(pack_, clusters.first + i, to));
        for (size_t done = 0; done < rows.size(); done += kMaxRows)
            device_.vk.vkCmdUpdateBuffer(
                commands, buffers.cluster_draws.handle.get(), (clusters.first + done) * sizeof(rows[0]),
                std::min(kMaxRows, rows.size() - done) * sizeof(rows[0]), &rows[done]);
    }
    barrier(device_, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, kShaders,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
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
