// Lays clusters out in pages: whole groups, coarse to fine. See cook/clusters/README.md, "Pages".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"

#include <span>

namespace hearth::clusters
{

/// Put the groups, in their order, into pages, each page filled before the next is begun; write the vertex and index
/// data as PageCodec::clusters, and link each page to those that it refines. The same bytes for any number of threads.
///
/// hierarchy  groups and clusters say how they belong together; bounds, counts and pages of clusters, the pages of groups,
///            the layout and the grid of the mesh are filled here with the page tables
/// shapes     the geometry of each of hierarchy's clusters, in `store`
void buildPages(const PreparedMesh& mesh, const ClusterStore& store, std::span<const ClusterShape> shapes,
                const Config& config, Hierarchy& hierarchy);

} // namespace hearth::clusters
