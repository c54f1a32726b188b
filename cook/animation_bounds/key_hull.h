// Bounds the values of an animation channel at any time by points whose convex hull contains them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "formats/scene/animation.h"

#include <span>
#include <vector>

namespace hearth::animation_bounds
{

/// Add the box of a translation or scale channel (three components). Splines are bounded by their Bezier
/// control points, which are subdivided until they lie close to the curve.
void addValues(const formats::AnimationTables& tables, const formats::AnimationChannelRecord& channel,
               Box3d& box);

/// Add the range of component `component` of a morph weight channel.
void addValues(const formats::AnimationTables& tables, const formats::AnimationChannelRecord& channel,
               uint32_t component, Interval& range);

/// Quaternions of any length above 0 that bound rotations. Between two keys or control points, rotations lie
/// in the cone of the points, because they follow arcs.
struct RotationPoints
{
    std::vector<formats::Quaternion> points;
    bool unbounded = false; ///< a spline passes through 0: any rotation is possible
};

/// Add the points of a rotation channel.
void addRotations(const formats::AnimationTables& tables, const formats::AnimationChannelRecord& channel,
                  RotationPoints& points);

} // namespace hearth::animation_bounds
