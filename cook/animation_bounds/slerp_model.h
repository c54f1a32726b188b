// Rotations between two that move by themselves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/taylor_model.h"
#include "cook/animation_bounds/time_curve.h"

namespace hearth::motion
{

/// Any rotation is within 1 of the quaternion 0.
inline TaylorModel<4> anyRotation()
{
    TaylorModel<4> any;
    any.remainder = 1;
    return any;
}

/// slerp(from, to, w) as a quaternion of length 1, up to its sign: x0 is the time of `from`, x1 that of `to`, x2 goes
/// from the low weight to the high one. Where the two may be half a turn apart, so that the shorter way changes, no more is
/// known than how far from the nearer end the weights allow.
/// source   sines of fractions as hypergeometric series in the squared sine of half the arc, which have no pole where the
///          two meet; all coefficients have one sign, so derivatives are largest at the far corner
TaylorModel<4> slerpModel(const TimeCurve& from, const TimeCurve& to, Interval weights);

} // namespace hearth::motion
