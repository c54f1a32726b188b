// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/prior_art.h"

#include <algorithm>
#include <cmath>

namespace hearth::specular
{

double coneOverlapOcclusion(const Configuration& configuration)
{
    const double alpha = configuration.roughness * configuration.roughness;
    const double lobe = std::acos(std::exp2(-3.32193 * alpha));
    const double visible = configuration.half_angle;
    const double apart = std::acos(std::clamp(cosBeta(configuration), -1.0, 1.0));
    const double inside = std::abs(lobe - visible);
    const double smaller = (1 - std::cos(std::min(lobe, visible))) / (1 - std::cos(lobe));
    const double near = 1 - std::clamp((apart - inside) / std::max(lobe + visible - inside, 1e-9), 0.0, 1.0);
    return smaller * near * near * (3 - 2 * near);
}

double occlusionFromAmbient(const Configuration& configuration)
{
    const double sine = std::sin(configuration.half_angle);
    const double open = sine * sine * std::max(configuration.axis.z, 0.0);
    const double facing = std::cos(configuration.theta_o);
    return std::clamp(std::pow(facing + open, std::exp2(-16 * configuration.roughness - 1)) - 1 + open, 0.0,
                      1.0);
}

} // namespace hearth::specular
