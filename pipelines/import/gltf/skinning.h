// Joint weights of vertices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::import
{

enum class InfluenceRepair
{
    none,    ///< at most rounding errors were taken out
    sum,     ///< some weights did not sum to 1
    invalid, ///< some were negative, not finite, or all zero
};

/// Make the weights of every vertex sum to 1 over all sets. Where there is nothing to scale, joint 0 gets it all;
/// a joint without weight becomes joint 0, as exporters leave anything there.
InfluenceRepair normalizeInfluences(mesh::SourceMesh& mesh);

/// For each joint up to the largest that moves a vertex, whether it moves one.
std::vector<bool> usedJoints(const mesh::SourceMesh& mesh);

} // namespace hearth::import
