// Packs clusters into pages: whole groups, coarse to fine. See cook/clusters/README.md, "Pages".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"

#include <span>

namespace hearth::clusters
{

/// Put the groups, in order, into pages, and fill each page before the next. Write the vertex and index data
/// as PageCodec::clusters, and link each page to its parents, the pages that it refines. The same bytes for
/// any number of threads.
///
/// hierarchy  with the relations of groups and clusters; this function sets bounds, counts and pages of
///            clusters, pages of groups, the layout and grid of the mesh, and the page tables
/// shapes     geometry of each of hierarchy's clusters, in `store`
void buildPages(const PreparedMesh& mesh, const ClusterStore& store, std::span<const ClusterShape> shapes,
                const Config& config, Hierarchy& hierarchy);

} // namespace hearth::clusters
