// Bounds of a mesh's vertices that joints or nodes move; kept after the mesh is written to the part's file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "cook/mesh/source_mesh.h"

#include <vector>

namespace hearth::import
{

struct MovedVertices
{
    motion::Box3d box;                   ///< of the bind pose, object space
    std::vector<motion::Box3d> of_joint; ///< for each joint, of its vertices; empty without a skin
    std::vector<double> morph_distances; ///< for each target, its longest displacement at weight 1
};

MovedVertices movedVertices(const mesh::SourceMesh& mesh);

/// Merge the bounds of a level of detail, moved by the same joints and weights, into the bounds of its mesh.
void add(MovedVertices& vertices, const MovedVertices& of_level);

} // namespace hearth::import
