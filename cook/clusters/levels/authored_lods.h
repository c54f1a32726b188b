// Joins authored LODs (levels of detail by an artist) with their source in one mesh. See
// cook/clusters/README.md, "Authored LODs".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/error/attribute_error.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Triangles of an authored LOD, with the vertices of the prepared mesh.
struct AuthoredLod
{
    CornerVector<VertexId> corners;
    IdVector<TriangleId, uint32_t> materials;
    size_t authored = 0; ///< index of the authored mesh

    size_t triangleCount() const { return materials.size(); }
};

/// Source and authored LODs on one grid.
struct JoinedMesh
{
    PreparedMesh mesh; ///< with the vertices of all, and the triangles of the source
    std::vector<AuthoredLod> levels;
};

/// Put a source and its authored LODs on one grid. The LODs get the attributes of the source: additional ones
/// are dropped, and missing ones are 0, white, or computed from the normal. A LOD that has not fewer
/// triangles than the one before it, or than the source, is left out: it would cost more and show less.
JoinedMesh joinAuthored(mesh::SourceMesh source, std::span<const mesh::SourceMesh> authored,
                        uint32_t influences = 8, const MeshMotion* motion = nullptr);

/// Compare the attributes of an authored LOD with those of the source, whose triangles are `source_corners`.
/// Samples the centers of at most 131072 of these, evenly through their order, and the nearest points of the
/// LOD.
AttributeStep measureAttributes(const PreparedMesh& mesh, CornerSpan<const VertexId> source_corners,
                                const AuthoredLod& level);

/// Link each page to its parents where groups switch together. As in pages.h, but each group of a set needs
/// all pages that replace the set.
void linkPagesOfSets(Hierarchy& hierarchy);

} // namespace hearth::clusters
