// Layout of decoded pages in the geometry pool. Plain data, no Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/pack/memory_exchange.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// Address of a page without a fixed place.
inline constexpr uint32_t kNoAddress = 0xFFFFFFFFu;

/// Addresses are words of the pool. Pinned pages are packed one after the other; slots of one size for
/// streamed pages follow, so that an evicted page always makes room for a new one. Neither crosses a
/// slice boundary.
struct PoolLayout
{
    std::vector<uint32_t> page_addresses; ///< per page: its first word, or kNoAddress
    std::vector<uint32_t> slot_addresses; ///< per slot: its first word
    uint32_t slot_bytes = 0;              ///< from findPoolSlotBytes
    std::array<uint32_t, shared::kPoolSlices> slice_words{};
    uint32_t first_movable_slice = shared::kPoolSlices; ///< from here on slices come and go

    uint64_t bytes() const;
};

/// Place every page. errors: device_limit.
Result<PoolLayout> placeAllPages(const formats::PackView& pack);

/// Return the bytes of a slot that holds any page that is not pinned.
uint32_t findPoolSlotBytes(const pack::PageGraph& graph);

/// Place the pinned pages, and as many slots as the budget and the pool hold, but no more than there are
/// other pages; bytes() <= budget_bytes. errors: streaming_budget if the pinned pages exceed the budget;
/// device_limit.
Result<PoolLayout> placePinnedPages(const formats::PackView& pack, const pack::PageGraph& graph,
                                    uint64_t budget_bytes);

/// Return the slices that an exchange of memory may have beside those of always resident pages and
/// slots.
pack::PoolParts movableParts(const formats::PackView& pack, const pack::PageGraph& graph,
                             uint64_t budget_bytes);

/// Place the pinned pages and the fixed slots of an exchange, then slots for its parts, in slices of
/// their own; parts have the memory that they have at first. The exchange is corrected to what has been
/// placed. errors: as placePinnedPages.
/// exchange  planned for the movableParts of the same arguments
Result<PoolLayout> placeExchange(const formats::PackView& pack, const pack::PageGraph& graph,
                                 pack::ExchangeLayout& exchange);

} // namespace hearth::gpu
