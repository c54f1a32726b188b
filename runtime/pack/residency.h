// Streaming policy: decides which pages are resident, which are loaded next and which are evicted. No
// reading, no threads, no clock. See runtime/pack/README.md, "Streaming".
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
    /// Budget for decoded bytes of all pages: resident, being loaded, and evicted but still read by a frame.
    uint64_t budget_bytes = 0;

    /// Maximum of concurrent loads, >= 1. 32 pages of at most 64 KiB a frame are 120 MiB a second at 60
    /// frames a second, which phone storage can read.
    uint32_t max_loads = 32;

    /// A page is evicted only for a page whose priority is more than this factor times its own, >= 1. Above
    /// 1, two pages cannot evict each other in turn when priorities fluctuate.
    float hysteresis = 2;
};

/// Changes at the start of a frame. The lists are valid until the next call of beginFrame.
struct FrameChanges
{
    /// No longer resident; a page comes before the pages that it needs. Apply first, in this order.
    std::span<const uint32_t> evicted;
    /// Resident from now on; a page comes after the pages that it needs. Apply next, in this order.
    std::span<const uint32_t> published;
    /// Evicted earlier and not read by any frame any more: their memory is free.
    std::span<const uint32_t> released;
    /// Loaded and dropped, since a page that they need has failed; their memory is free.
    std::span<const uint32_t> discarded;
    /// Loads that failed since the last frame. Each failure is reported once.
    std::span<const uint32_t> failed;
};

/// Streaming policy. Invariants: the resident set is closed (see PageGraph), also after each step of
/// FrameChanges; it includes the pinned pages; the bytes never exceed the budget, unless it was just made
/// smaller, and then they only fall. Deterministic: equal calls
/// give equal results. A frame takes O((requests + the pages that they need + loads) log pages), whatever the
/// number of pages, and allocates nothing once each list has reached its maximum length.
///
/// The caller loads the pinned pages before the first frame. Then, for each frame:
///     beginFrame                        apply the changes
///     request, request, ...             from the feedback of the cull pass, of this frame or an earlier one
///     schedule                          start the loads
///     draw, with the threshold times errorScale()
/// and completed(page, ok) at any time between the calls. Not thread-safe: loads that end on other threads
/// must be queued.
class Residency
{
public:
    /// Create the policy. The options other than the budget are asserted.
    /// errors: streaming_budget, with the required bytes, if the budget does not hold the pinned pages.
    static Result<Residency> create(PageGraph graph, const ResidencyOptions& options);

    /// Begin a frame.
    /// serial            of the frame; greater than the serial of the frame before, >= 1
    /// completed_serial  frames up to this one no longer read memory; < serial, never decreases
    FrameChanges beginFrame(uint64_t serial, uint64_t completed_serial);

    /// Request a page that an instance wants to draw, resident or not, together with the pages that it needs.
    /// Of several requests before schedule, the largest counts.
    /// priority  projected error of the coarser clusters drawn without the page, over the threshold; >= 0.
    ///           Above 1 the page is drawn once it is resident, below it may be soon
    void request(uint32_t page, float priority);

    /// Return the pages to start loading now, valid until the next call: greatest priority first, then by
    /// index; each after the pages that it needs, unless these are resident or being loaded. A page starts
    /// only where it fits; where evictions make room, it starts once their memory is released. The first page
    /// that does not fit ends the round. Calls for frames without feedback are skipped: each call covers all
    /// requests since the call before.
    std::span<const uint32_t> schedule();

    /// Report the end of a load; loads may end in any order. If ok, the page's content is where frames will
    /// read it.
    /// page  was returned by schedule and has not ended yet (asserted)
    void completed(uint32_t page, bool ok);

    /// Change the budget. Bytes beyond a smaller one are evicted from the next schedule on, least
    /// worth first, whether or not they are wanted; until they are released, nothing is loaded.
    /// bytes         at least those of the pinned pages (asserted)
    /// demand_bytes  budget that errorScale() fits the wanted pages to: another than `bytes` where that one
    ///               holds for a few frames only
    void setBudget(uint64_t bytes, uint64_t demand_bytes);

    /// Allow failed pages to be loaded again, once they are requested.
    void retryFailed();

    /// Return the factor for the caller's threshold, >= 1: above 1 while the wanted pages exceed the budget.
    float errorScale() const { return error_scale_.value(); }

    /// Return the bytes of the pages that the last schedule wanted to be drawn and that can be loaded,
    /// without the pinned ones: what errorScale() fits to the budget.
    uint64_t wantedBytes() const { return wanted_bytes_; }

    /// True if the page is resident as of the last beginFrame.
    bool isResident(uint32_t page) const
    {
        return pages_[page].state == State::resident || pages_[page].state == State::evicting;
    }

    /// True if the page could not be loaded, and retryFailed was not called since.
    bool isFailed(uint32_t page) const { return pages_[page].state == State::failed; }

    /// True if nothing is pending: no load, no page that waits for its dependencies, no eviction.
    bool atRest() const
    {
        return loads_in_flight_ == 0 && loaded_.empty() && evicting_.empty() && retiring_.empty();
    }

    /// Return the bytes that count against the budget now.
    uint64_t bytesInUse() const { return bytes_in_use_; }
    uint64_t budgetBytes() const { return options_.budget_bytes; }
    const PageGraph& graph() const { return graph_; }

private:
    enum class State : uint8_t
    {
        absent,
        loading,
        loaded, ///< published once all pages that it needs are
        resident,
        evicting, ///< evicted when the next frame begins, resident until then
        retiring, ///< evicted, but frames in flight read it
        failed,
    };

    struct Page
    {
        State state = State::absent;
        bool blocked = false;         ///< in this round: it or a page that it needs has failed
        float requested = 0;          ///< greatest priority of this round's requests; 0: none
        float priority = 0;           ///< priority in the last round that wanted it
        uint32_t dependent_count = 0; ///< number of pages that are loading, loaded or resident and need it
        uint64_t round = 0;           ///< last round that wanted it; 0: none
    };

    struct RetiringPage
    {
        uint32_t page;
        uint64_t last_serial; ///< last frame that reads it
    };

    /// Request with a sort key that orders by falling priority, then by page: bits of positive floats order
    /// as their values do.
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

    void reserveLists();
    void applyEvictions();
    void releaseRetired(uint64_t completed_serial);
    void publishLoaded();

    void orderRequests();
    void collectWanted();
    void addWanted(uint32_t page, float priority);
    void measureDemand();
    void evictExcess();
    void startLoads();

    bool allNeedsIn(uint32_t page, auto... states) const;
    bool canStart(uint32_t page) const;
    void start(uint32_t page);
    uint64_t makeRoom(uint32_t page, uint64_t bytes);
    void evict(uint32_t page);
    void undoEviction(uint32_t page);
    void dropLoad(uint32_t page, State state);

    void claimNeeded(uint32_t page);
    void unclaimNeeded(uint32_t page);
    void offerForEviction(uint32_t page);
    static uint64_t evictionKey(float priority, uint64_t round);

    PageGraph graph_;
    ResidencyOptions options_;
    std::vector<Page> pages_;
    EvictionQueue evictable_; ///< resident, not pinned, no dependents
    ErrorScale error_scale_;
    uint64_t demand_bytes_; ///< budget of the error scale
    uint64_t wanted_bytes_ = 0;
    uint64_t serial_ = 0;
    uint64_t completed_serial_ = 0;
    uint64_t round_ = 1; ///< round of requests; ends with schedule
    uint64_t bytes_in_use_ = 0;
    uint64_t evicting_bytes_ = 0; ///< bytes in use by pages that are evicting or retiring
    uint32_t loads_in_flight_ = 0;

    std::vector<uint32_t> requested_; ///< pages requested in this round, each once
    std::vector<Request> requests_;   ///< requests of the last schedule, with companions
    /// wanted by the last schedule: requested pages and the pages that they need, in order
    std::vector<uint32_t> wanted_;
    std::vector<uint32_t> started_;  ///< started by the last schedule
    std::vector<uint32_t> evicting_; ///< in order of eviction
    std::vector<uint32_t> loaded_;
    std::vector<RetiringPage> retiring_; ///< ordered by last_serial
    std::vector<uint32_t> failed_;
    std::vector<uint32_t> new_failures_; ///< not reported yet

    // storage of the lists of FrameChanges
    std::vector<uint32_t> evicted_, published_, released_, discarded_, reported_failures_;
};

} // namespace hearth::pack
