// Measures the errors of normals and UVs after simplification. See
// cook/clusters/README.md, "Normals and UVs".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_points.h"
#include "cook/mesh/source_mesh.h"

namespace hearth::clusters
{

/// Root mean square errors over a surface. They are measured at vertices: not bounds.
struct AttributeError
{
    float normal = 0; ///< radians
    float uv = 0;     ///< first UV set, object space: the difference as a length on the surface
};

/// Attribute error that one simplification adds.
struct AttributeStep
{
    AttributeError error;
    float edge_length = 0; ///< object space, root mean square over the new triangles
};

/// Simplified group with its vertices: new ones are those of `made`, others the mesh's.
struct NewSurface
{
    const SimplifiedGroup& simplified;
    const Surface& surface;
    /// For each wedge that was removed or moved, its point on the surface.
    IdSpan<WedgeId, const TrianglePoint> points;
    const mesh::SourceMesh& mesh;
    const mesh::SourceMesh& made;
    IdSpan<WedgeId, const VertexId> vertex_of_wedge;
};

/// Compare the attributes of the group's vertices with those at the nearest points of the new surface around
/// their positions' targets. Differences count as linear over the group's triangles; pruned triangles are
/// left out.
AttributeStep measureAttributes(const GroupMesh& group, const NewSurface& after);

/// Return the angle between two unit vectors from the length of their difference, from 0 to pi. Avoids
/// functions that round differently from one machine to the next.
double angleFromChord(double chord);

} // namespace hearth::clusters
