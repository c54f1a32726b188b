// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/page_stream.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hearth::pack
{

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
      slots_(options.slot_count, options.movable_parts, options.part_slots),
      demand_slots_(options.slot_count),
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
    movePages();
    startReads();
    updateStatistics();
    return {uploads_, moves_, groups_.changes(), changes.failed};
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
            if (!slots_.isOpen(slots_.part(slot_of_page_[page])))
                leaving_serial_ = serial;
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
    slots_.giveBack(std::exchange(slot_of_page_[page], kInvalidIndex));
}

/// Move resident pages out of parts that are being closed, once the others have room for all of them. Pages
/// that are loading follow when they are resident.
void PageStream::movePages()
{
    moves_.clear();
    std::erase_if(closing_parts_, [&](uint32_t part) { return slots_.usedSlots(part) == 0; });
    if (closing_parts_.empty() || residency_.bytesInUse() > residency_.budgetBytes())
        return;
    for (uint32_t page = 0; page < slot_of_page_.size(); ++page)
    {
        const uint32_t from = slot_of_page_[page];
        if (from == kInvalidIndex || slots_.isOpen(slots_.part(from)) || !residency_.isResident(page))
            continue;
        slot_of_page_[page] = slots_.take();
        slots_.giveBack(from);
        moves_.push_back({page, from, slot_of_page_[page]});
        leaving_serial_ = serial_;
    }
}

void PageStream::openPart(uint32_t part, uint32_t slots)
{
    slots_.open(part, slots);
    updateBudget();
}

void PageStream::closePart(uint32_t part)
{
    slots_.close(part);
    closing_parts_.push_back(part);
    updateBudget();
}

void PageStream::setDemandSlots(uint32_t slots)
{
    if (slots == demand_slots_)
        return;
    demand_slots_ = slots;
    updateBudget();
}

void PageStream::updateBudget()
{
    const uint64_t pinned = residency_.graph().pinnedBytes();
    residency_.setBudget(pinned + uint64_t{slots_.openSlots()} * options_.slot_bytes,
                         pinned + uint64_t{demand_slots_} * options_.slot_bytes);
    changed_serial_ = serial_;
    updateStatistics();
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
        slot_of_page_[page] = slots_.take();
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
    statistics_.budget_bytes = std::max(residency_.budgetBytes(), statistics_.bytes_in_use);
    statistics_.error_scale = residency_.errorScale();
}

} // namespace hearth::pack
