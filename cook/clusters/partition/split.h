// Cuts triangles into clusters: full, compact, of one material. See cook/clusters/README.md, "Splitting".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// A triangle as the splitter sees it: where it is and what it uses. Triangles with equal centers stay together
/// where the counts allow it.
struct SplitItem
{
    Float3 center;
    uint32_t triangle;
};

/// What the splitter hands on.
struct SplitTriangles
{
    std::span<const uint32_t> corners; ///< three vertices for each triangle
    std::span<const float> errors;     ///< for each triangle, as in ClusterStore
    uint32_t material;
    uint32_t vertex_limit = formats::kClusterMaxVertices; ///< of a cluster: clusterVertexLimit
};

/// Top-down: cut where the surface-area cost is least, at multiples of a full cluster, so that all clusters but one
/// are full. A cluster that would need more vertices than their limit is cut again.
/// Reorders `items`; deterministic for any order of items with different triangles.
///
/// items      of one material; centers finite
/// triangles  those that the items name
/// out        gets the clusters, in the order of the tree's leaves
void splitIntoClusters(std::span<SplitItem> items, const SplitTriangles& triangles, ClusterStore& out);

/// Clusters of the whole mesh, material by material, in parallel.
ClusterStore splitMesh(const PreparedMesh& mesh);

} // namespace hearth::clusters
