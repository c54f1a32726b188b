// How far normals and UVs lie from those that they stand for, as measured. See cook/clusters/README.md, "Normals and UVs".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_points.h"
#include "cook/mesh/source_mesh.h"

#include <cstdint>
#include <span>

namespace hearth::clusters
{

/// Root mean squares over a surface. They are measured at vertices: no bounds.
struct AttributeError
{
    float normal = 0; ///< radians
    float uv = 0;     ///< of the first set, object space: the difference as a length on the surface
};

/// What one simplification adds.
struct AttributeStep
{
    AttributeError error;
    float edge_length = 0; ///< object space, root mean square over the new triangles
};

/// A simplified group with its vertices: kMadeVertex + i is number i of `made`, others are the mesh's.
struct NewSurface
{
    const Simplified& simplified;
    const Surface& surface;
    std::span<const FacetPoint> points; ///< for each wedge, if it went or moved: where it lies on the surface
    const mesh::SourceMesh& mesh;
    const mesh::SourceMesh& made;
    std::span<const uint32_t> vertex_of_wedge;
};

/// Compare the attributes of the group's vertices with those at the nearest points of the
/// new surface around where their positions went. Differences count as linear over the group's triangles; what was
/// pruned is left out.
AttributeStep measureAttributes(const GroupMesh& group, const NewSurface& after);

/// The angle between two unit vectors whose difference has this length, from 0 to pi; without functions that round
/// differently from one machine to the next.
double angleOfChord(double chord);

} // namespace hearth::clusters
