// Streams the geometry of a scene: brings pages into the pool, says so in the tables, and reads what frames ask for.
// See runtime/gpu/README.md, "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/pool_layout.h"
#include "runtime/gpu/vulkan/memory.h"
#include "runtime/pack/page_stream.h"

#include <memory>
#include <vector>

namespace hearth::gpu
{

struct SceneBuffers;

struct StreamOptions
{
    /// Writes to memory of the scene: all reads have ended, or never will, before the scene is destroyed.
    pack::PageReader read;

    /// Reads that run at once, >= 1. Twice as many slots of staging memory are made, which the budget does not count.
    uint32_t max_loads = 32;

    /// Frames that may be recorded while an earlier one still runs, >= 1: buffers of a word a page for what they ask for.
    /// Frames beyond that are not listened to.
    uint32_t frames_in_flight = 3;
};

/// Belongs to a scene and one queue. For each frame: beginFrame, then Renderer::record, which calls the rest. Not
/// thread-safe; only the reader may finish on other threads.
class SceneStream
{
public:
    /// pack   outlives the stream
    /// graph  of the pack
    /// pool   from placePinnedPages
    /// errors: streaming_budget, device_failed.
    static Result<std::unique_ptr<SceneStream>> create(const Device& device, const formats::PackView& pack,
                                                       const pack::PageGraph& graph, const PoolLayout& pool,
                                                       const StreamOptions& options);

    /// Begin frame `serial`: takes what has been read, listens to frames that have completed, starts reads. The frame must
    /// then be recorded and submitted before the next begins.
    /// serial            greater than that of the frame before, >= 1
    /// completed_serial  no frame up to this one runs any more; < serial, and never decreases
    void beginFrame(uint64_t serial, uint64_t completed_serial);

    /// The view as it will be drawn: its threshold times the error scale.
    shared::FrameView scaled(const shared::FrameView& view) const;

    /// Groups that come or go with the frame that the last beginFrame began, each once.
    std::span<const pack::ResidentGroups::Change> changedGroups() const { return changes_.groups; }

    /// Pages that could not be read, found out by the last beginFrame, each once. What they would refine stays as it is.
    std::span<const uint32_t> failed() const { return changes_.failed; }
    /// Failed pages may be tried again.
    void retryFailed() { pages_.retryFailed(); }

    /// The last frame that drew all that it wanted and could get. To prefetch a view, record frames of it
    /// (Renderer::recordPrefetch) until this reaches the serial of the first of them.
    uint64_t settledSerial() const { return pages_.settledSerial(); }

    const pack::StreamStatistics& statistics() const { return pages_.statistics(); }
    const pack::PageStream& pages() const { return pages_; }
    VkDeviceSize allocatedBytes() const { return memory_.arena.allocatedBytes(); }

    /// Copies of pages into the pool and changes of the tables; clears the requests. Between barriers of the caller: after
    /// all that reads them, before what shall see the new ones.
    void recordChanges(VkCommandBuffer commands, const SceneBuffers& buffers);

    /// Copies the requests, visible to transfers, to where a later beginFrame reads them.
    void recordFeedback(VkCommandBuffer commands, const SceneBuffers& buffers);

private:
    struct Feedback
    {
        Buffer requests;     ///< a word a page
        uint64_t serial = 0; ///< of the frame that writes it; 0: read, or none
    };

    /// What reads and the device share.
    struct Memory
    {
        MemoryArena arena;
        Buffer staging;
        std::vector<Feedback> feedback;
    };

    SceneStream(const Device& device, const formats::PackView& pack, const PoolLayout& pool, Memory memory,
                pack::PageStream pages)
        : device_(device),
          pack_(pack),
          slot_addresses_(pool.slot_addresses),
          slot_bytes_(pool.slot_bytes),
          memory_(std::move(memory)),
          pages_(std::move(pages))
    {
    }
    static Result<Memory> createMemory(const Device& device, const formats::PackView& pack,
                                       const PoolLayout& pool, const StreamOptions& options);
    void listen(uint64_t completed_serial);
    void takeRequests(const Feedback& feedback);
    void recordUpload(VkCommandBuffer commands, const SceneBuffers& buffers,
                      const pack::PageUpload& upload) const;
    void recordDraws(VkCommandBuffer commands, const SceneBuffers& buffers, uint32_t page,
                     uint32_t page_address) const;

    const Device& device_;
    const formats::PackView& pack_;
    std::vector<uint32_t> slot_addresses_;
    uint32_t slot_bytes_;
    Memory memory_;
    pack::PageStream pages_;
    pack::StreamChanges changes_{};
    uint64_t serial_ = 0;
    bool recorded_ = true; ///< frame serial_
};

} // namespace hearth::gpu
