// Checks and repairs the joint weights of vertices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::import
{

enum class InfluenceRepair
{
    none,    ///< removed rounding errors at most
    sum,     ///< some weights did not sum to 1
    invalid, ///< some were negative, not finite, or all zero
};

/// Scale the weights of every vertex to sum to 1 over all sets. If no weight is usable, joint 0 gets weight
/// 1. A joint without weight becomes joint 0, because exporters leave arbitrary values there.
InfluenceRepair normalizeInfluences(mesh::SourceMesh& mesh);

/// Return a flag for each joint up to the largest that moves a vertex: true if the joint moves a vertex.
std::vector<bool> usedJoints(const mesh::SourceMesh& mesh);

} // namespace hearth::import
