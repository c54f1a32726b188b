// Page streaming without a graphics device: connects the policy (residency.h) with reads, slots of the
// geometry pool, and the staging memory between them. See runtime/pack/README.md, "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/completion_queue.h"
#include "runtime/pack/page_slots.h"
#include "runtime/pack/residency.h"
#include "runtime/pack/resident_groups.h"
#include "runtime/pack/staging_slots.h"

#include <functional>
#include <memory>

namespace hearth::pack
{

/// Callback for the end of a read: call it once, from any thread. The destination is not written afterwards.
class ReadDone
{
public:
    ReadDone(CompletionQueue& queue, uint32_t page) : queue_(&queue), page_(page) {}

    /// ok  true if the destination holds the decoded page
    void operator()(bool ok) const { queue_->push({page_, ok}); }

private:
    CompletionQueue* queue_;
    uint32_t page_;
};

/// Function that starts to read a page: it decodes the page into `destination`, whose size is the page's
/// (PackView::decodePage does), then calls `done`. It may do so at once or later, on any thread, for several
/// pages in any order. All reads must have ended, or never call `done`, before the stream is destroyed.
/// Called from beginFrame and schedule.
using PageReader = std::function<void(uint32_t page, std::span<std::byte> destination, ReadDone done)>;

struct PageStreamOptions
{
    ResidencyOptions residency;
    /// slots of the pool; the budget covers the pinned pages plus at most these slots
    uint32_t slot_count = 0;
    /// Parts of the pool beside those slots, closed at first, and the most slots of each (PageSlots).
    uint32_t movable_parts = 0, part_slots = 0;
    uint32_t slot_bytes = 0; ///< slot size of the graph (PageGraph::withSlotSize)
    PageReader read;
};

/// Copy of a decoded page from its staging slot to its pool slot.
struct PageUpload
{
    uint32_t page = 0;
    uint32_t slot = 0;
    uint32_t staging_slot = 0;
};

/// Copy of a page from a slot of a part that is to be closed to another slot. Frames before this one read the
/// old slot.
struct PageMove
{
    uint32_t page = 0;
    uint32_t from_slot = 0;
    uint32_t slot = 0;
};

/// Changes to apply at the start of a frame, before culling; valid until the next beginFrame.
struct StreamChanges
{
    std::span<const PageUpload> uploads;
    std::span<const PageMove> moves;                ///< after the uploads
    std::span<const ResidentGroups::Change> groups; ///< each group once
    std::span<const uint32_t> failed;               ///< pages that cannot be read, once for each attempt
};

struct StreamStatistics
{
    uint64_t budget_bytes = 0;   ///< of pages; while parts are being closed, at least bytes_in_use
    uint64_t bytes_in_use = 0;   ///< budget in use: pinned pages, and slots that are not free
    uint64_t bytes_resident = 0; ///< decoded bytes of the resident pages
    uint64_t bytes_streamed = 0; ///< decoded bytes of all pages read so far
    uint32_t pages_resident = 0;
    uint32_t failures = 0; ///< number so far
    float error_scale = 1;
};

/// Page stream, called frame by frame from one thread; only `ReadDone` may be called from other threads.
/// Deterministic: equal reads that end in the same frames give equal results. Starts no thread, and allocates
/// nothing once each list has reached its maximum length.
///
///     beginFrame                 copy decoded pages, change the tables
///     request, request, ...      from feedback of an earlier frame
///     schedule                   start reads
class PageStream
{
public:
    /// Create a stream.
    /// view     of a checked pack that outlives the stream
    /// graph    of the view, in slots
    /// staging  destination of decoded pages; a multiple of slot_bytes, at least one slot
    /// errors: streaming_budget.
    static Result<PageStream> create(const formats::PackView& view, PageGraph graph,
                                     const PageStreamOptions& options, std::span<std::byte> staging);

    /// Begin a frame, as Residency::beginFrame does. All changes are recorded into frame `serial`, whose
    /// copies read the staging memory until it has completed.
    StreamChanges beginFrame(uint64_t serial, uint64_t completed_serial);

    /// Request a page, as Residency::request does.
    void request(uint32_t page, float priority);

    /// End a round of requests, which come from frame `feedback_serial`, and start reads. Skipped while no
    /// frame that made requests has completed.
    void schedule(uint64_t feedback_serial);

    /// Return the serial of the last frame that drew all pages that it wanted and could get: no read or
    /// change was pending, and the error scale was constant. 0: none yet. A view that was first drawn in
    /// frame n has converged once this is >= n.
    uint64_t settledSerial() const { return settled_serial_; }

    /// Return the number of reads that have started and whose end no frame has seen yet.
    uint32_t readsInFlight() const { return reads_in_flight_; }

    void retryFailed() { residency_.retryFailed(); }

    /// Open a part of the pool, which is closed and free: its slots take pages from now on.
    void openPart(uint32_t part, uint32_t slots);

    /// Close a part: pages are evicted until the others hold the rest, which then moves to them. No page is
    /// lost that these have room for.
    void closePart(uint32_t part);

    /// Return true if neither the frame that was begun nor a later one uses a part that has been closed.
    bool isPartFree(uint32_t part) const
    {
        return slots_.usedSlots(part) == 0 && leaving_serial_ < serial_ && !slots_.isOpen(part);
    }

    /// Fit the error scale to so many slots, however many there are for the moment.
    void setDemandSlots(uint32_t slots);

    const Residency& residency() const { return residency_; }
    /// Return the groups that are resident as of the last beginFrame.
    const ResidentGroups& groups() const { return groups_; }
    uint32_t pageSlot(uint32_t page) const { return slot_of_page_[page]; } ///< kInvalidIndex: none
    const StreamStatistics& statistics() const { return statistics_; }

private:
    PageStream(const formats::PackView& view, Residency residency, const PageStreamOptions& options,
               std::span<std::byte> staging);
    void takeCompletions(uint64_t serial);
    void freeSlot(uint32_t page);
    void movePages();
    void updateBudget();
    void startReads();
    void updateStatistics();

    const formats::PackView* view_;
    PageStreamOptions options_;
    std::span<std::byte> staging_;
    Residency residency_;
    ResidentGroups groups_;
    std::unique_ptr<CompletionQueue> queue_; // readers keep its address

    std::vector<uint32_t> slot_of_page_, staging_of_page_; ///< kInvalidIndex: none
    PageSlots slots_;
    std::vector<uint32_t> closing_parts_;
    std::vector<PageMove> moves_;
    uint32_t demand_slots_;
    uint64_t leaving_serial_ = 0; ///< last frame with a copy from or to a part that is being closed
    StagingSlots staging_slots_;
    std::vector<uint32_t> pending_reads_; ///< pages to read as soon as staging memory is free, in order
    std::vector<PageUpload> uploads_;
    uint32_t reads_in_flight_ = 0;
    uint64_t serial_ = 0;
    uint64_t changed_serial_ = 0; ///< last frame with a change
    uint64_t settled_serial_ = 0;
    StreamStatistics statistics_;
};

} // namespace hearth::pack
