// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/residency.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <utility>

namespace hearth::pack
{

namespace
{

// bounds between which the bits of positive floats order as their values do, and counting down the exponent
// halves them
constexpr float kMinPriority = std::numeric_limits<float>::min();
constexpr float kMaxPriority = std::numeric_limits<float>::max();
constexpr uint32_t kMantissaBits = 23;

} // namespace

Result<Residency> Residency::create(PageGraph graph, const ResidencyOptions& options)
{
    HEARTH_ASSERT(options.max_loads >= 1 && options.hysteresis >= 1);
    if (graph.pinnedBytes() > options.budget_bytes)
        return Error{Issue::streaming_budget, "", "",
                     "a budget of " + std::to_string(options.budget_bytes) + " bytes, the " +
                         std::to_string(graph.pinned().size()) + " pages that are always resident take " +
                         std::to_string(graph.pinnedBytes())};
    return Residency(std::move(graph), options);
}

Residency::Residency(PageGraph graph, const ResidencyOptions& options)
    : graph_(std::move(graph)),
      options_(options),
      pages_(graph_.pageCount()),
      evictable_(graph_.pageCount()),
      demand_bytes_(options.budget_bytes),
      bytes_in_use_(graph_.pinnedBytes())
{
    for (const uint32_t page : graph_.pinned())
    {
        pages_[page].state = State::resident;
        claimNeeded(page);
    }
    reserveLists();
}

/// Give each list room for all that it may hold, so that no frame allocates, or fails half way.
void Residency::reserveLists()
{
    const uint32_t count = graph_.pageCount();
    size_t requests = count;
    for (uint32_t page = 0; page < count; ++page)
        requests += graph_.companions(page).size();
    requests_.reserve(requests);
    retiring_.reserve(count);
    started_.reserve(options_.max_loads);
    for (std::vector<uint32_t>* list : {&requested_, &wanted_, &evicting_, &loaded_, &failed_, &new_failures_,
                                        &evicted_, &published_, &released_, &discarded_, &reported_failures_})
        list->reserve(count);
}

// --- beginning of a frame

FrameChanges Residency::beginFrame(uint64_t serial, uint64_t completed_serial)
{
    HEARTH_ASSERT(serial > serial_ && completed_serial < serial && completed_serial >= completed_serial_);
    completed_serial_ = completed_serial;
    applyEvictions();
    releaseRetired(completed_serial);
    publishLoaded();
    reported_failures_.clear();
    reported_failures_.swap(new_failures_);
    serial_ = serial;
    return {evicted_, published_, released_, discarded_, reported_failures_};
}

void Residency::applyEvictions()
{
    evicted_.clear();
    evicted_.swap(evicting_);
    for (const uint32_t page : evicted_)
    {
        pages_[page].state = State::retiring;
        retiring_.push_back({page, serial_});
    }
}

void Residency::releaseRetired(uint64_t completed_serial)
{
    released_.clear();
    const auto end =
        std::find_if(retiring_.begin(), retiring_.end(),
                     [&](const RetiringPage& retiring) { return retiring.last_serial > completed_serial; });
    for (auto retiring = retiring_.begin(); retiring != end; ++retiring)
    {
        released_.push_back(retiring->page);
        pages_[retiring->page].state = State::absent;
        bytes_in_use_ -= graph_.sizeBytes(retiring->page);
        evicting_bytes_ -= graph_.sizeBytes(retiring->page);
    }
    retiring_.erase(retiring_.begin(), end);
}

void Residency::publishLoaded()
{
    published_.clear();
    discarded_.clear();
    // the pages that a page needs come before it
    std::sort(loaded_.begin(), loaded_.end());
    size_t waiting = 0;
    for (const uint32_t page : loaded_)
    {
        if (allNeedsIn(page, State::resident))
        {
            pages_[page].state = State::resident;
            offerForEviction(page);
            published_.push_back(page);
        }
        else if (allNeedsIn(page, State::resident, State::loaded, State::loading))
            loaded_[waiting++] = page;
        else
        {
            dropLoad(page, State::absent);
            discarded_.push_back(page);
        }
    }
    loaded_.resize(waiting);
}

// --- requests

void Residency::request(uint32_t page, float priority)
{
    HEARTH_ASSERT(page < pages_.size() && priority >= 0);
    float& requested = pages_[page].requested;
    if (requested == 0)
        requested_.push_back(page);
    requested = std::max(requested, std::clamp(priority, kMinPriority, kMaxPriority));
}

/// Sort the requests of the round, greatest priority first, then by page. Companions of companions are not
/// included: where sets follow each other, they would bring in the whole mesh.
void Residency::orderRequests()
{
    requests_.clear();
    for (const uint32_t page : requested_)
    {
        const float priority = std::exchange(pages_[page].requested, 0.0f);
        requests_.push_back(Request::of(page, priority));
        for (const uint32_t companion : graph_.companions(page))
            requests_.push_back(Request::of(companion, priority));
    }
    requested_.clear();
    std::sort(requests_.begin(), requests_.end());
}

/// Collect the wanted pages from the greatest priority down, so that each page is first met with the priority
/// that counts. The pages that a page needs come before it: their priority is at least as great, their index
/// is smaller.
void Residency::collectWanted()
{
    wanted_.clear();
    for (auto request = requests_.begin(); request != requests_.end();)
    {
        const float priority = request->priority();
        const size_t first = wanted_.size();
        for (; request != requests_.end() && request->priority() == priority; ++request)
            addWanted(request->page(), priority);
        std::sort(wanted_.begin() + static_cast<ptrdiff_t>(first), wanted_.end());
    }
}

/// Add a page and all pages that it needs to the wanted list, except pages that are in it already.
void Residency::addWanted(uint32_t page, float priority)
{
    const auto reach = [&](uint32_t reached)
    {
        if (pages_[reached].round == round_)
            return;
        pages_[reached].round = round_;
        pages_[reached].priority = priority;
        wanted_.push_back(reached);
    };
    size_t next = wanted_.size();
    reach(page);
    for (; next < wanted_.size(); ++next)
        for (const uint32_t needed : graph_.needs(wanted_[next]))
            reach(needed);
}

// --- the end of a round

std::span<const uint32_t> Residency::schedule()
{
    orderRequests();
    collectWanted();
    for (const uint32_t page : wanted_)
        if (evictable_.contains(page))
            evictable_.update(page, evictionKey(pages_[page].priority, round_));
    measureDemand();
    evictExcess();
    startLoads();
    ++round_;
    return started_;
}

/// Update the error scale from the bytes of wanted pages. Pages that cannot be loaded until failures are
/// retried do not count: drawing coarser would not bring them.
void Residency::measureDemand()
{
    wanted_bytes_ = 0;
    for (const uint32_t page : wanted_)
    {
        const auto needs = graph_.needs(page);
        Page& wanted = pages_[page];
        wanted.blocked =
            wanted.state == State::failed ||
            std::any_of(needs.begin(), needs.end(), [&](uint32_t needed) { return pages_[needed].blocked; });
        if (!wanted.blocked && !graph_.isPinned(page) && wanted.priority > 1)
            wanted_bytes_ += graph_.sizeBytes(page);
    }
    error_scale_.update(graph_.pinnedBytes() + wanted_bytes_, demand_bytes_);
}

/// Evict the least worth until what stays fits the budget, as far as it is not loading.
void Residency::evictExcess()
{
    while (bytes_in_use_ - evicting_bytes_ > options_.budget_bytes && !evictable_.empty())
        evict(evictable_.front());
}

void Residency::startLoads()
{
    started_.clear();
    if (bytes_in_use_ - evicting_bytes_ > options_.budget_bytes)
        return;
    uint64_t free = options_.budget_bytes - std::min(options_.budget_bytes, bytes_in_use_);
    /// free now or soon, less the memory for pages that come before in this order
    uint64_t unpromised = options_.budget_bytes + evicting_bytes_ - bytes_in_use_;
    uint32_t loads_left = options_.max_loads - loads_in_flight_;
    for (const uint32_t page : wanted_)
    {
        if (loads_left == 0)
            return;
        if (!canStart(page))
            continue;
        const uint64_t bytes = graph_.sizeBytes(page);
        if (bytes > unpromised)
            unpromised += makeRoom(page, bytes - unpromised);
        if (bytes > unpromised)
            return;
        unpromised -= bytes;
        --loads_left;
        if (bytes <= free)
            start(page);
        // reserve free memory for a page that waits for more
        free -= std::min(free, bytes);
    }
}

bool Residency::canStart(uint32_t page) const
{
    return pages_[page].state == State::absent &&
           allNeedsIn(page, State::resident, State::loaded, State::loading);
}

/// True if all pages that a page needs are in one of these states.
bool Residency::allNeedsIn(uint32_t page, auto... states) const
{
    const auto needs = graph_.needs(page);
    return std::all_of(needs.begin(), needs.end(),
                       [&](uint32_t needed) { return ((pages_[needed].state == states) || ...); });
}

void Residency::start(uint32_t page)
{
    pages_[page].state = State::loading;
    bytes_in_use_ += graph_.sizeBytes(page);
    ++loads_in_flight_;
    claimNeeded(page);
    started_.push_back(page);
}

// --- the end of a load

void Residency::completed(uint32_t page, bool ok)
{
    HEARTH_ASSERT(page < pages_.size() && pages_[page].state == State::loading);
    --loads_in_flight_;
    if (ok)
    {
        pages_[page].state = State::loaded;
        loaded_.push_back(page);
        return;
    }
    dropLoad(page, State::failed);
    failed_.push_back(page);
    new_failures_.push_back(page);
}

void Residency::dropLoad(uint32_t page, State state)
{
    pages_[page].state = state;
    bytes_in_use_ -= graph_.sizeBytes(page);
    unclaimNeeded(page);
}

void Residency::setBudget(uint64_t bytes, uint64_t demand_bytes)
{
    HEARTH_ASSERT(bytes >= graph_.pinnedBytes() && demand_bytes >= graph_.pinnedBytes());
    options_.budget_bytes = bytes;
    demand_bytes_ = demand_bytes;
}

void Residency::retryFailed()
{
    for (const uint32_t page : failed_)
        pages_[page].state = State::absent;
    failed_.clear();
}

// --- eviction

/// Evict pages, least worth first, until they free `bytes`, and return the freed bytes. Evict none if the
/// pages that `page` may displace do not free enough.
uint64_t Residency::makeRoom(uint32_t page, uint64_t bytes)
{
    const uint64_t limit = evictionKey(pages_[page].priority / options_.hysteresis, round_);
    const size_t before = evicting_.size();
    uint64_t freed_bytes = 0;
    while (freed_bytes < bytes && !evictable_.empty() && evictable_.frontWorth() < limit)
    {
        const uint32_t victim = evictable_.front();
        evict(victim);
        freed_bytes += graph_.sizeBytes(victim);
    }
    if (freed_bytes >= bytes)
        return freed_bytes;
    while (evicting_.size() > before)
        undoEviction(evicting_.back());
    return 0;
}

void Residency::evict(uint32_t page)
{
    evictable_.erase(page);
    pages_[page].state = State::evicting;
    evicting_.push_back(page);
    evicting_bytes_ += graph_.sizeBytes(page);
    unclaimNeeded(page);
}

/// Undo the last eviction.
void Residency::undoEviction(uint32_t page)
{
    claimNeeded(page);
    evicting_bytes_ -= graph_.sizeBytes(page);
    evicting_.pop_back();
    pages_[page].state = State::resident;
    offerForEviction(page);
}

void Residency::claimNeeded(uint32_t page)
{
    for (const uint32_t needed : graph_.needs(page))
        if (pages_[needed].dependent_count++ == 0 && evictable_.contains(needed))
            evictable_.erase(needed);
}

void Residency::unclaimNeeded(uint32_t page)
{
    for (const uint32_t needed : graph_.needs(page))
        if (--pages_[needed].dependent_count == 0)
            offerForEviction(needed);
}

void Residency::offerForEviction(uint32_t page)
{
    const Page& offered = pages_[page];
    if (offered.state == State::resident && offered.dependent_count == 0 && !graph_.isPinned(page))
        evictable_.insert(page, evictionKey(offered.priority, offered.round));
}

/// Return the eviction key of a page: its last priority, halved for each round since. Doubling new priorities
/// in each round instead is equivalent, and leaves stored keys unchanged.
uint64_t Residency::evictionKey(float priority, uint64_t round)
{
    return std::bit_cast<uint32_t>(priority) + (round << kMantissaBits);
}

} // namespace hearth::pack
