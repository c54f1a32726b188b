// Generates a mannequin: a skeleton of seventeen joints, a skin around tapered capsules, and two clips.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

enum Joint : uint32_t
{
    kHips,
    kSpine,
    kChest,
    kNeck,
    kHead,
    kLeftUpperArm,
    kLeftForearm,
    kLeftHand,
    kRightUpperArm,
    kRightForearm,
    kRightHand,
    kLeftThigh,
    kLeftShin,
    kLeftFoot,
    kRightThigh,
    kRightShin,
    kRightFoot,
    kJointCount,
};

/// Local rotations of all joints and the position of the hips. Without rotation the arms point along +-X and
/// the character looks along +Z; left is +X.
struct Pose
{
    Float3 hips{0, 0.93f, 0};
    std::array<Float4, kJointCount> rotations;

    Pose() { rotations.fill({0, 0, 0, 1}); }
};

Pose standingPose();
/// Return a pose on a seat 0.42 m high, hands held towards something warm in front.
Pose sittingPose();

struct CharacterNodes
{
    int root;                            ///< root node; set its placement
    std::array<int, kJointCount> joints; ///< joint nodes
};

/// Return the pose between a and b.
Pose blendPoses(const Pose& a, const Pose& b, float share);
/// Return a pose of walking on the spot; share of the cycle: 0 to 1.
Pose walkingPose(const Pose& standing, float cycle);

/// Add nodes, skin, mesh and material.
/// rest  pose of the nodes
/// bind  pose that the skin is generated in: it deforms best near it
/// cell  size in metres of the grid on which the skin is sampled: about 1.6 / cell^2 triangles
CharacterNodes addCharacter(Document& document, const Pose& rest, const Pose& bind, float cell);

/// Add one second of walking on the spot; linear rotations, the path of the hips is a cubic spline.
void addWalkClip(Document& document, const CharacterNodes& nodes, const Pose& pose);
/// Add five seconds of standing and breathing.
void addIdleClip(Document& document, const CharacterNodes& nodes, const Pose& pose);
/// Add 0.7 seconds of running on the spot, as the walk.
void addRunClip(Document& document, const CharacterNodes& nodes, const Pose& pose);
/// Add two seconds of waving with the right arm; cubic-spline rotations.
void addWaveClip(Document& document, const CharacterNodes& nodes, const Pose& pose);

} // namespace hearth::samples
