// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/gather_table.h"

#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <numbers>

namespace hearth::receivers
{

namespace
{

/// Seed of the gather rays; those of direct light have others.
constexpr uint64_t kGatherSeed = 1;

uint32_t countOpenRays(uint32_t open)
{
    return static_cast<uint32_t>(std::popcount(open)) * kPointRays;
}

/// Return a direction by the cosine about the normal. Those that would begin behind the triangle are
/// mirrored at it.
Float3 gatherDirection(const ReceivingPoint& from, const sampling::Frame& frame, sampling::SquarePoint at)
{
    const Float3 direction = frame.fromLocal(sampling::cosineDirection(sampling::unitPoint(at)));
    const float height = dot(direction, from.side);
    return height < 0 ? direction - from.side * (2 * height) : direction;
}

} // namespace

ReceivingPoint receivingPoint(const BakeScene& scene, const Element& element, size_t point, float offset)
{
    const SurfacePoint& at = element.points[point];
    const Triangle& triangle = scene.triangles[at.triangle];
    const float sign = element.is_back ? -1.0f : 1.0f;
    const Float3 side = normalizeOr(crossEdges(triangle), {0, 0, 1}) * sign;
    const Float3 normal = normalizeOr(interpolate(triangle.normals, at.weights) * sign, side);
    return {interpolate(triangle.corners, at.weights) + side * offset, dot(normal, side) > 0 ? normal : side,
            side};
}

GatherTable::GatherTable(const BakeScene& scene, const BakeRays& rays, const Elements& elements)
    : hits_(elements.list().size() * kElementRays, kInvalidIndex),
      open_(elements.list().size()),
      sky_(scene.sky ? elements.list().size() : 0)
{
    const auto traceElement = [&](size_t element)
    {
        Float3 sky;
        for (size_t point = 0; point < kTexelPoints; ++point)
        {
            const TracedPoint traced = tracePoint(scene, rays, elements, element, point);
            if (!traced.is_open)
                continue;
            open_[element] |= static_cast<uint8_t>(1u << point);
            sky += traced.sky;
        }
        if (scene.sky && open_[element] != 0)
            sky_[element] =
                sky * (std::numbers::pi_v<float> / static_cast<float>(countOpenRays(open_[element])));
    };
    tbb::parallel_for(tbb::blocked_range<size_t>(0, open_.size(), 64),
                      [&](const tbb::blocked_range<size_t>& range)
                      {
                          for (size_t element = range.begin(); element != range.end(); ++element)
                              traceElement(element);
                      });
}

GatherTable::TracedPoint GatherTable::tracePoint(const BakeScene& scene, const BakeRays& rays,
                                                 const Elements& elements, size_t element, size_t point)
{
    const ReceivingPoint from = receivingPoint(scene, elements.list()[element], point, rays.offset);
    const sampling::Frame frame = sampling::frameAround(from.normal);
    const uint64_t seed = sampling::deriveSeed(kGatherSeed, element);
    TracedPoint traced;
    uint32_t inside = 0;
    for (uint32_t i = 0; i < kPointRays; ++i)
    {
        const auto number = static_cast<uint32_t>(point) * kPointRays + i;
        const Float3 direction = gatherDirection(from, frame, sampling::owenSobol(number, seed));
        const auto hit = rays.triangles.nearest(from.position, direction);
        if (!hit)
        {
            if (scene.sky)
                traced.sky += shared::skyRadiance(*scene.sky, direction);
            continue;
        }
        const Triangle& triangle = scene.triangles[hit->triangle];
        const bool is_front = dot(crossEdges(triangle), direction) <= 0;
        inside += !is_front && !triangle.double_sided ? 1u : 0u;
        hits_[element * kElementRays + number] = elements.find({hit->triangle, hit->weights}, is_front);
    }
    traced.is_open = 2 * inside <= kPointRays;
    return traced;
}

} // namespace hearth::receivers
