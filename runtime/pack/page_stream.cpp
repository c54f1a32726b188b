// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/page_stream.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hearth::pack
{

namespace
{

/// Return a stack of 0 .. count - 1, with 0 on top.
std::vector<uint32_t> makeStack(uint32_t count)
{
    std::vector<uint32_t> stack(count);
    std::iota(stack.rbegin(), stack.rend(), 0u);
    return stack;
}

uint32_t pop(std::vector<uint32_t>& stack)
{
    HEARTH_ASSERT(!stack.empty());
    const uint32_t top = stack.back();
    stack.pop_back();
    return top;
}

} // namespace

Result<PageStream> PageStream::create(const formats::PackView& view, PageGraph graph,
                                      const PageStreamOptions& options, std::span<std::byte> staging)
{
    HEARTH_ASSERT(options.slot_bytes > 0 && staging.size() >= options.slot_bytes &&
                  options.residency.budget_bytes <=
                      graph.pinnedBytes() + uint64_t{options.slot_count} * options.slot_bytes);
    HEARTH_ASSIGN_OR_RETURN(Residency residency, Residency::create(std::move(graph), options.residency));
    return PageStream(view, std::move(residency), options, staging);
}

PageStream::PageStream(const formats::PackView& view, Residency residency, const PageStreamOptions& options,
                       std::span<std::byte> staging)
    : view_(&view),
      options_(options),
      staging_(staging),
      residency_(std::move(residency)),
      groups_(view),
      queue_(std::make_unique<CompletionQueue>(options.residency.max_loads)),
      slot_of_page_(view.pages().size(), kInvalidIndex),
      staging_of_page_(view.pages().size(), kInvalidIndex),
      free_slots_(makeStack(options.slot_count)),
      staging_slots_(static_cast<uint32_t>(staging.size() / options.slot_bytes))
{
    for (const uint32_t page : residency_.graph().pinned())
    {
        groups_.add(page);
        statistics_.bytes_resident += view.pages()[page].size;
        ++statistics_.pages_resident;
    }
    groups_.clearChanges();
    pending_reads_.reserve(options.residency.max_loads);
    uploads_.reserve(options.residency.max_loads);
    statistics_.budget_bytes = options.residency.budget_bytes;
    updateStatistics();
}

StreamChanges PageStream::beginFrame(uint64_t serial, uint64_t completed_serial)
{
    serial_ = serial;
    staging_slots_.complete(completed_serial);
    takeCompletions(serial);
    const FrameChanges changes = residency_.beginFrame(serial, completed_serial);
    groups_.clearChanges();
    for (const uint32_t page : changes.evicted)
        groups_.remove(page);
    for (const uint32_t page : changes.published)
        groups_.add(page);
    for (const auto& freed : {changes.released, changes.discarded})
        for (const uint32_t page : freed)
            freeSlot(page);

    const auto computeSize = [&](uint64_t sum, uint32_t page) { return sum + view_->pages()[page].size; };
    statistics_.bytes_resident +=
        std::accumulate(changes.published.begin(), changes.published.end(), uint64_t{0}, computeSize) -
        std::accumulate(changes.evicted.begin(), changes.evicted.end(), uint64_t{0}, computeSize);
    statistics_.pages_resident += static_cast<uint32_t>(changes.published.size() - changes.evicted.size());
    statistics_.failures += static_cast<uint32_t>(changes.failed.size());
    if (!changes.evicted.empty() || !changes.published.empty())
        changed_serial_ = serial;
    startReads();
    updateStatistics();
    return {uploads_, groups_.changes(), changes.failed};
}

void PageStream::takeCompletions(uint64_t serial)
{
    uploads_.clear();
    for (const auto& [page, ok] : queue_->take())
    {
        --reads_in_flight_;
        const uint32_t staging_slot = std::exchange(staging_of_page_[page], kInvalidIndex);
        if (ok)
        {
            uploads_.push_back({page, slot_of_page_[page], staging_slot});
            staging_slots_.giveBackAfter(staging_slot, serial);
            statistics_.bytes_streamed += view_->pages()[page].size;
        }
        else
        {
            staging_slots_.giveBack(staging_slot);
            freeSlot(page);
        }
        residency_.completed(page, ok);
    }
}

void PageStream::freeSlot(uint32_t page)
{
    free_slots_.push_back(std::exchange(slot_of_page_[page], kInvalidIndex));
}

void PageStream::request(uint32_t page, float priority)
{
    residency_.request(page, priority);
}

void PageStream::schedule(uint64_t feedback_serial)
{
    const float scale_before = residency_.errorScale();
    const auto started = residency_.schedule();
    if (!started.empty() || residency_.errorScale() != scale_before)
        changed_serial_ = serial_;
    for (const uint32_t page : started)
    {
        slot_of_page_[page] = pop(free_slots_);
        pending_reads_.push_back(page);
    }
    if (residency_.atRest() && feedback_serial >= changed_serial_)
        settled_serial_ = feedback_serial;
    startReads();
    updateStatistics();
}

void PageStream::startReads()
{
    size_t count = 0;
    for (; count < pending_reads_.size() && !staging_slots_.isEmpty(); ++count)
    {
        const uint32_t page = pending_reads_[count];
        staging_of_page_[page] = staging_slots_.take();
        ++reads_in_flight_;
        const std::span<std::byte> destination =
            staging_.subspan(size_t{staging_of_page_[page]} * options_.slot_bytes, view_->pages()[page].size);
        options_.read(page, destination, ReadDone(*queue_, page));
    }
    pending_reads_.erase(pending_reads_.begin(), pending_reads_.begin() + static_cast<ptrdiff_t>(count));
}

void PageStream::updateStatistics()
{
    statistics_.bytes_in_use = residency_.bytesInUse();
    statistics_.error_scale = residency_.errorScale();
}

} // namespace hearth::pack
