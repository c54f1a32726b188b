// Where decoded pages lie in the geometry pool. Plain data, no Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/pack/page_graph.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// First word of a page that has no fixed place.
inline constexpr uint32_t kNoAddress = 0xFFFFFFFFu;

/// Addresses are words of the pool. Pages that stay lie one after the other; behind them slots of one size for those that
/// come and go, so that what leaves always makes room for what comes. Neither crosses the border of a slice.
struct PoolLayout
{
    std::vector<uint32_t> page_addresses; ///< for each page, its first word, or kNoAddress
    std::vector<uint32_t> slot_addresses; ///< for each slot
    uint32_t slot_bytes = 0;              ///< the largest page that comes and goes, at least 64 bytes
    std::array<uint32_t, shared::kPoolSlices> slice_words{};

    uint64_t bytes() const;
};

/// A place for every page. errors: device_limit.
Result<PoolLayout> placeAllPages(const formats::PackView& pack);

/// Places for the pinned pages, and as many slots as the budget and the pool hold, but no more than other pages; bytes()
/// <= budget_bytes. errors: streaming_budget, where the pinned pages exceed the budget; device_limit.
Result<PoolLayout> placePinnedPages(const formats::PackView& pack, const pack::PageGraph& graph,
                                    uint64_t budget_bytes);

} // namespace hearth::gpu
