// What an animation channel's value can be at any time: points whose convex hull holds it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "formats/scene/animation.h"

#include <span>
#include <vector>

namespace hearth::motion
{

/// Add the box of three components of a translation or scale. Splines are held by their Bezier control points, which
/// are subdivided until they lie close.
void addValues(const formats::MotionTables& tables, const formats::AnimationChannelRecord& channel,
               Box3d& box);

/// Add the range of component `component`, a morph weight.
void addValues(const formats::MotionTables& tables, const formats::AnimationChannelRecord& channel,
               uint32_t component, Interval& range);

/// Quaternions of any length but 0. What they stand for is the cone of each piece's points: rotations between the keys
/// are on arcs, so inside the cone.
struct RotationPoints
{
    std::vector<formats::Quaternion> points;
    bool unbounded = false; ///< a spline goes through 0: any rotation
};

/// Add the points of a rotation channel.
void addRotations(const formats::MotionTables& tables, const formats::AnimationChannelRecord& channel,
                  RotationPoints& points);

} // namespace hearth::motion
