// Checks that a cut of a mesh's hierarchy is a surface without cracks and overlap, by two independent proofs:
// one follows the hierarchy, the other only uses triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/pack_geometry.h"

namespace hearth::reference
{

struct CoverageReport
{
    uint32_t source_clusters = 0;
    uint32_t missing = 0;     ///< clusters of level 0 with a path to the root that has no drawn cluster
    uint32_t overlapping = 0; ///< clusters of level 0 with a path that has two or more
    bool ok() const { return missing == 0 && overlapping == 0; }
};

/// Follow every path from every cluster of level 0 to the root: exactly one cluster on it must be drawn.
/// `cut`: clusters of `mesh`, in any order.
CoverageReport checkCoverage(const formats::PackView& view, uint32_t mesh, std::span<const uint32_t> cut);

struct EdgeReport
{
    uint64_t edges = 0;        ///< edges of the cut, between welded positions
    uint64_t open_edges = 0;   ///< edges used more often in one direction than in the other
    uint64_t cracks = 0;       ///< open edges that do not lie along open edges of the source
    double worst_distance = 0; ///< metres; from an open edge's ends to the source's open edges
};

using Triangles = std::vector<std::array<Float3, 3>>;

/// Weld corners by their bits and count each edge in both directions. An open edge of the cut is a crack
/// unless both its ends are within `tolerance` of an open edge of the source: a simplified border may move by
/// its reported error.
EdgeReport checkEdges(const Triangles& cut, const Triangles& source, double tolerance);

/// Triangles of the clusters, in order.
Triangles trianglesOfClusters(const PackGeometry& geometry, std::span<const uint32_t> clusters);

/// Six times the signed volume under the triangles, about the origin.
double signedVolume6(const Triangles& triangles);

} // namespace hearth::reference
