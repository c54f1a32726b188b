// What streaming knows of the pages of a pack: how large they are and which need which. See README.md, "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// A page, as one writes it down to make a graph of.
struct PageNode
{
    uint32_t size_bytes = 0; ///< decoded
    bool holds_root = false; ///< it has a group that nothing coarser replaces
    /// Pages, all before this one, each once, without which it must not be resident.
    std::vector<uint32_t> needs;
    /// Pages, all behind this one, each once, that are requested with it.
    std::vector<uint32_t> companions;
};

/// The pages and what they need. A set of pages is closed if it has, with each page, all that this page needs; only
/// closed sets may be resident, since only then does the cut cover each surface once.
class PageGraph
{
public:
    /// The order of the nodes is asserted.
    explicit PageGraph(std::span<const PageNode> nodes);

    /// The pages of a view that has passed the checker. A page needs its parents. Of a set of groups (GroupRecord) that
    /// spans several pages, what refines it needs all of them, and they are the companions of its first.
    static PageGraph of(const formats::PackView& view);

    /// The same pages, where each that is not pinned takes a slot of `slot_bytes`, >= its size (asserted).
    PageGraph inSlots(uint32_t slot_bytes) const;

    uint32_t pageCount() const { return static_cast<uint32_t>(sizes_bytes_.size()); }
    uint32_t sizeBytes(uint32_t page) const { return sizes_bytes_[page]; }
    std::span<const uint32_t> needs(uint32_t page) const { return needs_.of(page); }
    std::span<const uint32_t> companions(uint32_t page) const { return companions_.of(page); }

    /// The pages that are always resident, ascending: those with roots and what they need.
    std::span<const uint32_t> pinned() const { return pinned_; }
    bool isPinned(uint32_t page) const { return is_pinned_[page]; }
    uint64_t pinnedBytes() const { return pinned_bytes_; }

private:
    /// A list of pages for each page.
    struct Lists
    {
        std::vector<uint32_t> begins{0};
        std::vector<uint32_t> items;
        void append(std::span<const uint32_t> list);
        std::span<const uint32_t> of(uint32_t page) const
        {
            return std::span(items).subspan(begins[page], begins[page + 1] - begins[page]);
        }
    };
    void pin(std::span<const PageNode> nodes);

    std::vector<uint32_t> sizes_bytes_;
    Lists needs_;
    Lists companions_;
    std::vector<bool> is_pinned_;
    std::vector<uint32_t> pinned_;
    uint64_t pinned_bytes_ = 0;
};

} // namespace hearth::pack
