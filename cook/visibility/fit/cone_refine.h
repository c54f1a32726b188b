// Fits cones to nine spherical harmonics instead of the four moments: an option, to measure what it gains.
// See cook/visibility/README.md, "Refined cones".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <array>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Real spherical harmonics of the bands 0, 1 and 2, orthonormal; (l, m) has the index l * l + l + m.
using Sh9 = std::array<double, 9>;

/// Evaluate Y_lm in a unit direction.
Sh9 sphericalHarmonics(Double3 direction);

/// Visibility cone: `scale` within the half-angle `aperture_rad` about the axis, 0 outside.
struct ConeFit
{
    Double3 axis{0, 0, 1};   ///< unit
    double aperture_rad = 0; ///< in (0, pi / 2]
    double scale = 0;        ///< in [0, 1]
};

/// Compute the harmonics of the cone, integrated over all directions.
Sh9 computeHarmonics(const ConeFit& cone);

struct RefinedCone
{
    ConeFit cone;
    double start_distance2 = 0; ///< squared distance of the start's harmonics from the target
    double distance2 = 0;       ///< squared distance of the result's harmonics; not greater
};

/// Find the cone whose harmonics are nearest to `visibility`, by Levenberg-Marquardt from `start`, and from
/// its aperture and scale about `normal`: with two openings there are several minima. Both sides are
/// truncated to three bands; compared with the cone itself, a narrow cone would be fitted as a wide one.
RefinedCone refineCone(const Sh9& visibility, const ConeFit& start, Double3 normal);

struct RefineStatistics
{
    double start_rms = 0; ///< rms distance of the starts, over all cones
    double rms = 0;
};

struct RefinedCones
{
    std::vector<ConeFit> cones;
    RefineStatistics statistics;
};

/// Refine all cones of a mesh in parallel; the same bits for any number of threads.
/// starts, normals  one for each of `visibility`
RefinedCones refineCones(std::span<const Sh9> visibility, std::span<const ConeFit> starts,
                         std::span<const Float3> normals);

} // namespace hearth::visibility
