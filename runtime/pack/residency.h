// Which pages are in memory, which are loaded next and which make room: decisions only, no reading, no threads, no
// clock. See README.md, "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/error_scale.h"
#include "runtime/pack/eviction_queue.h"
#include "runtime/pack/page_graph.h"

#include <bit>
#include <span>
#include <vector>

namespace hearth::pack
{

struct ResidencyOptions
{
    /// Decoded bytes that pages may take together: resident, being loaded, and evicted but still read by a frame.
    uint64_t budget_bytes = 0;

    /// Loads that run at once, >= 1. 32 pages of at most 64 KiB a frame are 120 MiB a second at 60 frames a second, which
    /// storage of phones reads.
    uint32_t max_loads = 32;

    /// A page makes room only for one whose priority is more than this times its own, >= 1. Above 1, two pages cannot
    /// take turns when priorities waver.
    float hysteresis = 2;
};

/// What changes as a frame begins. The lists hold until the next call of beginFrame.
struct FrameChanges
{
    /// No longer resident, what needs a page before it: to be applied first, in this order.
    std::span<const uint32_t> evicted;
    /// Resident from now on, what a page needs before it: to be applied next, in this order.
    std::span<const uint32_t> published;
    /// Evicted earlier; no frame reads them any more, so that their memory is free.
    std::span<const uint32_t> released;
    /// Loaded for nothing, since something that they need has failed; their memory is free.
    std::span<const uint32_t> discarded;
    /// Loads that failed since the last frame. Each failure is told once.
    std::span<const uint32_t> failed;
};

/// The resident set is closed at any time (see PageGraph), and stays so after each step of FrameChanges; the pinned
/// pages are in it; the bytes never exceed the budget. Equal calls give equal answers. A frame costs
/// O((requests + what they need + loads) log pages), whatever the number of pages, and allocates nothing once each list
/// has been at its longest.
///
/// The caller loads the pinned pages before the first frame. Then, for each frame:
///     beginFrame                        apply the changes
///     request, request, ...             from the feedback of the cull pass, of this frame or an earlier one
///     schedule                          start the loads
///     draw, with the threshold times errorScale()
/// and completed(page, ok) at any time between the calls. Not thread-safe: loads that end on other threads queue up.
class Residency
{
public:
    /// errors: streaming_budget, with the bytes that are needed, where the budget does not hold the pinned pages.
    /// The other options are asserted.
    static Result<Residency> create(PageGraph graph, const ResidencyOptions& options);

    /// serial            of the frame; greater than that of the frame before, >= 1
    /// completed_serial  no frame up to this one reads memory any more; < serial, and never decreases
    FrameChanges beginFrame(uint64_t serial, uint64_t completed_serial);

    /// Some instance wants to draw what is in a page, resident or not: `priority` is the projected error of what is drawn
    /// without it, over the threshold; > 1 means that it is drawn once it is resident, less that it may be soon. What it
    /// needs is requested with it. Of several requests before schedule, the largest counts. priority >= 0.
    void request(uint32_t page, float priority);

    /// The pages to start loading now, which hold until the next call: greatest priority first, then by number; each
    /// behind what it needs, unless that is resident or being loaded. Starts a page only where it fits; where evictions
    /// make room, it starts once their memory is released. The first page that does not fit ends the round.
    /// Calls for frames without feedback are left out: each call stands for all requests since the one before.
    std::span<const uint32_t> schedule();

    /// A load has ended, in any order; if ok, the page's content is where frames will read it.
    /// page  was returned by schedule and has not ended yet (asserted)
    void completed(uint32_t page, bool ok);

    /// Failed pages may be tried again, once they are requested.
    void retryFailed();

    /// Factor for the caller's threshold, >= 1: above 1 while more is wanted than the budget holds.
    float errorScale() const { return error_scale_.value(); }

    /// As of the last beginFrame.
    bool isResident(uint32_t page) const
    {
        return pages_[page].state == State::resident || pages_[page].state == State::leaving;
    }

    /// Nothing is under way: no load, no page that waits for what it needs, no eviction.
    bool atRest() const
    {
        return loads_in_flight_ == 0 && loaded_.empty() && leaving_.empty() && held_.empty();
    }

    /// What counts against the budget now.
    uint64_t bytesInUse() const { return bytes_in_use_; }
    const PageGraph& graph() const { return graph_; }

private:
    enum class State : uint8_t
    {
        absent,
        loading,
        loaded, ///< to be published once all that it needs is
        resident,
        leaving, ///< resident until the next frame begins
        held,    ///< evicted; frames that still run read it
        failed,
    };

    struct Page
    {
        State state = State::absent;
        bool blocked = false;         ///< in this round: it or something that it needs has failed
        float requested = 0;          ///< the greatest priority of this round's requests; 0: none
        float priority = 0;           ///< in the last round that wanted it
        uint32_t dependent_count = 0; ///< pages that are loading, loaded or resident and need it
        uint64_t round = 0;           ///< the last that wanted it; 0: none
    };

    struct Held
    {
        uint32_t page;
        uint64_t last_serial; ///< the last frame that reads it
    };

    /// Orders by falling priority, then by page: bits of positive floats order as their values do.
    struct Request
    {
        uint64_t key;

        static Request of(uint32_t page, float priority)
        {
            return {uint64_t{~std::bit_cast<uint32_t>(priority)} << 32 | page};
        }
        uint32_t page() const { return static_cast<uint32_t>(key); }
        float priority() const { return std::bit_cast<float>(~static_cast<uint32_t>(key >> 32)); }
        friend bool operator<(Request a, Request b) { return a.key < b.key; }
    };

    Residency(PageGraph graph, const ResidencyOptions& options);

    void retireLeaving();
    void releaseHeld(uint64_t completed_serial);
    void publishLoaded();

    void orderRequests();
    void collectWanted();
    void want(uint32_t page, float priority);
    void measureDemand();
    void startLoads();

    bool needsAre(uint32_t page, auto... states) const;
    bool canStart(uint32_t page) const;
    void start(uint32_t page);
    uint64_t makeRoom(uint32_t page, uint64_t bytes);
    void leave(uint32_t page);
    void stay(uint32_t page);
    void dropLoad(uint32_t page, State state);

    void claimNeeded(uint32_t page);
    void unclaimNeeded(uint32_t page);
    void offerForEviction(uint32_t page);
    static uint64_t worthOf(float priority, uint64_t round);

    PageGraph graph_;
    ResidencyOptions options_;
    std::vector<Page> pages_;
    EvictionQueue evictable_; ///< resident, not pinned, no dependents
    ErrorScale error_scale_;
    uint64_t serial_ = 0;
    uint64_t completed_serial_ = 0;
    uint64_t round_ = 1; ///< of requests; ends with schedule
    uint64_t bytes_in_use_ = 0;
    uint64_t bytes_going_ = 0; ///< of these, leaving or held
    uint32_t loads_in_flight_ = 0;

    std::vector<uint32_t> requested_; ///< in this round, each once
    std::vector<Request> requests_;   ///< of the last schedule, with those of companions
    std::vector<uint32_t> wanted_; ///< by the last schedule: what is requested, and what that needs, in order
    std::vector<uint32_t> started_; ///< by the last schedule
    std::vector<uint32_t> leaving_; ///< in the order of eviction
    std::vector<uint32_t> loaded_;
    std::vector<Held> held_; ///< by last_serial
    std::vector<uint32_t> failed_;
    std::vector<uint32_t> new_failures_; ///< not told yet

    // what FrameChanges refers to
    std::vector<uint32_t> evicted_, published_, released_, discarded_, told_failures_;
};

} // namespace hearth::pack
