// What samples of a surface see, by rays.
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

/// Visibility in a direction in which a ray is free for t metres:
///     power 0  1 if t >= distance, else 0; any hit answers that, which is faster
///     power p  min(1, (t / distance)^p); needs the nearest hit, and a finite distance
struct RaySettings
{
    uint32_t rays_per_sample = 64; ///< best a power of two; at least 1
    /// The first of each sample's sequence: moments of rays 0 to 63 and of 64 to 127, averaged, are those of 128 rays.
    uint32_t first_ray = 0;
    uint64_t seed = 0;
    float distance = std::numeric_limits<float>::infinity(); ///< metres, positive
    float power = 0;                                         ///< not negative
    float nearest = 0; ///< metres: hits before that are not in the way; less than distance
};

/// m2 = int V w w^T dw, symmetric: with the other moments all that nine spherical harmonics hold. Its trace is m0; the open
/// hemisphere has 2 pi / 3 on the diagonal. Of orthonormal real harmonics, Y_2m for m = -2 ... 2 have
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

/// Told how many rays of how many are done, by one thread at a time, some hundred times a second at most; the last time all
/// of them. Returns whether to go on.
using RayProgress = std::function<bool(uint64_t rays_done, uint64_t rays_total)>;

/// Where the rays of a point start.
inline Float3 rayOrigin(const SamplePoint& point)
{
    return point.position + point.normal * point.lift;
}

/// Moments for each of the points, by rays into the hemisphere about its normal: uniform in solid angle, the directions of
/// sampling::hemisphereDirections under the seed sampling::seedOf(settings.seed, index of the point).
/// A point that sees all has exactly 2 pi and pi n, one that sees nothing exactly 0: cook/visibility/README.md, "Constants stay constants".
/// The same for any number of threads.
///
/// occluders  finished
/// points     best in an order in which neighbours are near
/// returns    nothing where `progress` said to stop
std::optional<std::vector<Moments>> visibilityMoments(const Occluders& occluders,
                                                      std::span<const SamplePoint> points,
                                                      const RaySettings& settings,
                                                      const RayProgress& progress = {});

/// The same moments to the bit, and second ones.
std::optional<std::vector<HigherMoments>> visibilityHigherMoments(const Occluders& occluders,
                                                                  std::span<const SamplePoint> points,
                                                                  const RaySettings& settings,
                                                                  const RayProgress& progress = {});

} // namespace hearth::visibility
