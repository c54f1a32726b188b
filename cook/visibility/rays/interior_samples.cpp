// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/interior_samples.h"

#include "cook/sampling/hemisphere.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/base/assert.h"

#include <array>
#include <embree3/rtcore.h>
#include <numbers>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Share of the hemisphere: a sample that sees more is no candidate.
constexpr float kAllButNothing = 0.1f;

constexpr uint32_t kRays = 32;
// Rays that may escape sideways through the gap: below a cover at a tenth of the reach, a tenth do.
constexpr uint32_t kMayPass = 6;

bool isCovered(RTCScene scene, const SamplePoint& point, float reach, uint64_t seed)
{
    std::array<float, kRays> x, y, z;
    sampling::hemisphereDirections(0, seed, sampling::frameAround(point.normal), x, y, z);
    const Float3 origin = rayOrigin(point);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    uint32_t passed = 0;
    for (uint32_t i = 0; i < kRays && passed <= kMayPass; ++i)
    {
        RTCRay ray{};
        ray.org_x = origin.x;
        ray.org_y = origin.y;
        ray.org_z = origin.z;
        ray.dir_x = x[i];
        ray.dir_y = y[i];
        ray.dir_z = z[i];
        ray.tfar = reach;
        ray.mask = ~0u;
        rtcOccluded1(scene, &context, &ray);
        passed += ray.tfar < 0 ? 0u : 1u;
    }
    return passed <= kMayPass;
}

} // namespace

std::vector<uint8_t> buriedPoints(const Occluders& occluders, std::span<const SamplePoint> points,
                                  std::span<const Moments> moments, std::span<const float> reach,
                                  uint64_t seed)
{
    HEARTH_ASSERT(moments.size() == points.size() && reach.size() == points.size());
    constexpr float kMost = kAllButNothing * 2 * std::numbers::pi_v<float>;
    std::vector<uint8_t> buried(points.size(), 0);
    tbb::parallel_for(size_t{0}, points.size(),
                      [&](size_t i)
                      {
                          if (moments[i].m0 < kMost)
                              buried[i] =
                                  isCovered(occluders.scene(), points[i], reach[i], sampling::seedOf(seed, i))
                                      ? 1
                                      : 0;
                      });
    return buried;
}

} // namespace hearth::visibility
