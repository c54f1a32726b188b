// Computes poses: the effect of a scene's clips on its nodes and lights, as the format defines it (FORMAT.md,
// "Skins and animations"). The cooker bounds the results of these functions, the runtime draws them.
// glTF 2.0, 3.7.3.3 (skinning), 3.11 and appendix C (animation); KHR_animation_pointer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"
#include "formats/records/deformation.h"
#include "formats/records/scene.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::formats
{

class PackView;

/// Tables of a pack or a part from which poses are computed.
struct AnimationTables
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

/// Return the tables of a pack. They are valid as long as the pack.
AnimationTables animationTables(const PackView& pack);

using Quaternion = std::array<double, 4>; ///< x y z w

/// Transform of a node in its parent: translation * rotation * scale.
struct NodePose
{
    Double3 translation;
    Quaternion rotation{0, 0, 0, 1}; ///< unit
    Double3 scale{1, 1, 1};
};

/// Pose of all nodes. A node with only a matrix (has_trs = 0) keeps its matrix whatever its pose says.
struct ScenePose
{
    std::vector<NodePose> nodes;       ///< one for each node
    std::vector<double> morph_weights; ///< laid out as chunk MWGT
};

/// Return the pose without animation.
ScenePose restPose(const AnimationTables& tables);

/// Set all nodes and weights that the animation's channels move, and leave the rest. Allocates nothing.
/// time  seconds; clamped to the first and last key of each channel
/// pose  pose of these tables
void sampleAnimation(const AnimationTables& tables, const AnimationRecord& animation, double time,
                     ScenePose& pose);

/// Minimum range of a light that a clip changes, metres: a range of 0 would be an unlimited one.
inline constexpr float kMinAnimatedRange = 1e-3f;

/// Set the properties that the animation's channels change in its lights, and leave the rest. Values that a
/// spline takes out of their range are clamped. Allocates nothing.
/// time    as in sampleAnimation
/// lights  all lights of the pack
void sampleLights(const AnimationTables& tables, const AnimationRecord& animation, double time,
                  std::span<LightRecord> lights);

/// Blend colours, intensities, ranges and cones linearly; all else is that of `from`. Between an unlimited
/// range and another the range is unlimited. `result` may be one of the two inputs.
/// weight  0: `from`, 1: `to`
void blendLights(std::span<const LightRecord> from, std::span<const LightRecord> to, double weight,
                 std::span<LightRecord> result);

/// Blend node by node, in the space of their parents: translations, scales and morph weights linearly,
/// rotations along the shorter arc. Allocates nothing if `result` has been a pose of the same tables;
/// `result` may be one of the two inputs.
/// weight  0: `from`, 1: `to`
void blendPoses(const ScenePose& from, const ScenePose& to, double weight, ScenePose& result);

/// Return the nodes in an order in which each parent comes before its children.
std::vector<uint32_t> nodesParentsFirst(std::span<const NodeRecord> nodes);

/// Return for each node 1 where a clip moves the node or one of its ancestors.
/// parents_first  order of nodesParentsFirst
std::vector<uint8_t> findAnimatedNodes(const AnimationTables& tables,
                                       std::span<const uint32_t> parents_first);

/// Return the transform between a node and an object that it carries, from their transforms at rest: identity
/// where they coincide.
Affine3d nodeFromObject(const Affine3d& world_from_node, const Affine3& world_from_object);

/// Compute the world transform of every node. Allocates nothing.
/// parents_first    order of nodesParentsFirst
/// world_from_node  one for each node
void poseNodes(const AnimationTables& tables, const ScenePose& pose, std::span<const uint32_t> parents_first,
               std::span<Affine3d> world_from_node);

/// Return the frame of a deformed cluster in a pose: the transform from the space of its box to the world.
/// joints  the cluster's entries in chunk DJNT
Affine3d clusterFrame(std::span<const Affine3d> palette, const DeformedClusterRecord& cluster,
                      std::span<const uint32_t> joints);

/// Compute the matrix palette of a skin. Allocates nothing.
/// world_from_bind  one for each joint of the skin
void skinPalette(const AnimationTables& tables, const SkinRecord& skin,
                 std::span<const Affine3d> world_from_node, std::span<Affine3d> world_from_bind);

/// Interpolate between two rotations along the shorter arc; returns a unit quaternion.
Quaternion slerp(const Quaternion& from, const Quaternion& to, double weight);

} // namespace hearth::formats
