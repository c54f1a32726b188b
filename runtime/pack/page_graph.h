// Dependency graph of the pages of a pack, with their sizes, for streaming. See runtime/pack/README.md,
// "Streaming".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// Input record of one page for the construction of a graph.
struct PageNode
{
    uint32_t size_bytes = 0; ///< decoded size
    bool holds_root = false; ///< true if it has a root group, which no coarser group replaces
    /// Dependencies: pages without which this page must not be resident; all before this one, each once.
    std::vector<uint32_t> needs;
    /// Companions: pages that are requested together with this one; all after it, each once.
    std::vector<uint32_t> companions;
};

/// Page sizes and dependencies. A set of pages is closed if it has, with each page, all pages that this page
/// needs. Only closed sets may be resident, since only then the cut covers each surface once.
class PageGraph
{
public:
    /// Build the graph; the order of the nodes is asserted.
    explicit PageGraph(std::span<const PageNode> nodes);

    /// Build the graph of a view that has passed the checker. A page needs its parents. If a set of groups
    /// (GroupRecord) spans several pages, each page that refines the set needs all of its pages, and these
    /// are companions of the set's first page.
    static PageGraph of(const formats::PackView& view);

    /// Return the same graph in which each page that is not pinned takes a slot of `slot_bytes`, >= its size
    /// (asserted).
    PageGraph withSlotSize(uint32_t slot_bytes) const;

    uint32_t pageCount() const { return static_cast<uint32_t>(sizes_bytes_.size()); }
    uint32_t sizeBytes(uint32_t page) const { return sizes_bytes_[page]; }
    std::span<const uint32_t> needs(uint32_t page) const { return needs_.of(page); }
    std::span<const uint32_t> companions(uint32_t page) const { return companions_.of(page); }

    /// Return the pages that are always resident, ascending: the pages with roots and the pages that they
    /// need.
    std::span<const uint32_t> pinned() const { return pinned_; }
    bool isPinned(uint32_t page) const { return is_pinned_[page]; }
    uint64_t pinnedBytes() const { return pinned_bytes_; }
    uint64_t streamedBytes() const; ///< of the other pages

private:
    /// A list of pages for each page.
    struct PageLists
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
    PageLists needs_;
    PageLists companions_;
    std::vector<bool> is_pinned_;
    std::vector<uint32_t> pinned_;
    uint64_t pinned_bytes_ = 0;
};

} // namespace hearth::pack
