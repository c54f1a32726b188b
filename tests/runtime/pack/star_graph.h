// Makes graphs of pages in which all others need the first.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/page_graph.h"

#include <vector>

namespace hearth::test
{

/// Return a graph of one pinned node, and of `count` nodes of one size that need it.
inline pack::PageGraph makeStarGraph(uint32_t pinned_bytes, uint32_t node_bytes, uint32_t count)
{
    std::vector<pack::PageNode> nodes(count + 1);
    nodes[0] = {.size_bytes = pinned_bytes, .holds_root = true, .needs = {}, .companions = {}};
    for (uint32_t i = 1; i <= count; ++i)
        nodes[i] = {.size_bytes = node_bytes, .holds_root = false, .needs = {0}, .companions = {}};
    return pack::PageGraph(nodes);
}

} // namespace hearth::test
