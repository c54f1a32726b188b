// Triangles of one group as a separate mesh, near the origin and about one unit in size.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/attributes.h"
#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/core/index_types.h"
#include "cook/clusters/core/lanes.h"
#include "formats/base/math.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Mesh of a group. A wedge is a vertex together with a material: where wedges of one position differ,
/// attributes or material are discontinuous.
struct GroupMesh
{
    double center[3] = {}; ///< local = (object - center) / scale
    double scale = 1;
    IdVector<PositionId, Float3> positions; ///< local
    IdVector<PositionId, uint8_t> locked;   ///< 1 for positions that must not move
    IdVector<WedgeId, VertexId> vertex_of_wedge;
    IdVector<WedgeId, PositionId> position_id_of_wedge;
    /// First wedge of each chart: the same for wedges of a position that differ only in the normal.
    IdVector<WedgeId, WedgeId> chart_of_wedge;
    CornerVector<WedgeId> corners;
    IdVector<TriangleId, uint32_t> materials;
    double grid_step = 0; ///< object space
    Box3 mesh_box;        ///< of the whole source, object space
    float uv_length = 0;  ///< local length of one unit of UV; 0 where that is no useful number
    AttributeWeights weights;
    /// Remaining positions must not move: morph deltas of other positions are unknown.
    bool positions_fixed = false;
    IdVector<TriangleId, float> errors; ///< distance of each triangle to the source, local
    uint32_t attribute_count = 0;       ///< attributes of a wedge
    uint32_t attribute_rows = 0;        ///< rows of four attributes of a wedge
    std::vector<Lanes> attributes;      ///< rows of each wedge, weighted: differences are local lengths

    size_t triangleCount() const { return corners.triangleCount(); }

    /// Return the first of a wedge's rows of attributes.
    size_t firstRow(WedgeId wedge) const { return size_t{toIndex(wedge)} * attribute_rows; }
    const Lanes* wedgeAttributes(WedgeId wedge) const { return attributes.data() + firstRow(wedge); }

    PositionId positionIdAt(CornerId corner) const { return position_id_of_wedge[corners[corner]]; }

    /// Return the local positions of a triangle's corners.
    std::array<Float3, 3> trianglePositions(TriangleId triangle) const
    {
        const auto [a, b, c] = corners.triangle(triangle);
        return {positions[position_id_of_wedge[a]], positions[position_id_of_wedge[b]],
                positions[position_id_of_wedge[c]]};
    }
};

/// Target wedge for a wedge whose position is removed.
struct WedgeMove
{
    WedgeId from;
    WedgeId to;
};

/// Collect the clusters of a group.
///
/// members  clusters of `store`, at least one
/// locked   1 for positions that must not move
GroupMesh gatherGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const ClusterId> members,
                      IdSpan<MeshPositionId, const uint8_t> locked, const Config& config);

/// Return the position ids of corners, given their wedges.
CornerVector<PositionId> gatherPositionIds(const GroupMesh& group, CornerSpan<const WedgeId> wedges);

/// Mark open positions: 1 for each position whose triangles do not close around it. Collapses preserve it:
/// borders only shorten along themselves.
IdVector<PositionId, uint8_t> markOpenPositions(const GroupMesh& group);

} // namespace hearth::clusters
