// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/page_cache.h"

#include <algorithm>

namespace hearth::pack
{

PageCache::PageCache(const formats::PackView& view, uint64_t budget_bytes)
    : view_(view), slot_of_page_(view.pages().size(), kInvalidIndex)
{
    if (view.pages().empty())
        return;
    for (const formats::PageRecord& page : view.pages())
        slot_bytes_ = std::max(slot_bytes_, page.size);
    const uint64_t count = std::clamp<uint64_t>(budget_bytes / slot_bytes_, 1, view.pages().size());
    slots_.resize(static_cast<size_t>(count));
    // not written: the system gives memory to slots that are used
    bytes_ = std::make_unique_for_overwrite<std::byte[]>(slots_.size() * slot_bytes_);
}

Result<std::span<const std::byte>> PageCache::get(uint32_t page)
{
    if (const uint32_t slot = slot_of_page_[page]; slot != kInvalidIndex)
    {
        slots_[slot].is_used = true;
        return std::span<const std::byte>(slotBytes(slot, page));
    }
    const uint32_t slot = freeSlot();
    HEARTH_TRY(view_.decodePage(page, slotBytes(slot, page)));
    slots_[slot] = {page, true};
    slot_of_page_[page] = slot;
    return std::span<const std::byte>(slotBytes(slot, page));
}

std::span<std::byte> PageCache::slotBytes(uint32_t slot, uint32_t page)
{
    return {bytes_.get() + size_t{slot} * slot_bytes_, view_.pages()[page].size};
}

/// Free the first slot from the hand on that was not used since the hand passed it.
uint32_t PageCache::freeSlot()
{
    while (slots_[hand_].is_used)
    {
        slots_[hand_].is_used = false;
        hand_ = (hand_ + 1) % static_cast<uint32_t>(slots_.size());
    }
    const uint32_t slot = hand_;
    hand_ = (hand_ + 1) % static_cast<uint32_t>(slots_.size());
    if (slots_[slot].page != kInvalidIndex)
        slot_of_page_[slots_[slot].page] = kInvalidIndex;
    slots_[slot] = {};
    return slot;
}

} // namespace hearth::pack
