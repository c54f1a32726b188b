// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/memory_exchange.h"

#include "runtime/pack/memory_shares.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace hearth::pack
{

namespace
{

/// Granules that a range of slots is cut into, as far as it has so many slots.
constexpr uint32_t kGranules = 12;

/// Share of what is not always resident that either side keeps.
constexpr uint64_t kKeptShare = 8;

MemoryRange makeRange(const ExchangeLayout& layout)
{
    return {.total_bytes = layout.budget_bytes - layout.pinned_page_bytes - layout.pinned_texture_bytes,
            .fixed_bytes = uint64_t{layout.fixed_slots} * layout.slot_bytes,
            .granule_bytes = uint64_t{layout.granule_slots} * layout.slot_bytes,
            .granules = layout.granules,
            .start_granules = layout.start_granules};
}

} // namespace

std::optional<ExchangeLayout> planExchange(uint64_t budget_bytes, const PageGraph& pages, uint32_t slot_bytes,
                                           const PageGraph& textures, const PoolParts& parts)
{
    const uint64_t pinned = pages.pinnedBytes() + textures.pinnedBytes();
    const uint64_t rest = budget_bytes - std::min(budget_bytes, pinned);
    const uint64_t all_pages = pages.streamedBytes(), all_texels = textures.streamedBytes();
    if (all_pages == 0 || all_texels == 0 || all_pages + all_texels <= rest)
        return std::nullopt;
    const uint64_t min_bytes = std::min(all_pages, rest / kKeptShare);
    const uint64_t max_bytes = std::min(all_pages, rest - std::min(all_texels, rest / kKeptShare));
    const uint64_t slots = (max_bytes - min_bytes) / slot_bytes;
    ExchangeLayout layout{.budget_bytes = budget_bytes,
                          .pinned_page_bytes = pages.pinnedBytes(),
                          .pinned_texture_bytes = textures.pinnedBytes(),
                          .slot_bytes = slot_bytes,
                          .fixed_slots = static_cast<uint32_t>(min_bytes / slot_bytes)};
    layout.granule_slots = static_cast<uint32_t>((slots + kGranules - 1) / kGranules);
    const uint64_t part_slots = uint64_t{parts.count} * parts.max_slots;
    if (slots == 0 || part_slots < layout.granule_slots)
        return std::nullopt;
    layout.granules = static_cast<uint32_t>(std::min(slots, part_slots) / layout.granule_slots);
    layout.parts = parts.count;
    layout.part_slots = std::min(parts.max_slots, layout.granules * layout.granule_slots);
    const uint64_t at_first = divideMemory(budget_bytes, pages, textures).geometry - pages.pinnedBytes();
    const uint64_t moving =
        at_first / slot_bytes - std::min<uint64_t>(at_first / slot_bytes, layout.fixed_slots);
    layout.start_granules =
        static_cast<uint32_t>(std::min<uint64_t>(moving / layout.granule_slots, layout.granules));
    return layout;
}

MemoryExchange::MemoryExchange(const ExchangeLayout& layout)
    : layout_(layout),
      balance_(makeRange(layout)),
      held_(layout.parts, 0),
      is_closing_(layout.parts, false),
      opening_(layout.parts, 0),
      moving_slots_(layout.start_granules * layout.granule_slots),
      slots_before_(moving_slots_)
{
    // the last part stays without memory if it can: another size of one part is made in it
    uint32_t left = moving_slots_;
    for (uint32_t part = 0; part < layout_.parts; ++part)
    {
        const uint32_t others = std::max(layout_.parts - 1, 1u);
        const uint32_t equal = part + 1 < others ? moving_slots_ / others : left;
        held_[part] = std::min({left, equal, layout_.part_slots});
        left -= held_[part];
    }
    HEARTH_ASSERT(left == 0);
}

uint32_t MemoryExchange::heldSlots() const
{
    return std::accumulate(held_.begin(), held_.end(), 0u);
}

uint64_t MemoryExchange::poolBytes(uint64_t moving_slots) const
{
    return layout_.pinned_page_bytes + (layout_.fixed_slots + moving_slots) * layout_.slot_bytes;
}

uint64_t MemoryExchange::textureBytes() const
{
    return layout_.budget_bytes - poolBytes(std::max(heldSlots(), moving_slots_));
}

uint32_t MemoryExchange::demandSlots() const
{
    return layout_.fixed_slots + (is_moving_ ? std::min(moving_slots_, slots_before_) : moving_slots_);
}

bool MemoryExchange::update(const MemoryDemand& geometry, const MemoryDemand& textures)
{
    if (is_moving_)
        return false;
    const uint32_t slots = balance_.update(geometry, textures) * layout_.granule_slots;
    if (slots == moving_slots_)
        return false;
    slots_before_ = moving_slots_;
    moving_slots_ = slots;
    is_moving_ = true;
    plan(slots);
    return true;
}

/// Choose the parts to close, so that as few slots as possible are missing until others are opened:
/// those that stay hold no more than the new share, and the rest fits the parts without memory.
void MemoryExchange::plan(uint32_t slots)
{
    uint32_t best = 0;
    int64_t best_stay = -1;
    for (uint32_t closed = 0; closed < 1u << layout_.parts; ++closed)
    {
        int64_t stay = 0, room = 0;
        for (uint32_t part = 0; part < layout_.parts; ++part)
        {
            const bool stays = (closed >> part & 1) == 0 && held_[part] > 0;
            stay += stays ? held_[part] : 0;
            room += stays ? 0 : layout_.part_slots;
        }
        if (stay <= slots && slots - stay <= room &&
            (stay > best_stay || (stay == best_stay && std::popcount(closed) < std::popcount(best))))
        {
            best = closed;
            best_stay = stay;
        }
    }
    auto left = static_cast<uint32_t>(slots - best_stay);
    for (uint32_t part = 0; part < layout_.parts; ++part)
    {
        const bool stays = (best >> part & 1) == 0 && held_[part] > 0;
        is_closing_[part] = !stays && held_[part] > 0;
        opening_[part] = stays ? 0 : std::min(left, layout_.part_slots);
        left -= opening_[part];
    }
    HEARTH_ASSERT(best_stay >= 0 && left == 0);
}

void MemoryExchange::closed(uint32_t part)
{
    HEARTH_ASSERT(is_closing_[part]);
    is_closing_[part] = false;
    held_[part] = 0;
}

std::optional<MemoryExchange::Opening> MemoryExchange::nextPart(uint64_t texture_bytes_in_use)
{
    if (!is_moving_ || std::ranges::find(is_closing_, true) != is_closing_.end())
        return std::nullopt;
    for (uint32_t part = 0; part < layout_.parts; ++part)
        if (const uint32_t slots = opening_[part]; slots > 0)
        {
            const bool fits =
                poolBytes(uint64_t{heldSlots()} + slots) + texture_bytes_in_use <= layout_.budget_bytes;
            return fits ? std::optional(Opening{part, slots}) : std::nullopt;
        }
    is_moving_ = false;
    return std::nullopt;
}

void MemoryExchange::opened(const Opening& opening)
{
    held_[opening.part] = opening.slots;
    opening_[opening.part] = 0;
}

void MemoryExchange::failed()
{
    std::ranges::fill(opening_, 0u);
    moving_slots_ = heldSlots();
    balance_.limit(moving_slots_ / layout_.granule_slots);
    is_moving_ = false;
}

} // namespace hearth::pack
