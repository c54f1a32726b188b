// Bounds of a mesh's vertices that joints or nodes move; kept after the mesh is written to the part's file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "cook/mesh/source_mesh.h"

#include <vector>

namespace hearth::import
{

struct VertexBounds
{
    animation_bounds::Box3d box; ///< of the bind pose, object space
    std::vector<animation_bounds::Box3d>
        joint_boxes;                     ///< for each joint, of its vertices; empty without a skin
    std::vector<double> morph_distances; ///< for each target, its longest displacement at weight 1
};

VertexBounds computeVertexBounds(const mesh::SourceMesh& mesh);

/// Merge the bounds of a level of detail, moved by the same joints and weights, into the bounds of its mesh.
void add(VertexBounds& vertices, const VertexBounds& level_bounds);

} // namespace hearth::import
