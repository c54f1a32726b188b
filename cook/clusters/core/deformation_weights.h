// Weighs joints and morph targets for the simplification of a group.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"

namespace hearth::clusters
{

/// Choose the joints and morph targets of group.weights. A joint's weight counts by the distance that the
/// joint moves the group's vertices relative to the main joint, the one with the most weight.
///
/// group   with its vertices and local positions
void chooseDeformationWeights(const PreparedMesh& mesh, GroupMesh& group);

} // namespace hearth::clusters
