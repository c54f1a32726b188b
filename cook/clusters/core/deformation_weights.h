// How much joints and morph targets count when a group is simplified.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"

namespace hearth::clusters
{

/// Choose the joints and morph targets of group.weights. A joint's weight counts by how far the joint moves the group's
/// vertices against the main joint, that with the most weight.
///
/// group   its vertices and their local places are there
void weighDeformation(const PreparedMesh& mesh, GroupMesh& group);

} // namespace hearth::clusters
