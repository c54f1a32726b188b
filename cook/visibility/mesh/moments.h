// What of the hemisphere a point sees, as two moments: they are linear in the visibility, so that sums, fits and
// interpolation of them mean something, which angles of cones do not.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

namespace hearth::visibility
{

/// With V(w) in [0, 1] the visibility in direction w: m0 = int V dw, in [0, 2 pi] above a surface, and m1 = int V w dw, of
/// length at most m0 (1 - m0 / (4 pi)). The open hemisphere about n has 2 pi and pi n. The ambient occlusion of a surface
/// with the normal n that V is 0 below of is dot(n, m1) / pi.
struct Moments
{
    float m0 = 0;
    Float3 m1;
};

} // namespace hearth::visibility
