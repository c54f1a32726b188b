// Cones fitted to nine spherical harmonics instead of the four moments: an option, to show what it brings.
// See cook/visibility/README.md, "Refined cones".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Real spherical harmonics, orthonormal, l * l + l + m in the order of (l, m): of bands 0, 1 and 2.
using Sh9 = std::array<double, 9>;

/// Y_lm of a unit direction.
Sh9 sphericalHarmonics(Double3 direction);

/// Visible with `scale` within the half-angle `aperture_rad` about the axis, else hidden.
struct ConeFit
{
    Double3 axis{0, 0, 1};   ///< unit
    double aperture_rad = 0; ///< in (0, pi / 2]
    double scale = 0;        ///< in [0, 1]
};

/// The harmonics of the cone, integrated over all directions.
Sh9 harmonicsOf(const ConeFit& cone);

struct RefinedCone
{
    ConeFit cone;
    double start_distance2 = 0; ///< squared distance of the start's harmonics to those asked for
    double distance2 = 0;       ///< and of the result's; not greater
};

/// The cone whose harmonics are nearest to `visibility`, by Levenberg-Marquardt from `start`, and from its aperture
/// and scale about `normal`: with two openings there are several minima. Both sides have three bands: against the
/// cone itself a narrow cone would fit as a wide one.
RefinedCone refineCone(const Sh9& visibility, const ConeFit& start, Double3 normal);

struct RefineStatistics
{
    double start_rms = 0; ///< of the distances, over all cones
    double rms = 0;
};

struct RefinedCones
{
    std::vector<ConeFit> cones;
    RefineStatistics statistics;
};

/// All cones of a mesh, in parallel; the same bits for any number of threads.
/// starts, normals  one for each of `visibility`
RefinedCones refineCones(std::span<const Sh9> visibility, std::span<const ConeFit> starts,
                         std::span<const Float3> normals);

} // namespace hearth::visibility
