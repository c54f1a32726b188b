// Streaming without a graphics device: ties the policy (residency.h) to reads, to slots of the geometry pool and to the
// staging memory between them. See README.md, "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/completion_queue.h"
#include "runtime/pack/residency.h"
#include "runtime/pack/resident_groups.h"

#include <functional>
#include <memory>

namespace hearth::pack
{

/// To be called once when a read has ended, from any thread; the destination is not touched afterwards.
class ReadDone
{
public:
    ReadDone(CompletionQueue& queue, uint32_t page) : queue_(&queue), page_(page) {}

    /// ok  the destination holds the decoded page
    void operator()(bool ok) const { queue_->push({page_, ok}); }

private:
    CompletionQueue* queue_;
    uint32_t page_;
};

/// Starts to read a page: decoded into `destination`, whose size is the page's (PackView::decodePage does), then `done`. May
/// do so at once or later, on any thread, reads in any order; all have ended, or never will, before the stream does. Called
/// from beginFrame and schedule.
using PageReader = std::function<void(uint32_t page, std::span<std::byte> destination, ReadDone done)>;

struct PageStreamOptions
{
    ResidencyOptions residency;
    uint32_t slot_count = 0; ///< of the pool; the budget holds the pinned pages and no more than these
    uint32_t slot_bytes = 0; ///< as the graph was made with (PageGraph::inSlots)
    PageReader read;
};

/// A page that has been read: copy it from its place in the staging memory to its slot.
struct PageUpload
{
    uint32_t page = 0;
    uint32_t slot = 0;
    uint32_t staging_slot = 0;
};

/// What a frame does before it culls; holds until the next beginFrame.
struct StreamChanges
{
    std::span<const PageUpload> uploads;
    std::span<const ResidentGroups::Change> groups; ///< each once
    std::span<const uint32_t> failed;               ///< pages that cannot be read, each once per try
};

struct StreamStatistics
{
    uint64_t budget_bytes = 0;
    uint64_t bytes_in_use = 0;   ///< of the budget: pinned pages, and slots that are not free
    uint64_t bytes_resident = 0; ///< decoded bytes of the resident pages
    uint64_t bytes_streamed = 0; ///< decoded bytes of all pages read so far
    uint32_t pages_resident = 0;
    uint32_t failures = 0; ///< so far
    float error_scale = 1;
};

/// Driven frame by frame from one thread; only `ReadDone` may be called from others. Equal reads that end in equal frames
/// give equal answers. Starts no thread, and allocates nothing once each list has been at its longest.
///
///     beginFrame                 copy what has been read, change the tables
///     request, request, ...      from feedback of an earlier frame
///     schedule                   starts reads
class PageStream
{
public:
    /// view     of a checked pack, outlives the stream
    /// graph    of the view, in slots
    /// staging  a multiple of slot_bytes, at least one slot; decoded pages are written there
    /// errors: streaming_budget.
    static Result<PageStream> create(const formats::PackView& view, PageGraph graph,
                                     const PageStreamOptions& options, std::span<std::byte> staging);

    /// As Residency::beginFrame. All changes are recorded into frame `serial`, whose copies read the staging memory until
    /// it has completed.
    StreamChanges beginFrame(uint64_t serial, uint64_t completed_serial);

    /// As Residency::request.
    void request(uint32_t page, float priority);

    /// Ends a round of requests, which frame `feedback_serial` made, and starts reads. Left out where no frame has
    /// completed that made requests.
    void schedule(uint64_t feedback_serial);

    /// The last frame that drew all that it wanted and could get: nothing was under way, nothing had to come or go, and
    /// the error scale stayed. 0: none yet. A view that was first drawn in frame n has converged once this is >= n.
    uint64_t settledSerial() const { return settled_serial_; }

    /// Reads that have started and whose end no frame has seen yet.
    uint32_t readsInFlight() const { return reads_in_flight_; }

    void retryFailed() { residency_.retryFailed(); }

    const Residency& residency() const { return residency_; }
    uint32_t slotOf(uint32_t page) const { return slot_of_page_[page]; } ///< kNone: none
    const StreamStatistics& statistics() const { return statistics_; }

private:
    struct Copying
    {
        uint32_t staging_slot = 0;
        uint64_t serial = 0;
    };

    PageStream(const formats::PackView& view, Residency residency, const PageStreamOptions& options,
               std::span<std::byte> staging);
    void freeStaging(uint64_t completed_serial);
    void takeCompletions(uint64_t serial);
    void freeSlot(uint32_t page);
    void startReads();
    void updateStatistics();

    const formats::PackView* view_;
    PageStreamOptions options_;
    std::span<std::byte> staging_;
    Residency residency_;
    ResidentGroups groups_;
    std::unique_ptr<CompletionQueue> queue_; // readers know its address

    std::vector<uint32_t> slot_of_page_, staging_of_page_; ///< kNone: none
    std::vector<uint32_t> free_slots_, free_staging_;
    std::vector<Copying> copying_;  ///< by serial
    std::vector<uint32_t> waiting_; ///< pages to be read once staging memory is free, in order
    std::vector<PageUpload> uploads_;
    uint32_t reads_in_flight_ = 0;
    uint64_t serial_ = 0;
    uint64_t changed_serial_ = 0; ///< the last frame in which anything changed
    uint64_t settled_serial_ = 0;
    StreamStatistics statistics_;
};

} // namespace hearth::pack
