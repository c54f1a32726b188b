// The occlusion of a lobe by a cone the slow way: a grid of visible normals, mirrored and counted.
// E. Heitz, "Sampling the GGX distribution of visible normals", JCGT 2018.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/lobe.h"

namespace hearth::test
{

/// The mean over the midpoints of `side` x `side` cells. With 600 it is within 3e-4 of the integral, mostly 1e-4.
double countedOcclusion(const specular::Lobe& lobe, const specular::Cone& cone, int side);

/// The integral over directions around the cone's axis, straight from its definition; for lobes of roughness 0.3 and more.
double integratedOcclusion(const specular::Lobe& lobe, const specular::Cone& cone, int steps);

} // namespace hearth::test
