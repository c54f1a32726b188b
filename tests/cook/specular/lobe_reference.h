// Occlusion of a lobe by a cone, computed by brute force: reflects a grid of visible normals and counts the
// unoccluded ones.
// E. Heitz, "Sampling the GGX distribution of visible normals", JCGT 2018.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/lobe.h"

namespace hearth::test
{

/// Return the mean over the midpoints of `side` x `side` cells. With 600 it is within 3e-4 of the integral,
/// mostly 1e-4.
double countedOcclusion(const specular::Lobe& lobe, const specular::Cone& cone, int side);

/// Return the integral over directions around the cone's axis, straight from its definition. For lobes of
/// roughness 0.3 and more.
double integratedOcclusion(const specular::Lobe& lobe, const specular::Cone& cone, int steps);

} // namespace hearth::test
