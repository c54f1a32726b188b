// The moments that visibility can have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/moments.h"

namespace hearth::visibility
{

/// Of a point that nothing hides anything from, on a surface with this normal.
Moments openHemisphere(Float3 normal);

/// The moments brought back to what a visibility between 0 and 1 above a surface can have: m0 in [0, 2 pi], no part
/// of m1 against the normal, and |m1| <= m0 (1 - m0 / (4 pi)), which a spherical cap reaches. A fit of noisy samples
/// oversteps this a little. What is not finite becomes 0.
/// normal  unit; 0: not known, and m1 may point anywhere
/// returns whether anything was changed by more than rounding
bool clampMoments(Moments& moments, Float3 normal);

} // namespace hearth::visibility
