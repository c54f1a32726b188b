// Decoded pages of geometry that queries keep, within a budget.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <memory>
#include <span>
#include <vector>

namespace hearth::pack
{

/// Cache of pages. Only the constructor allocates. Not thread-safe.
class PageCache
{
public:
    /// view          of a checked pack that outlives the cache
    /// budget_bytes  of decoded pages; there is room for one in any case
    PageCache(const formats::PackView& view, uint64_t budget_bytes);

    /// Return a decoded page, valid until the next call. Where it is not in the cache, it is decoded in place
    /// of a page that was not used for long. errors: those of PackView::decodePage.
    Result<std::span<const std::byte>> get(uint32_t page);

private:
    struct Slot
    {
        uint32_t page = kInvalidIndex;
        bool is_used = false; ///< since the hand passed it last
    };
    std::span<std::byte> slotBytes(uint32_t slot, uint32_t page);
    uint32_t freeSlot();

    const formats::PackView& view_;
    uint32_t slot_bytes_ = 0;
    std::vector<uint32_t> slot_of_page_;
    std::vector<Slot> slots_;
    std::unique_ptr<std::byte[]> bytes_;
    uint32_t hand_ = 0;
};

} // namespace hearth::pack
