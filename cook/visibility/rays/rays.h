// Computes the visibility moments of surface samples by ray tracing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/moments.h"
#include "cook/visibility/rays/occluders.h"
#include "cook/visibility/rays/sample_points.h"

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Settings of the rays. Visibility in a direction in which a ray is free for t metres:
///     power 0  1 if t >= distance, else 0; needs any hit only, which is faster
///     power p  min(1, (t / distance)^p); needs the nearest hit, and a finite distance
struct RaySettings
{
    uint32_t rays_per_sample = 64; ///< best a power of two; at least 1
    /// First ray of each sample's sequence: moments of rays 0 to 63 and of 64 to 127, averaged, are those of
    /// 128 rays.
    uint32_t first_ray = 0;
    uint64_t seed = 0;
    float distance = std::numeric_limits<float>::infinity(); ///< metres, positive
    float power = 0;                                         ///< not negative
    float nearest = 0; ///< metres: nearer hits do not block; less than distance
};

/// Second moments m2 = int V w w^T dw, symmetric. Together with the other moments they are equivalent to nine
/// spherical harmonics. The trace is m0; the open hemisphere has 2 pi / 3 on the diagonal. Orthonormal real
/// harmonics Y_2m for m = -2 ... 2 have the coefficients
///     sqrt(15 / (4 pi)) {xy, yz, (2 zz - xx - yy) / (2 sqrt 3), xz, (xx - yy) / 2}
struct SecondMoments
{
    float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

struct HigherMoments
{
    Moments moments;
    SecondMoments second;
};

/// Progress callback: number of finished rays, and of all rays. Called by one thread at a time, some hundred
/// times a second at most; the last call reports all rays. Returns false to stop.
using RayProgress = std::function<bool(uint64_t rays_done, uint64_t rays_total)>;

/// Return the origin of a point's rays.
inline Float3 rayOrigin(const SamplePoint& point)
{
    return point.position + point.normal * point.lift;
}

/// Compute the moments of each point by rays into the hemisphere about its normal, uniform in solid angle:
/// the directions of sampling::hemisphereDirections under the seed
/// sampling::deriveSeed(settings.seed, index of the point). An unoccluded point has exactly 2 pi and pi n, a
/// fully occluded one exactly 0: cook/visibility/README.md, "Exact constants". The same for any number of
/// threads.
///
/// occluders  finished
/// points     best in an order in which neighbours are near
/// returns    nothing if `progress` returned false
std::optional<std::vector<Moments>> visibilityMoments(const Occluders& occluders,
                                                      std::span<const SamplePoint> points,
                                                      const RaySettings& settings,
                                                      const RayProgress& progress = {});

/// Compute the same first moments, bit for bit, and second moments.
std::optional<std::vector<HigherMoments>> visibilityHigherMoments(const Occluders& occluders,
                                                                  std::span<const SamplePoint> points,
                                                                  const RaySettings& settings,
                                                                  const RayProgress& progress = {});

} // namespace hearth::visibility
