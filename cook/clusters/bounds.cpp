// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/bounds.h"

#include "cook/clusters/lanes.h"
#include "formats/assert.h"
#include "formats/cluster_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hearth::clusters
{

namespace
{

// More steps shrink the sphere by less than 1 % of its radius.
constexpr int kSphereSteps = 12;

// The rasteriser snaps corners to 1/256 pixel, which can turn slivers that are seen edge-on (design notes,
// RUNTIME 2.4).
constexpr double kConeMargin = 1e-3;

// Wider cones than about 84 degrees cull next to nothing.
constexpr double kMinConeCosine = 0.1;

struct Double3
{
    double x = 0, y = 0, z = 0;
};
Double3 widen(Float3 a)
{
    return {a.x, a.y, a.z};
}
Double3 operator+(Double3 a, Double3 b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
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
double length(Double3 a)
{
    return std::sqrt(dot(a, a));
}
Double3 cross(Double3 a, Double3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Float3 narrow(Double3 a)
{
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

struct WideSphere
{
    Double3 center;
    double radius = 0;
};

/// Grow the sphere just enough for a point.
void growTo(WideSphere& sphere, Double3 point)
{
    const Double3 away = point - sphere.center;
    if (dot(away, away) <= sphere.radius * sphere.radius)
        return;
    const double distance = length(away);
    const double radius = (sphere.radius + distance) * 0.5;
    sphere.center = sphere.center + away * ((radius - sphere.radius) / distance);
    sphere.radius = radius;
}

WideSphere ritterSphere(std::span<const Float3> points)
{
    size_t low[3] = {};
    size_t high[3] = {};
    for (size_t i = 0; i < points.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
        {
            if (points[i][axis] < points[low[axis]][axis])
                low[axis] = i;
            if (points[i][axis] > points[high[axis]][axis])
                high[axis] = i;
        }
    WideSphere sphere;
    for (int axis = 0; axis < 3; ++axis)
    {
        const Double3 a = widen(points[low[axis]]);
        const Double3 b = widen(points[high[axis]]);
        if (const double radius = length(b - a) * 0.5; radius >= sphere.radius)
            sphere = {(a + b) * 0.5, radius};
    }
    for (const Float3 p : points)
        growTo(sphere, widen(p));
    return sphere;
}

/// The center as it will be stored, and the radius that it then needs.
Sphere storedSphere(Double3 center, std::span<const Float3> points)
{
    const Float3 stored = narrow(center);
    const Double3 from = widen(stored);
    double radius2 = 0;
    for (const Float3 point : points)
    {
        const Double3 away = widen(point) - from;
        radius2 = std::max(radius2, dot(away, away));
    }
    return {stored, roundUp(std::sqrt(radius2))};
}

/// Points relative to a sphere around them, four side by side: floats are good enough to look for a better center.
std::vector<LaneVector> relativeTo(const WideSphere& sphere, std::span<const Float3> points)
{
    const double scale = sphere.radius > 0 ? 1 / sphere.radius : 0;
    std::vector<LaneVector> blocks((points.size() + kLanes - 1) / kLanes);
    for (size_t i = 0; i < blocks.size() * kLanes; ++i)
    {
        // lanes that are left over repeat the last point
        const Float3 place = narrow((widen(points[std::min(i, points.size() - 1)]) - sphere.center) * scale);
        LaneVector& block = blocks[i / kLanes];
        block.x[i % kLanes] = place.x;
        block.y[i % kLanes] = place.y;
        block.z[i % kLanes] = place.z;
    }
    return blocks;
}

struct Farthest
{
    Float3 point;
    float distance = 0;
};

Farthest farthestFrom(Float3 center, std::span<const LaneVector> blocks)
{
    const LaneVector centers = allLanes(center);
    Lanes farthest2 = allLanes(-1);
    LaneMask block_of_farthest{};
    for (size_t b = 0; b < blocks.size(); ++b)
    {
        const LaneVector away = blocks[b] - centers;
        const Lanes distance2 = dot(away, away);
        const LaneMask farther = distance2 > farthest2;
        const auto number = static_cast<int32_t>(b);
        farthest2 = farther ? distance2 : farthest2;
        block_of_farthest = farther ? LaneMask{number, number, number, number} : block_of_farthest;
    }
    size_t lane = 0;
    for (size_t k = 1; k < kLanes; ++k)
        if (farthest2[k] > farthest2[lane])
            lane = k;
    const LaneVector& block = blocks[static_cast<size_t>(block_of_farthest[lane])];
    return {{block.x[lane], block.y[lane], block.z[lane]}, std::sqrt(farthest2[lane])};
}

double radiusAround(Float3 center, std::span<const Sphere> spheres)
{
    double radius = 0;
    for (const Sphere& sphere : spheres)
        radius = std::max(radius, length(widen(sphere.center) - widen(center)) + sphere.radius);
    return radius;
}

struct Plane
{
    Double3 normal; ///< unit
    Double3 point;
};

/// Planes of the triangles that have a normal in double arithmetic.
std::vector<Plane> planesOf(std::span<const Float3> places)
{
    std::vector<Plane> planes;
    planes.reserve(places.size() / 3);
    for (size_t i = 0; i + 2 < places.size(); i += 3)
    {
        const Double3 a = widen(places[i]);
        const Double3 normal = cross(widen(places[i + 1]) - a, widen(places[i + 2]) - a);
        if (const double area = length(normal); area > 0)
            planes.push_back({normal * (1 / area), a});
    }
    return planes;
}

struct LeastCosine
{
    double cosine = 1;
    Double3 normal; ///< the one farthest from the axis
};

LeastCosine leastCosine(Double3 axis, std::span<const Plane> planes)
{
    LeastCosine least{dot(axis, planes.front().normal), planes.front().normal};
    for (const Plane& plane : planes.subspan(1))
        if (const double cosine = dot(axis, plane.normal); cosine < least.cosine)
            least = {cosine, plane.normal};
    return least;
}

/// An axis near the one with the narrowest cone: the mean normal, then steps towards the farthest normal.
Double3 coneAxis(std::span<const Plane> planes)
{
    Double3 axis;
    for (const Plane& plane : planes)
        axis = axis + plane.normal;
    const double sum = length(axis);
    if (!(sum > 1e-6))
        return {};
    axis = axis * (1 / sum);
    Double3 best = axis;
    LeastCosine least = leastCosine(axis, planes);
    double best_cosine = least.cosine;
    for (int step = 1; step <= 6; ++step)
    {
        axis = axis + (least.normal - axis) * (0.5 / (step + 1));
        axis = axis * (1 / length(axis));
        least = leastCosine(axis, planes);
        if (least.cosine > best_cosine)
        {
            best = axis;
            best_cosine = least.cosine;
        }
    }
    return best;
}

} // namespace

float roundUp(double value)
{
    constexpr float kLargest = std::numeric_limits<float>::max();
    if (!(value < kLargest))
        return kLargest;
    const auto rounded = static_cast<float>(value);
    return rounded >= value ? rounded : std::nextafter(rounded, kLargest);
}

Sphere sphereOfPoints(std::span<const Float3> points)
{
    HEARTH_ASSERT(!points.empty());
    const WideSphere start = ritterSphere(points);
    const std::vector<LaneVector> blocks = relativeTo(start, points);
    Float3 best;
    float best_radius = 1;
    Float3 center;
    for (int step = 1; step <= kSphereSteps; ++step)
    {
        const Farthest farthest = farthestFrom(center, blocks);
        if (farthest.distance < best_radius)
        {
            best = center;
            best_radius = farthest.distance;
        }
        center += (farthest.point - center) * (0.3f / static_cast<float>(step + 1));
    }
    return storedSphere(start.center + widen(best) * start.radius, points);
}

Sphere sphereOfSpheres(std::span<const Sphere> spheres, const Sphere& start)
{
    HEARTH_ASSERT(!spheres.empty());
    Double3 middle;
    for (const Sphere& sphere : spheres)
        middle = middle + widen(sphere.center) * (1.0 / static_cast<double>(spheres.size()));
    const double radius_of_start = radiusAround(start.center, spheres);
    // steps towards the sphere that reaches farthest
    Double3 best = widen(start.center);
    double best_radius = radius_of_start;
    for (int step = 1; step <= kSphereSteps; ++step)
    {
        const Sphere* farthest = &spheres.front();
        double reach = 0;
        for (const Sphere& sphere : spheres)
            if (const double r = length(widen(sphere.center) - middle) + sphere.radius; r > reach)
            {
                reach = r;
                farthest = &sphere;
            }
        if (reach < best_radius)
        {
            best = middle;
            best_radius = reach;
        }
        middle = middle + (widen(farthest->center) - middle) * (0.5 / (step + 1));
    }
    const Float3 stored = narrow(best);
    return {stored, roundUp(radiusAround(stored, spheres))};
}

void growToHold(Sphere& sphere, std::span<const Float3> points)
{
    const float radius = storedSphere(widen(sphere.center), points).radius;
    if (radius > sphere.radius)
        sphere.radius = roundUp(radius * kMonotoneSlack);
}

NormalCone coneOfTriangles(std::span<const Float3> places, Float3 middle)
{
    NormalCone cone;
    const std::vector<Plane> planes = planesOf(places);
    // a triangle too thin for a normal in double could face anywhere
    if (planes.empty() || planes.size() * 3 != places.size())
        return cone;
    const Double3 wide_axis = coneAxis(planes);
    if (!(length(wide_axis) > 0))
        return cone;
    cone.axis = formats::NormalCode<8>::encode(narrow(wide_axis));
    Double3 axis = widen(formats::NormalCode<8>::decode(cone.axis));
    axis = axis * (1 / length(axis));
    const double cosine = std::min(1.0, leastCosine(axis, planes).cosine);
    if (cosine <= kMinConeCosine)
        return cone;

    double reach = 0;
    double back = 0;
    for (const Plane& plane : planes)
    {
        const Double3 away = widen(middle) - plane.point;
        reach = std::max(reach, length(away));
        back = std::max(back, dot(away, plane.normal) / dot(axis, plane.normal));
    }
    // room for the runtime's arithmetic
    const double magnitude = length(widen(middle)) + reach + back;
    cone.back = back + 1e-5 * (reach + back) + magnitude * 4e-7 / cosine;
    cone.cutoff = std::min(1.0, std::sqrt(std::max(0.0, 1 - cosine * cosine)) + kConeMargin);
    return cone;
}

void setBounds(formats::ClusterRecord& record, double grid_step, std::span<const Float3> points,
               std::span<const Float3> places, bool wide)
{
    HEARTH_ASSERT(!points.empty());
    Box3 box;
    for (const Float3 point : points)
        box.add(point);
    int64_t steps[3];
    for (int axis = 0; axis < 3; ++axis)
    {
        record.base[axis] = static_cast<int32_t>(box.min[axis] / grid_step);
        steps[axis] = static_cast<int64_t>(box.max[axis] / grid_step) - record.base[axis];
    }
    const auto most = static_cast<uint64_t>(*std::max_element(std::begin(steps), std::end(steps)));
    uint32_t shift = wide ? 1 : 0;
    while (most > uint64_t{0xFFFF} << shift)
        ++shift;
    record.extent_shift = static_cast<uint8_t>(shift);
    for (int axis = 0; axis < 3; ++axis)
        record.extent[axis] = static_cast<uint16_t>((steps[axis] + (int64_t{1} << shift) - 1) >> shift);

    const NormalCone cone =
        coneOfTriangles(places, formats::boxOf(record, static_cast<float>(grid_step)).center());
    const double cutoff = std::ceil(cone.cutoff * 65536);
    const double back = std::ceil(cone.back / (grid_step * formats::kConeBackSteps * (1 << shift)));
    const bool fits = cutoff < formats::kNoCone && back <= 0xFFFF;
    record.cone_axis = static_cast<uint16_t>(cone.axis);
    record.cone_cutoff = fits ? static_cast<uint16_t>(cutoff) : formats::kNoCone;
    record.cone_back = fits ? static_cast<uint16_t>(back) : uint16_t{0};
}

} // namespace hearth::clusters
