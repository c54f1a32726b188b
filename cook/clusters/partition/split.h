// Splits triangles into clusters of at most 128 triangles: full, compact, of one material. See
// cook/clusters/README.md, "Splitting".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Triangle as the splitter sees it: its center and its id. Triangles with equal centers stay together where
/// the counts allow it.
struct SplitItem
{
    Float3 center;
    TriangleId triangle;
};

/// Input of the splitter.
struct SplitTriangles
{
    CornerSpan<const VertexId> corners;
    IdSpan<TriangleId, const float> errors; ///< as in ClusterStore
    uint32_t material;
    uint32_t vertex_limit = formats::kMaxClusterVertices; ///< for each cluster: clusterVertexLimit
};

/// Split top-down: cut where the surface-area cost is minimal, at multiples of a full cluster, so that all
/// clusters but one are full. A cluster with more vertices than the limit is cut again. Reorders `items`;
/// deterministic for any order of items with different triangles.
///
/// items      of one material; centers finite
/// triangles  the triangles that the items refer to
/// out        receives the clusters, in the order of the tree's leaves
void splitIntoClusters(std::span<SplitItem> items, const SplitTriangles& triangles, ClusterStore& out);

/// Split the whole mesh into clusters, material by material, in parallel.
ClusterStore splitMesh(const PreparedMesh& mesh);

} // namespace hearth::clusters
