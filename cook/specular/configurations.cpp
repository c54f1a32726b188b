// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/configurations.h"

#include <cmath>
#include <numbers>
#include <random>

namespace hearth::specular
{

namespace
{

/// Maximum angle between cone axis and normal: larger tilts are rare on real models, and nearly closed.
constexpr double kMaxTilt = std::numbers::pi / 3;

/// Generate a uniform number in [0, 1). std::uniform_real_distribution is not the same in every library.
double uniform(std::mt19937_64& random)
{
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

} // namespace

double exactOcclusion(const Configuration& configuration, Masking masking)
{
    return computeOcclusion({configuration.roughness, configuration.theta_o, masking},
                            {configuration.axis, configuration.half_angle});
}

double cosBeta(const Configuration& configuration)
{
    return std::sin(configuration.theta_o) * configuration.axis.x +
           std::cos(configuration.theta_o) * configuration.axis.z;
}

float fitOcclusion(const Configuration& configuration, const shared::SpecularFit& fit)
{
    return shared::evaluateSpecularFit(
        fit, static_cast<float>(std::cos(configuration.half_angle)),
        static_cast<float>(configuration.roughness), static_cast<float>(std::cos(configuration.theta_o)),
        static_cast<float>(configuration.axis.z), static_cast<float>(cosBeta(configuration)));
}

float tableOcclusion(const Configuration& configuration, const TableValues& values, SpecularSpacing spacing)
{
    return lookUp(values, spacing, static_cast<float>(std::cos(configuration.half_angle)),
                  static_cast<float>(configuration.roughness), static_cast<float>(cosBeta(configuration)));
}

std::vector<Configuration> randomConfigurations(size_t count, uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::vector<Configuration> configurations(count);
    for (Configuration& configuration : configurations)
    {
        constexpr double kMinRoughness = double{shared::kMinSpecularRoughness};
        configuration.half_angle = std::numbers::pi / 2 * uniform(random);
        configuration.roughness = kMinRoughness + (1 - kMinRoughness) * uniform(random);
        configuration.theta_o = std::numbers::pi / 2 * uniform(random);
        const double tilt = kMaxTilt * uniform(random);
        const double around = 2 * std::numbers::pi * uniform(random);
        configuration.axis = {std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around),
                              std::cos(tilt)};
    }
    return configurations;
}

} // namespace hearth::specular
