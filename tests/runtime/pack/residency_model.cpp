// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/pack/residency_model.h"

#include "formats/records/container.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hearth::test
{

namespace
{

std::vector<uint32_t> makeCopy(std::span<const uint32_t> pages)
{
    return {pages.begin(), pages.end()};
}

template <typename T>
bool isOneIn(T value, std::initializer_list<T> values)
{
    return std::find(values.begin(), values.end(), value) != values.end();
}

void raise(std::map<uint32_t, double>& priorities, uint32_t page, double priority)
{
    double& of_page = priorities[page];
    of_page = std::max(of_page, priority);
}

} // namespace

ChangeLists makeLists(const pack::FrameChanges& changes)
{
    return {makeCopy(changes.evicted), makeCopy(changes.published), makeCopy(changes.released),
            makeCopy(changes.discarded), makeCopy(changes.failed)};
}

ResidencyModel::ResidencyModel(const std::vector<pack::PageNode>& nodes,
                               const pack::ResidencyOptions& options)
    : nodes_(nodes), options_(options), pages_(nodes.size())
{
    const auto pin = [&](const auto& self, size_t page) -> void
    {
        pages_[page].pinned = true;
        pages_[page].state = State::resident;
        for (const uint32_t needed : nodes_[page].needs)
            self(self, needed);
    };
    for (size_t page = 0; page < nodes.size(); ++page)
        if (nodes[page].holds_root)
            pin(pin, page);
}

ChangeLists ResidencyModel::beginFrame(uint64_t serial, uint64_t completed_serial)
{
    ChangeLists changes;
    changes.evicted = std::exchange(leaving_, {});
    for (const uint32_t page : changes.evicted)
    {
        pages_[page].state = State::held;
        pages_[page].last_serial = serial_;
    }
    for (uint32_t page = 0; page < pages_.size(); ++page)
        if (pages_[page].state == State::held && pages_[page].last_serial <= completed_serial)
        {
            pages_[page].state = State::absent;
            changes.released.push_back(page);
        }
    for (uint32_t page = 0; page < pages_.size(); ++page)
    {
        if (pages_[page].state != State::loaded)
            continue;
        if (needsAre(pages_, page, {State::resident}))
        {
            pages_[page].state = State::resident;
            changes.published.push_back(page);
        }
        else if (!needsAre(pages_, page, {State::resident, State::loaded, State::loading}))
        {
            pages_[page].state = State::absent;
            changes.discarded.push_back(page);
        }
    }
    changes.failed = std::exchange(failures_, {});
    serial_ = serial;
    return changes;
}

void ResidencyModel::request(uint32_t page, float priority)
{
    raise(requests_, page, std::max(double{priority}, double{std::numeric_limits<float>::min()}));
}

std::map<uint32_t, double> ResidencyModel::wanted() const
{
    std::map<uint32_t, double> all = requests_;
    for (const auto& [page, priority] : requests_)
        for (const uint32_t companion : nodes_[page].companions)
            raise(all, companion, priority);
    for (size_t page = nodes_.size(); page-- > 0;)
        if (const auto found = all.find(static_cast<uint32_t>(page)); found != all.end())
            for (const uint32_t needed : nodes_[page].needs)
                raise(all, needed, found->second);
    return all;
}

std::vector<uint32_t> ResidencyModel::schedule()
{
    // negative priorities: ascending order is the order of service
    std::vector<std::pair<double, uint32_t>> order;
    for (const auto& [page, priority] : wanted())
    {
        order.emplace_back(-priority, page);
        pages_[page].priority = priority;
        pages_[page].round = round_;
    }
    std::sort(order.begin(), order.end());
    evictExcess();

    std::vector<uint32_t> started;
    uint64_t promised = 0;
    size_t waiting = 0;
    for (const auto& [negative_priority, page] : order)
    {
        const auto loading = std::count_if(pages_.begin(), pages_.end(),
                                           [](const Page& p) { return p.state == State::loading; });
        if (static_cast<size_t>(loading) + waiting == options_.max_loads)
            break;
        if (pages_[page].state != State::absent ||
            !needsAre(pages_, page, {State::resident, State::loaded, State::loading}))
            continue;

        Pages trial = pages_;
        std::vector<uint32_t> victims;
        const auto staying = [&]
        {
            return sumBytes(trial, {State::resident, State::loading, State::loaded}) + promised +
                   nodes_[page].size_bytes;
        };
        while (staying() > options_.budget_bytes)
        {
            const uint32_t victim = leastWorth(trial);
            if (victim == kInvalidIndex ||
                worth(pages_[victim]) * double{options_.hysteresis} >= -negative_priority)
                break;
            trial[victim].state = State::leaving;
            victims.push_back(victim);
        }
        if (staying() > options_.budget_bytes)
            break;
        pages_ = trial;
        leaving_.insert(leaving_.end(), victims.begin(), victims.end());
        if (bytesInUse() + promised + nodes_[page].size_bytes <= options_.budget_bytes)
        {
            pages_[page].state = State::loading;
            started.push_back(page);
        }
        else
        {
            promised += nodes_[page].size_bytes;
            ++waiting;
        }
    }
    requests_.clear();
    ++round_;
    return started;
}

/// Evict what a smaller budget does not hold, one page after the other.
void ResidencyModel::evictExcess()
{
    while (sumBytes(pages_, {State::resident, State::loading, State::loaded}) > options_.budget_bytes)
    {
        const uint32_t victim = leastWorth(pages_);
        if (victim == kInvalidIndex)
            return;
        pages_[victim].state = State::leaving;
        leaving_.push_back(victim);
    }
}

void ResidencyModel::completed(uint32_t page, bool ok)
{
    pages_[page].state = ok ? State::loaded : State::failed;
    if (!ok)
        failures_.push_back(page);
}

void ResidencyModel::retryFailed()
{
    for (Page& page : pages_)
        if (page.state == State::failed)
            page.state = State::absent;
}

uint64_t ResidencyModel::bytesInUse() const
{
    return sumBytes(pages_, {State::resident, State::loading, State::loaded, State::leaving, State::held});
}

uint64_t ResidencyModel::sumBytes(const Pages& pages, std::initializer_list<State> states) const
{
    uint64_t bytes = 0;
    for (size_t page = 0; page < pages.size(); ++page)
        bytes += isOneIn(pages[page].state, states) ? nodes_[page].size_bytes : 0;
    return bytes;
}

bool ResidencyModel::needsAre(const Pages& pages, uint32_t page, std::initializer_list<State> states) const
{
    return std::all_of(nodes_[page].needs.begin(), nodes_[page].needs.end(),
                       [&](uint32_t needed) { return isOneIn(pages[needed].state, states); });
}

bool ResidencyModel::hasDependents(const Pages& pages, uint32_t page) const
{
    for (size_t other = 0; other < pages.size(); ++other)
        if (isOneIn(pages[other].state, {State::loading, State::loaded, State::resident}))
            for (const uint32_t needed : nodes_[other].needs)
                if (needed == page)
                    return true;
    return false;
}

double ResidencyModel::worth(const Page& page) const
{
    return std::ldexp(page.priority, -static_cast<int>(round_ - page.round));
}

uint32_t ResidencyModel::leastWorth(const Pages& pages) const
{
    uint32_t least = kInvalidIndex;
    for (uint32_t page = 0; page < pages.size(); ++page)
        if (pages[page].state == State::resident && !pages[page].pinned && !hasDependents(pages, page))
            if (least == kInvalidIndex || worth(pages[page]) <= worth(pages[least]))
                least = page;
    return least;
}

} // namespace hearth::test
