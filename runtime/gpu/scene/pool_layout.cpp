// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/pool_layout.h"

#include "formats/gpu_shared/deformation.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

namespace hearth::gpu
{

namespace
{

constexpr uint64_t kSliceWords = uint64_t{1} << shared::kPoolSliceAddressBits;
constexpr uint32_t kSlotAlignment = 64;

/// Slices of the pool for pages. The last slice of a scene with deformed meshes holds poses.
uint32_t countSlices(const formats::PackView& pack)
{
    return pack.deformedMeshes().empty() ? shared::kPoolSlices : shared::kDeformationSlice;
}

uint64_t poolBytes(const formats::PackView& pack)
{
    return countSlices(pack) * kSliceWords * 4;
}

/// Allocates words of the pool from its start; no allocation crosses a slice boundary.
class PoolAllocator
{
public:
    PoolAllocator(PoolLayout& layout, uint64_t max_bytes) : layout_(layout), end_(max_bytes / 4) {}

    std::optional<uint32_t> place(uint32_t bytes)
    {
        const uint64_t words = (uint64_t{bytes} + 3) / 4;
        uint64_t first = next_;
        if (first % kSliceWords + words > kSliceWords)
            first = (first / kSliceWords + 1) * kSliceWords;
        if (first + words > end_)
            return std::nullopt;
        next_ = first + words;
        const uint64_t slice = first / kSliceWords;
        layout_.slice_words[slice] = static_cast<uint32_t>(next_ - slice * kSliceWords);
        return static_cast<uint32_t>(first);
    }

private:
    PoolLayout& layout_;
    uint64_t end_;
    uint64_t next_ = 0;
};

} // namespace

uint64_t PoolLayout::bytes() const
{
    return std::accumulate(slice_words.begin(), slice_words.end(), uint64_t{0}) * 4;
}

Result<PoolLayout> placeAllPages(const formats::PackView& pack)
{
    PoolLayout layout;
    const uint64_t pool_bytes = poolBytes(pack);
    PoolAllocator placer(layout, pool_bytes);
    layout.page_addresses.reserve(pack.pages().size());
    for (const formats::PageRecord& page : pack.pages())
    {
        const auto address = placer.place(page.size);
        if (!address)
            return Error{Issue::device_limit, pack.name(), "",
                         "the geometry is larger than the " + std::to_string(pool_bytes >> 20) +
                             " MiB that are drawn without streaming"};
        layout.page_addresses.push_back(*address);
    }
    return layout;
}

uint32_t findPoolSlotBytes(const pack::PageGraph& graph)
{
    uint32_t bytes = kSlotAlignment;
    for (uint32_t page = 0; page < graph.pageCount(); ++page)
        if (!graph.isPinned(page))
            bytes = std::max(bytes, graph.sizeBytes(page));
    return (bytes + kSlotAlignment - 1) / kSlotAlignment * kSlotAlignment;
}

Result<PoolLayout> placePinnedPages(const formats::PackView& pack, const pack::PageGraph& graph,
                                    uint64_t budget_bytes)
{
    PoolLayout layout;
    const uint64_t pool_bytes = poolBytes(pack);
    PoolAllocator placer(layout, std::min(budget_bytes, pool_bytes));
    layout.page_addresses.assign(graph.pageCount(), kNoAddress);
    for (const uint32_t page : graph.pinned())
    {
        const auto address = placer.place(graph.sizeBytes(page));
        if (!address)
            return Error{
                budget_bytes < pool_bytes ? Issue::streaming_budget : Issue::device_limit, pack.name(), "",
                "the " + std::to_string(graph.pinned().size()) + " pages that are always resident take " +
                    std::to_string(graph.pinnedBytes()) + " bytes, the geometry pool is to have " +
                    std::to_string(std::min(budget_bytes, pool_bytes))};
        layout.page_addresses[page] = *address;
    }
    layout.slot_bytes = findPoolSlotBytes(graph);
    for (size_t count = graph.pageCount() - graph.pinned().size(); count > 0; --count)
        if (const auto address = placer.place(layout.slot_bytes))
            layout.slot_addresses.push_back(*address);
        else
            break;
    return layout;
}

pack::PoolParts movableParts(const formats::PackView& pack, const pack::PageGraph& graph,
                             uint64_t budget_bytes)
{
    // the fixed slots take an eighth of the budget at most, and slices end with less than a page to spare
    const uint64_t slice_bytes = kSliceWords * 4 - formats::kMaxPageBytes;
    const uint64_t used = (graph.pinnedBytes() + budget_bytes / 8) / slice_bytes + 1;
    const uint64_t slices = countSlices(pack);
    return {.count = static_cast<uint32_t>(slices - std::min(slices, used)),
            .max_slots = static_cast<uint32_t>(kSliceWords * 4 / findPoolSlotBytes(graph))};
}

Result<PoolLayout> placeExchange(const formats::PackView& pack, const pack::PageGraph& graph,
                                 pack::ExchangeLayout& exchange)
{
    const uint64_t fixed_bytes =
        exchange.pinned_page_bytes + uint64_t{exchange.fixed_slots} * exchange.slot_bytes;
    HEARTH_ASSIGN_OR_RETURN(PoolLayout layout, placePinnedPages(pack, graph, fixed_bytes));
    exchange.fixed_slots = static_cast<uint32_t>(layout.slot_addresses.size());
    layout.first_movable_slice = countSlices(pack) - exchange.parts;
    const pack::MemoryExchange at_first(exchange);
    const uint32_t slot_words = layout.slot_bytes / 4;
    for (uint32_t part = 0; part < exchange.parts; ++part)
    {
        const uint32_t slice = layout.first_movable_slice + part;
        HEARTH_ASSERT(layout.slice_words[slice] == 0);
        layout.slice_words[slice] = at_first.slots(part) * slot_words;
        for (uint32_t slot = 0; slot < exchange.part_slots; ++slot)
            layout.slot_addresses.push_back(static_cast<uint32_t>(slice * kSliceWords) + slot * slot_words);
    }
    return layout;
}

} // namespace hearth::gpu
