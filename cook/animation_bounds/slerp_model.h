// Taylor model of the slerp of two rotations that are functions of time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/taylor_model.h"
#include "cook/animation_bounds/time_curve.h"

namespace hearth::animation_bounds
{

/// Return the model of any rotation: each is within 1 of the quaternion 0.
inline TaylorModel<4> anyRotation()
{
    TaylorModel<4> any;
    any.remainder = 1;
    return any;
}

/// Return slerp(from, to, w) as a quaternion of length 1, with either sign. x0 is the time of `from`, x1 the
/// time of `to`, x2 goes from the low weight to the high one. Where the two may be half a turn apart, the
/// shorter arc is ambiguous; the result is then the nearer end, with a remainder as large as the weights
/// allow.
/// source  sines of fractions of the arc as hypergeometric series in the squared sine of half the arc. They
///         have no pole where the two rotations are equal; all coefficients have one sign, so derivatives are
///         largest at the far corner.
TaylorModel<4> slerpModel(const TimeCurve& from, const TimeCurve& to, Interval weights);

} // namespace hearth::animation_bounds
