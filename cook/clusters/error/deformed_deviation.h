// How far a simplified group of a deformed mesh lies from the source in any pose, as a bound. See cook/clusters/README.md, "Deformed
// meshes".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/error/deformation_metric.h"
#include "cook/clusters/error/deviation.h"

namespace hearth::clusters
{

/// The vertices of a simplified group: those of `mesh`, and from kMadeVertex on those of `made`.
struct SimplifiedVertices
{
    const mesh::SourceMesh& mesh;
    const mesh::SourceMesh& made;
    std::span<const uint32_t> vertex_of_wedge;
};

/// As boundDeviation, over all poses: errors are for a scale of 1 of the joints' transforms. Each triangle that is gone,
/// changed or new is held against triangles of the other surface near it; the one that bounds it best in parts serves.
/// An error is infinite where no joint can be divided by (motion::SkinMotion::relative).
Deviation boundDeformedDeviation(const GroupMesh& group, const Simplified& simplified, const Surface& after,
                                 const SimplifiedVertices& vertices, const MeshMotion& motion);

/// How far two surfaces of a deformed mesh are from each other in any pose, both ways, in object space: for levels that
/// were made by hand. Of each triangle the facets nearest to a few of its points serve, so that the bound may be loose where
/// the surfaces are far apart.
/// source, level  three vertices of the mesh for each triangle, at least one each
double boundDeformedSurfaces(const PreparedMesh& mesh, std::span<const uint32_t> source,
                             std::span<const uint32_t> level);

/// What moves the mesh; where nobody says, nothing but its morph targets.
const MeshMotion& motionOf(const PreparedMesh& mesh);

} // namespace hearth::clusters
