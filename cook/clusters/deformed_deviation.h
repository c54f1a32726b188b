// How far a simplified group of a deformed mesh lies from the source in any pose, as a bound. See README.md, "Deformed
// meshes".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/deformation_metric.h"
#include "cook/clusters/deviation.h"

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

} // namespace hearth::clusters
