// Bounds the distance of a simplified group of a deformed mesh to the source over all poses. See
// cook/clusters/README.md, "Deformed meshes".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/error/deformation_metric.h"
#include "cook/clusters/error/deviation.h"

namespace hearth::clusters
{

/// Vertices of a simplified group: new ones are those of `made`, others the mesh's.
struct SimplifiedVertices
{
    const mesh::SourceMesh& mesh;
    const mesh::SourceMesh& made;
    IdSpan<WedgeId, const VertexId> vertex_of_wedge;
};

/// Bound the deviation like boundDeviation, over all poses: errors are for a scale of 1 of the joints'
/// transforms. Each removed, changed or new triangle is compared with triangles of the other surface near it;
/// the one that bounds it best counts, piece by piece. An error is infinite if no joint can be the main one
/// (animation_bounds::SkinMotion::relative).
Deviation boundDeformedDeviation(const GroupMesh& group, const SimplifiedGroup& simplified,
                                 const Surface& after, const SimplifiedVertices& vertices,
                                 const MeshMotion& motion);

/// Bound the two-sided distance of two surfaces of a deformed mesh over all poses, in object space: for
/// authored LODs. Compares each triangle with the triangles nearest to a few of its points, so the bound may
/// be loose where the surfaces are far apart.
/// source, level  vertices of the mesh, of at least one triangle each
double boundDeformedSurfaces(const PreparedMesh& mesh, CornerSpan<const VertexId> source,
                             CornerSpan<const VertexId> level);

/// Return the mesh's motion; if it is unknown, only morph targets move it.
const MeshMotion& meshMotion(const PreparedMesh& mesh);

} // namespace hearth::clusters
