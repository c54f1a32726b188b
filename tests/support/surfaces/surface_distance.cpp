// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/surfaces/surface_distance.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <vector>

namespace hearth
{

namespace
{

struct Double3
{
    double x, y, z;
};
Double3 widen(Float3 a)
{
    return {a.x, a.y, a.z};
}
Double3 operator-(Double3 a, Double3 b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Double3 operator*(Double3 a, double s)
{
    return {a.x * s, a.y * s, a.z * s};
}
double dot(Double3 a, Double3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Point on a triangle, and its distance from the query.
struct OnTriangle
{
    double v = 0, w = 0;
    double distance2 = 0;

    void take(const OnTriangle& other)
    {
        if (other.distance2 < distance2)
            *this = other;
    }
};

/// Return the point nearest to p on the edge from a to b, corners with the weights (v, w) `from` and `to`.
OnTriangle onEdge(Double3 p, Double3 a, Double3 b, Float2 from, Float2 to)
{
    const Double3 ab = b - a;
    const double length2 = dot(ab, ab);
    const double t = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    const Double3 away = p - a - ab * t;
    return {double{from.x} + t * (to.x - from.x), double{from.y} + t * (to.y - from.y), dot(away, away)};
}

OnTriangle onTriangle(Double3 p, Double3 a, Double3 b, Double3 c)
{
    constexpr Float2 kA{0, 0}, kB{1, 0}, kC{0, 1};
    const Double3 ab = b - a, ac = c - a, ap = p - a;
    const double d11 = dot(ab, ab), d12 = dot(ab, ac), d22 = dot(ac, ac);
    const double det = d11 * d22 - d12 * d12;
    OnTriangle nearest = onEdge(p, a, b, kA, kB);
    nearest.take(onEdge(p, b, c, kB, kC));
    nearest.take(onEdge(p, c, a, kC, kA));
    if (det > 0)
    {
        const double v = (d22 * dot(ab, ap) - d12 * dot(ac, ap)) / det;
        const double w = (d11 * dot(ac, ap) - d12 * dot(ab, ap)) / det;
        if (v >= 0 && w >= 0 && v + w <= 1)
        {
            const Double3 away = ap - ab * v - ac * w;
            nearest.take({v, w, dot(away, away)});
        }
    }
    return nearest;
}

} // namespace

struct SurfaceDistance::State
{
    std::vector<Float3> corners; ///< three for each triangle
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~State()
    {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

namespace
{

struct Query
{
    std::span<const Float3> corners;
    Double3 point;
    OnTriangle nearest{0, 0, std::numeric_limits<double>::infinity()};
    uint32_t triangle = 0;
};

bool visitTriangle(RTCPointQueryFunctionArguments* arguments)
{
    auto& query = *static_cast<Query*>(arguments->userPtr);
    const Float3* corner = &query.corners[size_t{arguments->primID} * 3];
    const OnTriangle here = onTriangle(query.point, widen(corner[0]), widen(corner[1]), widen(corner[2]));
    if (!(here.distance2 < query.nearest.distance2))
        return false;
    query.nearest = here;
    query.triangle = arguments->primID;
    // slightly more, so that rounding here does not hide equally near triangles
    arguments->query->radius = static_cast<float>(std::sqrt(here.distance2) * (1 + 1e-6) + 1e-30);
    return true;
}

/// Element `index` of the base-2 van der Corput sequence (2) or of base 3: spread evenly in [0, 1).
double radicalInverse(uint64_t index, uint64_t base)
{
    double value = 0;
    double digit = 1;
    for (; index > 0; index /= base)
        value += (digit /= static_cast<double>(base)) * static_cast<double>(index % base);
    return value;
}

} // namespace

SurfaceDistance::SurfaceDistance(std::span<const Float3> positions, std::span<const uint32_t> triangles)
    : state_(std::make_unique<State>())
{
    for (const uint32_t index : triangles)
        state_->corners.push_back(positions[index]);
    state_->device = rtcNewDevice("threads=1");
    state_->scene = rtcNewScene(state_->device);
    const RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const size_t count = triangles.size();
    auto* vertices = static_cast<Float3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                  RTC_FORMAT_FLOAT3, sizeof(Float3), count));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), count / 3));
    for (uint32_t i = 0; i < count; ++i)
    {
        vertices[i] = state_->corners[i];
        indices[i] = i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(state_->scene);
}

SurfaceDistance::~SurfaceDistance() = default;

SurfaceDistance::Nearest SurfaceDistance::nearest(Float3 point) const
{
    Query query{state_->corners, widen(point)};
    RTCPointQuery ball{};
    ball.x = point.x;
    ball.y = point.y;
    ball.z = point.z;
    ball.radius = std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(state_->scene, &ball, &context, visitTriangle, &query);
    return {std::sqrt(query.nearest.distance2), {query.triangle, query.nearest.v, query.nearest.w}};
}

double SurfaceDistance::toTriangle(Float3 point, uint32_t triangle) const
{
    const Float3* corner = &state_->corners[size_t{triangle} * 3];
    return std::sqrt(
        onTriangle(widen(point), widen(corner[0]), widen(corner[1]), widen(corner[2])).distance2);
}

Float3 valueAt(const SurfacePoint& point, std::span<const Float3> of_vertices,
               std::span<const uint32_t> triangles)
{
    const uint32_t* corner = &triangles[size_t{point.triangle} * 3];
    const Float3 a = of_vertices[corner[0]];
    return a + (of_vertices[corner[1]] - a) * static_cast<float>(point.v) +
           (of_vertices[corner[2]] - a) * static_cast<float>(point.w);
}

std::vector<SurfacePoint> evenlySpread(std::span<const Float3> positions, std::span<const uint32_t> triangles,
                                       size_t count)
{
    const auto computeArea = [&](size_t t)
    {
        const Float3 a = positions[triangles[t]];
        return double{length(cross(positions[triangles[t + 1]] - a, positions[triangles[t + 2]] - a))};
    };
    double total_area = 0;
    for (size_t t = 0; t < triangles.size(); t += 3)
        total_area += computeArea(t);
    std::vector<SurfacePoint> points;
    double due = 0;
    for (size_t t = 0; t < triangles.size(); t += 3)
        for (due += static_cast<double>(count) * computeArea(t) / total_area; due >= 1; due -= 1)
        {
            double v = radicalInverse(points.size() + 1, 2), w = radicalInverse(points.size() + 1, 3);
            if (v + w > 1)
            {
                v = 1 - v;
                w = 1 - w;
            }
            points.push_back({static_cast<uint32_t>(t / 3), v, w});
        }
    return points;
}

double largestDistance(std::span<const Float3> positions, std::span<const uint32_t> triangles, size_t count,
                       const SurfaceDistance& surface)
{
    double largest = 0;
    for (const uint32_t corner : triangles)
        largest = std::max(largest, surface.to(positions[corner]));
    for (const SurfacePoint& point : evenlySpread(positions, triangles, count))
        largest = std::max(largest, surface.to(valueAt(point, positions, triangles)));
    return largest;
}

} // namespace hearth
