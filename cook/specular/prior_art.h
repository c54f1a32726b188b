// Prior art: published approximations of specular occlusion, for comparison in the report.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/configurations.h"

namespace hearth::specular
{

/// Compute the overlap of the visibility cone and a cone as wide as the lobe, as a share of the latter; a
/// smoothstep approximates the intersection of the caps. C. Oat, P. Sander, "Ambient aperture lighting",
/// 2007; the lobe's width as in J. Jimenez et al., "Practical realtime strategies for accurate indirect
/// occlusion", 2016.
double coneOverlapOcclusion(const Configuration& configuration);

/// Estimate from ambient occlusion alone. S. Lagarde, C. de Rousiers, "Moving Frostbite to physically based
/// rendering", 2014.
double occlusionFromAmbient(const Configuration& configuration);

} // namespace hearth::specular
