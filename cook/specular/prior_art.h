// What others do instead, for the report.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/configurations.h"

namespace hearth::specular
{

/// The overlap of two cones, visibility's and one as wide as the lobe, as a share of the latter; a smoothstep stands for the
/// caps' intersection. C. Oat, P. Sander, "Ambient aperture lighting", 2007; the lobe's width as in J. Jimenez et al.,
/// "Practical realtime strategies for accurate indirect occlusion", 2016.
double overlapOfCones(const Configuration& configuration);

/// From the ambient occlusion alone. S. Lagarde, C. de Rousiers, "Moving Frostbite to physically based rendering", 2014.
double fromAmbientOcclusion(const Configuration& configuration);

} // namespace hearth::specular
