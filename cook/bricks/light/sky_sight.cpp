// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/sky_sight.h"

#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

namespace
{

constexpr uint32_t kSurfacePoints = 4096;
constexpr uint32_t kRays = 64;

/// Share of the sky below which a place is dark.
constexpr float kDarkShare = 0.1f;

/// Distance of ray origins from their surface, in voxels.
constexpr float kSurfaceOffset = 0.01f;

/// Return whether less than kDarkShare of the rays meet nothing.
/// direct  returns the direction of a ray, by a point of the unit square
template <typename Direct>
bool isDark(const RayScene& rays, Float3 position, uint64_t seed, const Direct& direct)
{
    uint32_t open = 0;
    for (uint32_t i = 0; i < kRays; ++i)
    {
        const Float3 direction = direct(sampling::unitPoint(sampling::owenSobol(i, seed)));
        open += rays.occluded(position, direction, std::numeric_limits<float>::infinity()) ? 0 : 1;
    }
    return static_cast<float>(open) < kDarkShare * kRays;
}

uint32_t countDark(size_t count, const std::function<bool(size_t)>& is_dark)
{
    std::vector<uint8_t> dark(count);
    tbb::parallel_for(size_t{0}, count, [&](size_t i) { dark[i] = is_dark(i) ? 1 : 0; });
    return static_cast<uint32_t>(std::ranges::count(dark, 1));
}

} // namespace

SkySight measureSkySight(const RayScene& rays, std::span<const Float3> cameras)
{
    const std::vector<RayScene::SurfacePoint> points = rays.sampleSurface(kSurfacePoints);
    const auto isDarkPoint = [&](size_t i)
    {
        const sampling::Frame frame = sampling::frameAround(points[i].normal);
        return isDark(rays, points[i].position + points[i].normal * kSurfaceOffset,
                      sampling::deriveSeed(1, i),
                      [&](Float2 u) { return frame.fromLocal(sampling::hemisphereDirection(u)); });
    };
    const auto isDarkCamera = [&](size_t i)
    {
        return isDark(rays, cameras[i], sampling::deriveSeed(2, i),
                      [](Float2 u)
                      {
                          const Float3 up = sampling::hemisphereDirection({std::abs(2 * u.x - 1), u.y});
                          return u.x < 0.5f ? -up : up;
                      });
    };
    return {static_cast<uint32_t>(points.size()), countDark(points.size(), isDarkPoint),
            static_cast<uint32_t>(cameras.size()), countDark(cameras.size(), isDarkCamera)};
}

} // namespace hearth::bricks
