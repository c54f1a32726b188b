// Geometry streaming of a scene: brings pages into the pool, updates the tables, and reads back the page
// requests of frames. See runtime/gpu/README.md, "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/pool_layout.h"
#include "runtime/gpu/vulkan/memory.h"
#include "runtime/gpu/vulkan/word_copies.h"
#include "runtime/pack/memory_exchange.h"
#include "runtime/pack/page_stream.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace hearth::gpu
{

class PoolBuffers;
class StreamedTextures;
struct SceneBuffers;
struct SceneFrame;

struct StreamOptions
{
    /// Writes to memory of the scene: before the scene is destroyed all reads must have ended or been
    /// cancelled.
    pack::PageReader read;

    /// Reads in flight, >= 1. Twice as many slots of staging memory are allocated, outside of the budget.
    uint32_t max_loads = 32;
};

/// Stream of one scene on one queue. For each frame: beginFrame, then Renderer::record, which calls the rest.
/// Not thread-safe; only the reader may finish on other threads.
class SceneStream
{
public:
    /// pack   outlives the stream
    /// graph  page graph of the pack
    /// pool   from placePinnedPages, or with an exchange placeExchange
    /// errors: streaming_budget, device_failed.
    static Result<std::unique_ptr<SceneStream>> create(const Device& device, const formats::PackView& pack,
                                                       const pack::PageGraph& graph, const PoolLayout& pool,
                                                       const std::optional<pack::ExchangeLayout>& exchange,
                                                       const StreamOptions& options);

    /// Set the frames of the scene, whose requests are read once they have completed, and the buffers of its
    /// pool, which come and go with an exchange.
    void setFrames(std::span<const SceneFrame> frames, PoolBuffers& pool);

    /// Stream textures as well: they outlive the stream.
    void setTextures(StreamedTextures& textures) { textures_ = &textures; }

    /// Begin frame `serial`: takes the pages that were read, handles the requests of completed frames, starts
    /// reads. The frame must then be recorded and submitted before the next begins.
    /// serial            greater than the serial of the last frame, >= 1
    /// completed_serial  all frames up to this one have completed; < serial, never decreases
    void beginFrame(uint64_t serial, uint64_t completed_serial);

    /// Take back that the frame that was begun has been recorded: it will be recorded again.
    void cancelRecording()
    {
        recorded_ = false;
        markPoolChanged();
    }

    /// Return the view to draw: its threshold is multiplied by the error scale.
    shared::FrameView scaled(const shared::FrameView& view) const;

    /// Groups that the last beginFrame made resident or evicted, each once.
    std::span<const pack::ResidentGroups::Change> changedGroups() const { return changes_.groups; }

    /// Pages whose read failed, found by the last beginFrame, each once. The clusters that they would refine
    /// stay coarse.
    std::span<const uint32_t> failed() const { return changes_.failed; }
    /// Allow failed pages to be read again.
    void retryFailed();

    /// Serial of the last frame that drew everything it needed and could get. To prefetch a view, record
    /// frames of it (Renderer::recordPrefetch) until this reaches the serial of the first of them.
    uint64_t settledSerial() const;

    const pack::StreamStatistics& statistics() const { return pages_.statistics(); }
    const pack::PageStream& pages() const { return pages_; }
    /// Return the bytes of staging memory, and of streamed textures.
    VkDeviceSize allocatedBytes() const;

    StreamedTextures* textures() const { return textures_; } ///< null: none are streamed

    /// Return whether the sets of a frame in flight name buffers of the pool that have changed. Once it is
    /// asked, they are taken to be rebound.
    bool takePoolChange(uint32_t number);

    /// Record the copies of pages that leave a part of the pool, after the copies of takeChanges.
    void recordMoves(VkCommandBuffer commands, const SceneBuffers& buffers) const;

    /// Null if the shares of geometry and textures are fixed.
    const pack::MemoryExchange* exchange() const { return exchange_ ? &*exchange_ : nullptr; }

    /// Decoded pages on their way into the pool.
    const Buffer& staging() const { return memory_.staging; }

    /// Largest number of regions of a frame's changes.
    uint32_t maxCopyRegions() const;

    /// Copies of a frame: into each slice of the pool from staging(), and into the groups.
    using Copies = std::array<CopyRange, shared::kPoolSlices + 1>;

    /// Take the changes of the frame that was begun: writes the rows of the pages' clusters, lists the
    /// copies, and clears the frame's requests.
    /// number  of the frame, of those of setFrames
    Copies takeChanges(const SceneBuffers& buffers, uint32_t number, WordCopies& copies);

private:
    /// Page requests of a frame of the scene.
    struct RequestReadback
    {
        const Buffer* requests; ///< mapped, one word per page
        uint64_t serial = 0;    ///< of the frame that writes it; 0: read, or none
    };

    /// Memory shared by reads and the device.
    struct Memory
    {
        MemoryArena arena;
        Buffer staging;
    };

    SceneStream(const Device& device, const formats::PackView& pack, const PoolLayout& pool, Memory memory,
                pack::PageStream pages)
        : device_(device),
          pack_(pack),
          slot_addresses_(pool.slot_addresses),
          slot_bytes_(pool.slot_bytes),
          first_movable_slice_(pool.first_movable_slice),
          memory_(std::move(memory)),
          pages_(std::move(pages))
    {
    }
    static Result<Memory> createMemory(const Device& device, const PoolLayout& pool,
                                       const StreamOptions& options);
    void readRequests(uint64_t completed_serial);
    void takeRequests(const RequestReadback& feedback);
    void balanceMemory(uint64_t feedback_serial);
    void moveMemory(uint64_t completed_serial);
    void closeParts(uint64_t completed_serial);
    void openParts();
    void fitBudgets();
    void markPoolChanged() { outdated_pools_.assign(outdated_pools_.size(), true); }
    CopyRange listUploads(uint32_t slice, WordCopies& copies) const;
    void writeDraws(const SceneBuffers& buffers, const pack::PageUpload& upload) const;

    const Device& device_;
    const formats::PackView& pack_;
    std::vector<uint32_t> slot_addresses_;
    uint32_t slot_bytes_;
    uint32_t first_movable_slice_; ///< of the exchange's parts
    Memory memory_;
    std::vector<RequestReadback> feedback_;
    pack::PageStream pages_;
    StreamedTextures* textures_ = nullptr;
    std::optional<pack::MemoryExchange> exchange_;
    PoolBuffers* pool_ = nullptr;
    std::vector<bool> outdated_pools_;        ///< [frame in flight] its sets name old buffers
    uint64_t balanced_serial_ = 0;            ///< last frame whose requests led to no move
    std::vector<uint32_t> material_requests_; ///< of the round: for each row, the greatest
    pack::StreamChanges changes_{};
    uint64_t serial_ = 0;
    bool recorded_ = true; ///< frame serial_ has been recorded
};

} // namespace hearth::gpu
