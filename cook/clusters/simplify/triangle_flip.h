// Tests if a triangle flips when a corner moves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <algorithm>
#include <cmath>

namespace hearth::clusters
{

// A move may rotate a triangle by up to 75 degrees.
inline constexpr float kMinFlipCosine = 0.25f;

// Ratio of a triangle's height to its longest side below which its area is mostly rounding.
inline constexpr float kNeedleRatio = 1e-4f;

/// True if the triangle (corner, a, b) flips, or loses its area, when its corner moves.
inline bool moveFlipsTriangle(Float3 a, Float3 b, Float3 old_corner, Float3 new_corner)
{
    const Float3 new_a = a - new_corner;
    const Float3 new_b = b - new_corner;
    const Float3 old_normal = cross(a - old_corner, b - old_corner);
    const Float3 new_normal = cross(new_a, new_b);
    const float old_area2 = dot(old_normal, old_normal);
    const float new_area2 = dot(new_normal, new_normal);
    const float longest2 = std::max(dot(new_a, new_a), dot(new_b, new_b));
    // without branches: triangles that a collapse removes have no area
    const bool gone = !(new_area2 > 0);
    const bool needle = !(new_area2 > kNeedleRatio * kNeedleRatio * longest2 * longest2);
    const bool smaller = new_area2 < old_area2;
    const bool turned = dot(old_normal, new_normal) < kMinFlipCosine * std::sqrt(old_area2 * new_area2);
    return gone | (needle & smaller) | turned;
}

} // namespace hearth::clusters
