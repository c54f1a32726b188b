// Transforms of single nodes at rest, without a player for the whole scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"
#include "formats/pack/pack_view.h"

namespace hearth::pack
{

/// Return the transform of a node in its parent at rest.
Affine3d parentFromNode(const formats::NodeRecord& node);

/// Return the transform of a node in the world at rest. Time: linear in its depth.
/// node  of the tables of a checked pack
Affine3d worldFromNode(std::span<const formats::NodeRecord> nodes, uint32_t node);

/// Return the joint of the same skin whose node is the nearest one above the joint's; kInvalidIndex if there
/// is none. Time: linear in the node's depth times the skin's joints.
/// joint  index in the pack's joints; of a checked pack
uint32_t findParentJoint(const formats::PackView& pack, uint32_t joint);

} // namespace hearth::pack
