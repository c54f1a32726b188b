// Approximates an animation channel during a time span by a quadratic with an error bound.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/curve_keys.h"

namespace hearth::animation_bounds
{

/// Time span, seconds. A step or jump of keys at its end belongs to the next span, unless it is the last one.
struct TimeSpan
{
    double from = 0;
    double to = 0;
    bool last = true;
};

/// Quadratic terms[0] + s terms[1] + s^2 terms[2], for s from -1 at the span's start to 1 at its end.
struct TimeCurve
{
    std::array<ChannelValue, 3> terms{};
    /// upper bound for the Euclidean distance from the channel at any time; infinite if unknown
    double remainder = 0;
};

/// Return the curve of a constant value.
TimeCurve constantCurve(const ChannelValue& value);

/// Fit the curve of a translation or scale channel.
TimeCurve fitVectorCurve(TimeSpan time, const formats::AnimationTables& tables,
                         const formats::AnimationChannelRecord& channel);

/// Fit the curve of a rotation channel: the quaternion of length 1, with the sign that makes it continuous
/// between jumps. The remainder is infinite where a spline may pass through 0.
TimeCurve fitRotationCurve(TimeSpan time, const formats::AnimationTables& tables,
                           const formats::AnimationChannelRecord& channel);

} // namespace hearth::animation_bounds
