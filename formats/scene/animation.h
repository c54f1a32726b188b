// Poses: what a scene's clips do to its nodes, as the format defines it (FORMAT.md, "Skins and animations"). The cooker
// bounds what these functions give, the runtime draws it.
// glTF 2.0, 3.7.3.3 (skinning), 3.11 and appendix C (animation).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"
#include "formats/records/scene.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::formats
{

class PackView;

/// The tables that poses are made of, of a pack or a part.
struct MotionTables
{
    std::span<const NodeRecord> nodes;
    std::span<const SkinRecord> skins;
    std::span<const JointRecord> joints;
    std::span<const AnimationRecord> animations;
    std::span<const AnimationChannelRecord> channels;
    std::span<const float> keys;
    std::span<const float> morph_weights;
    std::span<const uint32_t> key_bits;
};

/// They hold as long as the pack.
MotionTables motionTables(const PackView& pack);

using Quaternion = std::array<double, 4>; ///< x y z w

/// A node in its parent: translation * rotation * scale.
struct NodePose
{
    Double3 translation;
    Quaternion rotation{0, 0, 0, 1}; ///< of length 1
    Double3 scale{1, 1, 1};
};

/// All nodes in one pose. What has a matrix alone (has_trs = 0) stays where it is, whatever stands here.
struct ScenePose
{
    std::vector<NodePose> nodes;       ///< one for each node
    std::vector<double> morph_weights; ///< laid out as chunk MWGT
};

/// How the nodes stand without animation.
ScenePose restPose(const MotionTables& tables);

/// Set what the animation's channels move, and leave the rest. Allocates nothing.
/// time  seconds; before the first and after the last key of a channel, its value there holds
/// pose  of these tables
void sampleAnimation(const MotionTables& tables, const AnimationRecord& animation, double time,
                     ScenePose& pose);

/// Blend node by node, in the space of their parents: translations, scales and morph weights on the straight line,
/// rotations along the shorter arc. Allocates nothing where `result` has been a pose of the same tables; it may be one
/// of the two.
/// weight  0: `from`, 1: `to`
void blendPoses(const ScenePose& from, const ScenePose& to, double weight, ScenePose& result);

/// The nodes, each behind its parent.
std::vector<uint32_t> parentsFirst(std::span<const NodeRecord> nodes);

/// Where a pose puts every node. Allocates nothing.
/// parents_first    of parentsFirst
/// world_from_node  one for each node
void poseNodes(const MotionTables& tables, const ScenePose& pose, std::span<const uint32_t> parents_first,
               std::span<Affine3d> world_from_node);

/// Where the joints of a skin carry what is bound to them. Allocates nothing.
/// world_from_bind  one for each joint of the skin
void skinPalette(const MotionTables& tables, const SkinRecord& skin,
                 std::span<const Affine3d> world_from_node, std::span<Affine3d> world_from_bind);

/// Along the shorter arc between two rotations, as a unit quaternion.
Quaternion slerp(const Quaternion& from, const Quaternion& to, double weight);

} // namespace hearth::formats
