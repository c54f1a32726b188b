// The triangles of one group as a small mesh of its own, near the origin and about one unit in size.
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

/// A wedge is a vertex together with a material: where wedges of one position differ, attributes or material jump.
struct GroupMesh
{
    double center[3] = {}; ///< local = (object - center) / scale
    double scale = 1;
    std::vector<Float3> positions;           ///< local, for each position
    std::vector<uint8_t> locked;             ///< for each position
    std::vector<uint32_t> global_position;   ///< for each position, that of the prepared mesh
    std::vector<uint32_t> vertex_of_wedge;   ///< vertex of the prepared mesh
    std::vector<uint32_t> position_of_wedge; ///< position of this mesh
    std::vector<uint32_t> chart_of_wedge;    ///< one number for wedges that differ in the normal alone
    std::vector<uint32_t> corners;           ///< three wedges for each triangle
    std::vector<uint32_t> materials;         ///< for each triangle
    double grid_step = 0;                    ///< object space
    float uv_length = 0; ///< local length of one unit of UV; 0 where that is no useful number
    AttributeWeights weights;
    bool keeps_places =
        false; ///< what is left stays where it was: morph deltas of other places are not known
    std::vector<float> errors;     ///< for each triangle: its distance from the source, local
    uint32_t attribute_count = 0;  ///< that a wedge has
    uint32_t attribute_rows = 0;   ///< rows of four attributes that a wedge has
    std::vector<Lanes> attributes; ///< rows of each wedge, weighted: differences are local lengths

    size_t triangleCount() const { return corners.size() / 3; }
    const Lanes* attributesOf(uint32_t wedge) const
    {
        return attributes.data() + size_t{wedge} * attribute_rows;
    }
    uint32_t positionAt(size_t corner) const { return position_of_wedge[corners[corner]]; }
};

/// Where a wedge of a position that is removed goes.
struct WedgeMove
{
    uint32_t from;
    uint32_t to;
};

/// Collect the clusters of a group.
GroupMesh gatherGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint32_t> members,
                      std::span<const uint8_t> locked, const Config& config);

/// The positions of some of the group's wedges.
std::vector<uint32_t> positionsOfCorners(const GroupMesh& group, std::span<const uint32_t> wedges);

/// For each position, 1 where the triangles do not close around it. Collapses keep it so: borders only shorten along
/// themselves.
std::vector<uint8_t> openPositions(const GroupMesh& group);

} // namespace hearth::clusters
