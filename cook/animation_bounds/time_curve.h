// What an animation channel does in a span of time: a quadratic, and how far the channel is from it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/curve_keys.h"

namespace hearth::motion
{

/// Seconds. What happens at its end, a step or a jump of keys, belongs to the span behind it, unless it is the last one.
struct TimeSpan
{
    double from = 0;
    double to = 0;
    bool last = true;
};

/// terms[0] + s terms[1] + s^2 terms[2] for s from -1 at the span's start to 1 at its end.
struct TimeCurve
{
    std::array<Value, 3> terms{};
    double remainder = 0; ///< Euclidean length of the difference, at any time; infinite: nothing is known
};

/// Of a value that stays.
TimeCurve curveOf(const Value& value);

/// Of a translation's or scale's channel.
TimeCurve vectorCurve(TimeSpan time, const formats::MotionTables& tables,
                      const formats::AnimationChannelRecord& channel);

/// Of a rotation's channel: the quaternion of length 1, with the sign that makes it continuous between jumps. Infinite
/// where a spline may go through 0.
TimeCurve rotationCurve(TimeSpan time, const formats::MotionTables& tables,
                        const formats::AnimationChannelRecord& channel);

} // namespace hearth::motion
