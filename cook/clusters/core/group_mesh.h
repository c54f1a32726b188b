// Triangles of one group as a separate mesh, near the origin and about one unit in size.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/attributes.h"
#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/core/lanes.h"
#include "formats/base/math.h"

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
    std::vector<Float3> positions;              ///< local position of each position id
    std::vector<uint8_t> locked;                ///< for each position id
    std::vector<uint32_t> global_position_id;   ///< position id of the prepared mesh, for each position id
    std::vector<uint32_t> vertex_of_wedge;      ///< vertex id of the prepared mesh
    std::vector<uint32_t> position_id_of_wedge; ///< position id of this mesh
    std::vector<uint32_t> chart_of_wedge;       ///< the same id for wedges that differ only in the normal
    std::vector<uint32_t> corners;              ///< three wedges for each triangle
    std::vector<uint32_t> materials;            ///< for each triangle
    double grid_step = 0;                       ///< object space
    float uv_length = 0; ///< local length of one unit of UV; 0 where that is no useful number
    AttributeWeights weights;
    /// Remaining positions must not move: morph deltas of other positions are unknown.
    bool positions_fixed = false;
    std::vector<float> errors;     ///< distance of each triangle to the source, local
    uint32_t attribute_count = 0;  ///< attributes of a wedge
    uint32_t attribute_rows = 0;   ///< rows of four attributes of a wedge
    std::vector<Lanes> attributes; ///< rows of each wedge, weighted: differences are local lengths

    size_t triangleCount() const { return corners.size() / 3; }
    const Lanes* wedgeAttributes(uint32_t wedge) const
    {
        return attributes.data() + size_t{wedge} * attribute_rows;
    }
    uint32_t positionIdAt(size_t corner) const { return position_id_of_wedge[corners[corner]]; }
};

/// Target wedge for a wedge whose position is removed.
struct WedgeMove
{
    uint32_t from;
    uint32_t to;
};

/// Collect the clusters of a group.
GroupMesh gatherGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint32_t> members,
                      std::span<const uint8_t> locked, const Config& config);

/// Return the position ids of wedges.
std::vector<uint32_t> gatherPositionIds(const GroupMesh& group, std::span<const uint32_t> wedges);

/// Mark open positions: 1 for each position whose triangles do not close around it. Collapses preserve it:
/// borders only shorten along themselves.
std::vector<uint8_t> markOpenPositions(const GroupMesh& group);

} // namespace hearth::clusters
