// Spherical harmonics of an environment's radiance, and the irradiance by them.
// R. Ramamoorthi, P. Hanrahan, "An efficient representation for irradiance environment maps", 2001.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"

#include <array>

namespace hearth::probes
{

/// Coefficients of radiance, a colour for each harmonic of degrees 0 to 2, in the order of
/// shared::evaluateHarmonics (formats/scene/radiance_transfer.h).
using Harmonics = std::array<Double3, 9>;

/// Project radiance onto the harmonics. Texels of lat-long images are integrated in closed form; of cubes
/// the solid angle is exact, and harmonics are means over four points. The same for any number of
/// threads.
Harmonics projectRadiance(const environment::Environment& environment);

/// Return the irradiance of a surface with a unit normal.
Double3 harmonicIrradiance(const Harmonics& radiance, Double3 normal);

/// Return the irradiance averaged over all normals: pi times the mean radiance.
Double3 meanIrradiance(const Harmonics& radiance);

/// Return the least irradiance over all normals and the three channels. Exact: not searched for by samples.
double minIrradiance(const Harmonics& radiance);

struct WindowedHarmonics
{
    Harmonics radiance;
    double window = 0; ///< 0: nothing is attenuated
};

/// Attenuate degree l by 1 / (1 + window * (l (l + 1))^2), with the least window that lets no irradiance be
/// negative. One window for the three channels keeps the colours.
/// Source: P.-P. Sloan, "Stupid spherical harmonics (SH) tricks", 2008, section "Windowing".
WindowedHarmonics windowHarmonics(const Harmonics& radiance);

} // namespace hearth::probes
