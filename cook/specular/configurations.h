// Random cones over lobes, on which fit and table are measured.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/table.h"

#include <vector>

namespace hearth::specular
{

/// Five numbers that determine the occlusion. N = (0, 0, 1), V = (-sin theta_o, 0, cos theta_o), as in Lobe.
struct Configuration
{
    double half_angle = 0; ///< radians, 0 to pi / 2
    double roughness = 1;
    double theta_o = 0; ///< radians, 0 to pi / 2
    Double3 axis{0, 0, 1};
};

double exactOcclusion(const Configuration& configuration, Masking masking);

/// Evaluate the fit or the table as the runtime does.
float fitOcclusion(const Configuration& configuration, const shared::SpecularFit& fit = shared::kSpecularFit);
float tableOcclusion(const Configuration& configuration, const TableValues& values, SpecularSpacing spacing);

/// Compute the cosine of the angle between reflection vector and axis.
double cosBeta(const Configuration& configuration);

/// Generate random configurations, the same for the same seed. Aperture, roughness (from the table's first
/// node) and theta_o are uniform; the axis is tilted from the normal by a uniform angle up to 60 degrees, in
/// any direction.
std::vector<Configuration> randomConfigurations(size_t count, uint64_t seed);

} // namespace hearth::specular
