// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/page_graph.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace hearth::pack
{

using namespace formats;

namespace
{

using PagesOfSets = std::vector<std::vector<uint32_t>>;

uint32_t firstOfSet(const PackView& view, uint32_t group)
{
    return group - view.groups()[group].set_offset;
}

/// Return the pages of each set of groups, ascending, by the index of its first group; a single group is a
/// set.
PagesOfSets listPagesOfSets(const PackView& view)
{
    PagesOfSets pages_of_set(view.groups().size());
    for (uint32_t group = 0; group < pages_of_set.size(); ++group)
    {
        std::vector<uint32_t>& pages = pages_of_set[firstOfSet(view, group)];
        if (pages.empty() || pages.back() != view.groups()[group].page)
            pages.push_back(view.groups()[group].page);
    }
    return pages_of_set;
}

void sortUnique(auto& items)
{
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Make the pages that refine a set of several pages need all pages of the set: the clusters of a set are
/// drawn all or none.
void addSetDependencies(const PackView& view, const PagesOfSets& pages_of_set, std::vector<PageNode>& nodes)
{
    // pairs (finer, coarser) of first groups: few, where sets are large
    std::vector<std::pair<uint32_t, uint32_t>> refinements;
    for (const ClusterRecord& cluster : view.clusters())
    {
        const uint32_t coarser = firstOfSet(view, cluster.group);
        if (cluster.refined_group != kInvalidIndex && pages_of_set[coarser].size() > 1)
            refinements.emplace_back(cluster.refined_group, coarser);
    }
    sortUnique(refinements);
    for (const auto& [finer, coarser] : refinements)
        for (const uint32_t page : pages_of_set[finer])
            for (const uint32_t needed : pages_of_set[coarser])
                if (needed != page)
                    nodes[page].needs.push_back(needed);
    for (PageNode& node : nodes)
        sortUnique(node.needs);
}

void requestWholeSets(const PagesOfSets& pages_of_set, std::vector<PageNode>& nodes)
{
    for (const std::vector<uint32_t>& pages : pages_of_set)
        if (pages.size() > 1)
        {
            std::vector<uint32_t>& companions = nodes[pages.front()].companions;
            companions.insert(companions.end(), pages.begin() + 1, pages.end());
        }
    for (PageNode& node : nodes)
        sortUnique(node.companions);
}

} // namespace

void PageGraph::PageLists::append(std::span<const uint32_t> list)
{
    items.insert(items.end(), list.begin(), list.end());
    begins.push_back(static_cast<uint32_t>(items.size()));
}

PageGraph::PageGraph(std::span<const PageNode> nodes) : is_pinned_(nodes.size(), false)
{
    for (uint32_t page = 0; page < nodes.size(); ++page)
    {
        const PageNode& node = nodes[page];
        HEARTH_ASSERT(
            std::all_of(node.needs.begin(), node.needs.end(), [&](uint32_t p) { return p < page; }));
        HEARTH_ASSERT(std::all_of(node.companions.begin(), node.companions.end(),
                                  [&](uint32_t p) { return p > page && p < nodes.size(); }));
        sizes_bytes_.push_back(node.size_bytes);
        needs_.append(node.needs);
        companions_.append(node.companions);
    }
    pin(nodes);
}

void PageGraph::pin(std::span<const PageNode> nodes)
{
    // the pages that a page needs come before it
    for (uint32_t page = pageCount(); page-- > 0;)
    {
        if (nodes[page].holds_root)
            is_pinned_[page] = true;
        if (is_pinned_[page])
            for (const uint32_t needed : needs(page))
                is_pinned_[needed] = true;
    }
    for (uint32_t page = 0; page < pageCount(); ++page)
        if (is_pinned_[page])
        {
            pinned_.push_back(page);
            pinned_bytes_ += sizeBytes(page);
        }
}

PageGraph PageGraph::of(const PackView& view)
{
    std::vector<PageNode> nodes(view.pages().size());
    for (size_t i = 0; i < nodes.size(); ++i)
    {
        const auto parents = recordsInRange(view.pageParents(), view.pages()[i].parents);
        nodes[i].size_bytes = view.pages()[i].size;
        nodes[i].needs.assign(parents.begin(), parents.end());
    }
    for (const GroupRecord& group : view.groups())
        if (group.error == std::numeric_limits<float>::infinity())
            nodes[group.page].holds_root = true;
    const PagesOfSets pages_of_set = listPagesOfSets(view);
    addSetDependencies(view, pages_of_set, nodes);
    requestWholeSets(pages_of_set, nodes);
    return PageGraph(nodes);
}

uint64_t PageGraph::streamedBytes() const
{
    return std::accumulate(sizes_bytes_.begin(), sizes_bytes_.end(), uint64_t{0}) - pinned_bytes_;
}

PageGraph PageGraph::withSlotSize(uint32_t slot_bytes) const
{
    PageGraph graph = *this;
    for (uint32_t page = 0; page < pageCount(); ++page)
        if (!isPinned(page))
        {
            HEARTH_ASSERT(sizeBytes(page) <= slot_bytes);
            graph.sizes_bytes_[page] = slot_bytes;
        }
    return graph;
}

} // namespace hearth::pack
