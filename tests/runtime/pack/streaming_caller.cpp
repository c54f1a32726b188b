// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/pack/streaming_caller.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

pack::Residency makeResidency(const std::vector<pack::PageNode>& nodes, const pack::ResidencyOptions& options)
{
    auto residency = pack::Residency::create(pack::PageGraph(nodes), options);
    HEARTH_ASSERT(residency.ok());
    return std::move(*residency);
}

} // namespace

StreamingCaller::StreamingCaller(const std::vector<pack::PageNode>& nodes,
                                 const pack::ResidencyOptions& options, const Machine& machine, uint32_t seed)
    : nodes_(nodes),
      options_(options),
      machine_(machine),
      random_(seed),
      residency_(makeResidency(nodes, options)),
      model_(nodes, options),
      resident_(nodes.size(), 0),
      max_bytes_(options.budget_bytes)
{
    for (const uint32_t page : residency_.graph().pinned())
        publish(page);
}

bool StreamingCaller::frame(const Requests& requests)
{
    ++serial_;
    const uint64_t late = std::min<uint64_t>(roll(machine_.most_frames_late + 1), serial_ - 1);
    completed_serial_ = std::max(completed_serial_, serial_ - 1 - late);
    ChangeLists changes = makeLists(residency_.beginFrame(serial_, completed_serial_));
    std::sort(changes.released.begin(), changes.released.end());
    EXPECT_EQ(changes, model_.beginFrame(serial_, completed_serial_));
    apply(changes);
    for (const auto& [page, priority] : requests)
    {
        residency_.request(page, priority);
        model_.request(page, priority);
    }
    const auto scheduled = residency_.schedule();
    const std::vector<uint32_t> started(scheduled.begin(), scheduled.end());
    EXPECT_EQ(started, model_.schedule());
    startLoads(started);
    endLoads();
    return !started.empty() || !loads_.empty() || !held_.empty() || changes != ChangeLists{};
}

uint32_t StreamingCaller::settle(const Requests& requests, uint32_t most, uint32_t quiet)
{
    uint32_t quiet_frames = 0, frames = 0;
    for (; frames < most && quiet_frames < quiet; ++frames)
        quiet_frames = frame(requests) ? 0 : quiet_frames + 1;
    return frames;
}

void StreamingCaller::retryFailed()
{
    residency_.retryFailed();
    model_.retryFailed();
}

void StreamingCaller::setBudget(uint64_t bytes)
{
    residency_.setBudget(bytes, bytes);
    model_.setBudget(bytes);
    options_.budget_bytes = bytes;
    max_bytes_ = std::max(bytes, residency_.bytesInUse());
}

void StreamingCaller::mend()
{
    machine_.bad_pages.clear();
    machine_.failures_of_64 = 0;
}

std::vector<uint32_t> StreamingCaller::residentPages() const
{
    std::vector<uint32_t> pages;
    for (uint32_t page = 0; page < resident_.size(); ++page)
        if (resident_[page] != 0)
            pages.push_back(page);
    return pages;
}

void StreamingCaller::apply(const ChangeLists& changes)
{
    for (const uint32_t page : changes.evicted)
        evict(page);
    for (const uint32_t page : changes.released)
    {
        EXPECT_LE(held_.at(page), completed_serial_) << "a frame may still read page " << page;
        held_.erase(page);
    }
    for (const uint32_t page : changes.published)
    {
        EXPECT_EQ(loaded_.erase(page), 1u) << "page " << page << " is not loaded";
        publish(page);
    }
    for (const uint32_t page : changes.discarded)
        EXPECT_EQ(loaded_.erase(page), 1u) << "page " << page << " is not loaded";
    for (const uint32_t page : changes.failed)
    {
        ++failure_count_of_page_[page];
        EXPECT_EQ(failure_count_of_page_[page], ended_badly_[page]) << "each failure is reported once";
    }
    expectBytesInBudget();
    for (uint32_t page = 0; page < nodes_.size(); ++page)
        EXPECT_EQ(residency_.isResident(page), resident_[page] != 0);
}

void StreamingCaller::evict(uint32_t page)
{
    EXPECT_TRUE(resident_[page] != 0 && !residency_.graph().isPinned(page));
    for (uint32_t other = 0; other < nodes_.size(); ++other)
        EXPECT_TRUE(resident_[other] == 0 ||
                    std::count(nodes_[other].needs.begin(), nodes_[other].needs.end(), page) == 0)
            << "page " << other << " needs page " << page << ", which is evicted";
    resident_[page] = 0;
    held_[page] = serial_ - 1;
    ++eviction_count_;
}

void StreamingCaller::publish(uint32_t page)
{
    EXPECT_EQ(resident_[page], 0);
    for (const uint32_t needed : nodes_[page].needs)
        EXPECT_NE(resident_[needed], 0) << "page " << page << " needs page " << needed;
    resident_[page] = 1;
}

void StreamingCaller::startLoads(const std::vector<uint32_t>& pages)
{
    for (const uint32_t page : pages)
    {
        EXPECT_TRUE(resident_[page] == 0 && loads_.count(page) == 0 && loaded_.count(page) == 0 &&
                    held_.count(page) == 0)
            << "page " << page << " is loaded twice";
        for (const uint32_t needed : nodes_[page].needs)
            EXPECT_TRUE(resident_[needed] != 0 || loads_.count(needed) != 0 || loaded_.count(needed) != 0);
        loads_[page] = 1 + roll(machine_.most_load_frames);
        ++start_count_;
    }
    EXPECT_LE(loads_.size(), options_.max_loads);
    expectBytesInBudget();
}

void StreamingCaller::endLoads()
{
    std::vector<uint32_t> ended;
    for (auto& [page, frames] : loads_)
        if (--frames == 0)
            ended.push_back(page);
    std::shuffle(ended.begin(), ended.end(), random_);
    for (const uint32_t page : ended)
    {
        loads_.erase(page);
        const bool ok = machine_.bad_pages.count(page) == 0 && roll(64) >= machine_.failures_of_64;
        residency_.completed(page, ok);
        model_.completed(page, ok);
        if (ok)
            loaded_.insert(page);
        else
            ++ended_badly_[page];
        expectBytesInBudget();
    }
}

void StreamingCaller::expectBytesInBudget()
{
    uint64_t bytes = 0;
    for (uint32_t page = 0; page < nodes_.size(); ++page)
        if (resident_[page] != 0 || loads_.count(page) != 0 || loaded_.count(page) != 0 ||
            held_.count(page) != 0)
            bytes += nodes_[page].size_bytes;
    EXPECT_EQ(residency_.bytesInUse(), bytes);
    EXPECT_EQ(model_.bytesInUse(), bytes);
    EXPECT_LE(bytes, max_bytes_);
    max_bytes_ = std::max(options_.budget_bytes, std::min(max_bytes_, bytes));
}

std::vector<pack::PageNode> randomPages(std::mt19937& random, uint32_t most_pages)
{
    std::vector<pack::PageNode> nodes(1 + random() % most_pages);
    for (uint32_t page = 0; page < nodes.size(); ++page)
    {
        nodes[page].size_bytes = 1 + static_cast<uint32_t>(random() % 64);
        nodes[page].holds_root = page == 0 || random() % 16 == 0;
        std::set<uint32_t> needs, companions;
        for (uint64_t count = page > 0 ? random() % 4 : 0; count > 0; --count)
            needs.insert(page - 1 - static_cast<uint32_t>(random() % std::min(page, 12u)));
        if (page + 1 < nodes.size() && random() % 16 == 0)
            companions.insert(page + 1 + static_cast<uint32_t>(random() % (nodes.size() - page - 1)));
        nodes[page].needs.assign(needs.begin(), needs.end());
        nodes[page].companions.assign(companions.begin(), companions.end());
    }
    return nodes;
}

uint64_t pinnedBytes(const std::vector<pack::PageNode>& nodes)
{
    return pack::PageGraph(nodes).pinnedBytes();
}

uint64_t allBytes(const std::vector<pack::PageNode>& nodes)
{
    uint64_t bytes = 0;
    for (const pack::PageNode& node : nodes)
        bytes += node.size_bytes;
    return bytes;
}

std::set<uint32_t> computeClosure(const std::vector<pack::PageNode>& nodes, std::set<uint32_t> pages)
{
    for (uint32_t page = static_cast<uint32_t>(nodes.size()); page-- > 0;)
        if (pages.count(page) != 0)
            pages.insert(nodes[page].needs.begin(), nodes[page].needs.end());
    return pages;
}

} // namespace hearth::test
