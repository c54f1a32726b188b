// Computes the irradiance of a triangle that shines evenly, in closed form.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <array>

namespace hearth::receivers
{

/// Return the irradiance that a triangle of radiance 1 causes at a point if nothing is in the way, whichever
/// of its sides is seen; the part below the horizon counts for nothing. In [0, pi]. 0 if the point is in the
/// triangle's plane.
/// normal  unit
/// source  J. H. Lambert, "Photometria", 1760, as in J. Arvo, "Analytic methods for simulated light
///         transport", 1995, chapter 4
float triangleIrradiance(Float3 point, Float3 normal, const std::array<Float3, 3>& corners);

} // namespace hearth::receivers
