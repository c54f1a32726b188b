// Visible part of the hemisphere at a point, as two moments. They are linear in the visibility, so they can
// be summed, fitted and interpolated; angles of cones cannot.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

namespace hearth::visibility
{

/// Moments of the visibility V(w) in [0, 1] in direction w: m0 = int V dw, in [0, 2 pi] above a surface, and
/// m1 = int V w dw, of length at most m0 (1 - m0 / (4 pi)). The open hemisphere about n has 2 pi and pi n. On
/// a surface with the normal n, where V is 0 below the surface, ambient occlusion is dot(n, m1) / pi.
struct Moments
{
    float m0 = 0;
    Float3 m1;
};

} // namespace hearth::visibility
