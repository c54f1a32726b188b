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
constexpr float kMaxVisibleShare = 0.1f;

constexpr uint32_t kRays = 32;
// Rays that may escape sideways through the gap: below a cover at a tenth of the reach, a tenth do.
constexpr uint32_t kMaxEscapingRays = 6;

bool isCovered(RTCScene scene, const SamplePoint& point, float reach, uint64_t seed)
{
    std::array<float, kRays> x, y, z;
    sampling::hemisphereDirections(0, seed, sampling::frameAround(point.normal), x, y, z);
    const Float3 origin = rayOrigin(point);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    uint32_t escaped = 0;
    for (uint32_t i = 0; i < kRays && escaped <= kMaxEscapingRays; ++i)
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
        escaped += ray.tfar < 0 ? 0u : 1u;
    }
    return escaped <= kMaxEscapingRays;
}

} // namespace

std::vector<uint8_t> findInteriorPoints(const Occluders& occluders, std::span<const SamplePoint> points,
                                        std::span<const Moments> moments, std::span<const float> reach,
                                        uint64_t seed)
{
    HEARTH_ASSERT(moments.size() == points.size() && reach.size() == points.size());
    constexpr float kMaxM0 = kMaxVisibleShare * 2 * std::numbers::pi_v<float>;
    std::vector<uint8_t> interior(points.size(), 0);
    tbb::parallel_for(
        size_t{0}, points.size(),
        [&](size_t i)
        {
            if (moments[i].m0 < kMaxM0)
                interior[i] =
                    isCovered(occluders.scene(), points[i], reach[i], sampling::deriveSeed(seed, i)) ? 1 : 0;
        });
    return interior;
}

} // namespace hearth::visibility
