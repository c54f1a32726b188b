// Layout of decoded pages in the geometry pool. Plain data, no Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/pack/page_graph.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// Address of a page without a fixed place.
inline constexpr uint32_t kNoAddress = 0xFFFFFFFFu;

/// Addresses are words of the pool. Pinned pages are packed one after the other; slots of one size for
/// streamed pages follow, so that an evicted page always makes room for a new one. Neither crosses a slice
/// boundary.
struct PoolLayout
{
    std::vector<uint32_t> page_addresses; ///< per page: its first word, or kNoAddress
    std::vector<uint32_t> slot_addresses; ///< per slot: its first word
    uint32_t slot_bytes = 0;              ///< the largest streamed page, at least 64 bytes
    std::array<uint32_t, shared::kPoolSlices> slice_words{};

    uint64_t bytes() const;
};

/// Place every page. errors: device_limit.
Result<PoolLayout> placeAllPages(const formats::PackView& pack);

/// Place the pinned pages, and as many slots as the budget and the pool hold, but no more than there are
/// other pages; bytes() <= budget_bytes. errors: streaming_budget if the pinned pages exceed the budget;
/// device_limit.
Result<PoolLayout> placePinnedPages(const formats::PackView& pack, const pack::PageGraph& graph,
                                    uint64_t budget_bytes);

} // namespace hearth::gpu
