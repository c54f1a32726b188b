// Quaternions x y z w as vectors of four dimensions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/scene/animation.h"

#include <cmath>

namespace hearth::animation_bounds
{

inline double dot(const formats::Quaternion& a, const formats::Quaternion& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

inline double length(const formats::Quaternion& q)
{
    return std::sqrt(dot(q, q));
}

inline formats::Quaternion scaled(const formats::Quaternion& q, double by)
{
    return {q[0] * by, q[1] * by, q[2] * by, q[3] * by};
}

/// Return the quaternion scaled to length 1; the identity if its length is 0, as in poses.
inline formats::Quaternion normalizedOrNone(const formats::Quaternion& q)
{
    const double l = length(q);
    return l > 0 && std::isfinite(l) ? scaled(q, 1 / l) : formats::Quaternion{0, 0, 0, 1};
}

inline formats::Quaternion conjugate(const formats::Quaternion& q)
{
    return {-q[0], -q[1], -q[2], q[3]};
}

/// Return the product: rotation b, then a.
inline formats::Quaternion multiply(const formats::Quaternion& a, const formats::Quaternion& b)
{
    return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

} // namespace hearth::animation_bounds
