// Clamps moments to the values that visibility can have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/moments.h"

namespace hearth::visibility
{

/// Return the moments of an unoccluded point on a surface with this normal.
Moments openHemisphere(Float3 normal);

/// Clamp the moments to the values of a visibility between 0 and 1 above a surface: m0 in [0, 2 pi], no
/// component of m1 against the normal, and |m1| <= m0 (1 - m0 / (4 pi)), which a spherical cap reaches. A fit
/// of noisy samples exceeds these bounds slightly. Values that are not finite become 0.
/// normal  unit; 0: unknown, and m1 may point anywhere
/// returns  true if a value changed by more than rounding
bool clampMoments(Moments& moments, Float3 normal);

} // namespace hearth::visibility
