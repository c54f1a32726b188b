// Where the vertices of a mesh are that joints or nodes move: what is kept of it once it is in the part's file.
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
    std::vector<motion::Box3d> of_joint; ///< those of them that each joint moves; none without a skin
    std::vector<double> morph_distances; ///< of each target: how far it moves any vertex with the weight 1
};

MovedVertices movedVertices(const mesh::SourceMesh& mesh);

/// Those of a level of detail, which the same joints and weights move, beside those of its mesh.
void add(MovedVertices& vertices, const MovedVertices& of_level);

} // namespace hearth::import
