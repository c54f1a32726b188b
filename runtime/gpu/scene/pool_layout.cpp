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

/// Bytes of the pool for pages. The last slice of a scene with deformed meshes holds poses.
uint64_t poolBytes(const formats::PackView& pack)
{
    const uint32_t slices = pack.deformedMeshes().empty() ? shared::kPoolSlices : shared::kDeformationSlice;
    return slices * kSliceWords * 4;
}

/// Allocates words of the pool from its start; no allocation crosses a slice boundary.
class PoolAllocator
{
public:
    PoolAllocator(PoolLayout& layout, uint64_t max_bytes) : layout_(layout), end_(max_bytes / 16 * 4) {}

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
    layout.slot_bytes = kSlotAlignment;
    for (uint32_t page = 0; page < graph.pageCount(); ++page)
        if (!graph.isPinned(page))
            layout.slot_bytes = std::max(layout.slot_bytes, graph.sizeBytes(page));
    layout.slot_bytes = (layout.slot_bytes + kSlotAlignment - 1) / kSlotAlignment * kSlotAlignment;
    for (size_t count = graph.pageCount() - graph.pinned().size(); count > 0; --count)
        if (const auto address = placer.place(layout.slot_bytes))
            layout.slot_addresses.push_back(*address);
        else
            break;
    return layout;
}

} // namespace hearth::gpu
