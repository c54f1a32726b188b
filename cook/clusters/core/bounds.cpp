// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/bounds.h"

#include "cook/clusters/core/lanes.h"
#include "formats/base/assert.h"
#include "formats/base/double3.h"
#include "formats/codecs/cluster_bounds.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hearth::clusters
{

namespace
{

// More steps shrink the sphere by less than 1 % of its radius.
constexpr int kSphereSteps = 12;

// The rasteriser snaps corners to 1/256 pixel, which can flip slivers that are seen edge-on.
constexpr double kConeMargin = 1e-3;

// Wider cones than about 84 degrees cull next to nothing.
constexpr double kMinConeCosine = 0.1;

struct DoubleSphere
{
    Double3 center;
    double radius = 0;
};

/// Grow the sphere just enough to contain a point.
void growToPoint(DoubleSphere& sphere, Double3 point)
{
    const Double3 away = point - sphere.center;
    if (dot(away, away) <= sphere.radius * sphere.radius)
        return;
    const double distance = length(away);
    const double radius = (sphere.radius + distance) * 0.5;
    sphere.center = sphere.center + away * ((radius - sphere.radius) / distance);
    sphere.radius = radius;
}

DoubleSphere ritterSphere(std::span<const Float3> points)
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
    DoubleSphere sphere;
    for (int axis = 0; axis < 3; ++axis)
    {
        const Double3 a = widen(points[low[axis]]);
        const Double3 b = widen(points[high[axis]]);
        if (const double radius = length(b - a) * 0.5; radius >= sphere.radius)
            sphere = {(a + b) * 0.5, radius};
    }
    for (const Float3 p : points)
        growToPoint(sphere, widen(p));
    return sphere;
}

/// Return the sphere with its center rounded to floats and the radius that this center needs.
Sphere roundedSphere(Double3 center, std::span<const Float3> points)
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

/// Return the points relative to a sphere around them, four side by side. Floats suffice to search for a
/// better center.
std::vector<LaneVector> toUnitSphere(const DoubleSphere& sphere, std::span<const Float3> points)
{
    const double scale = sphere.radius > 0 ? 1 / sphere.radius : 0;
    std::vector<LaneVector> blocks((points.size() + kLanes - 1) / kLanes);
    for (size_t i = 0; i < blocks.size() * kLanes; ++i)
    {
        // unused lanes repeat the last point
        const Float3 place = narrow((widen(points[std::min(i, points.size() - 1)]) - sphere.center) * scale);
        LaneVector& block = blocks[i / kLanes];
        block.x[i % kLanes] = place.x;
        block.y[i % kLanes] = place.y;
        block.z[i % kLanes] = place.z;
    }
    return blocks;
}

struct FarthestPoint
{
    Float3 point;
    float distance = 0;
};

FarthestPoint findFarthest(Float3 center, std::span<const LaneVector> blocks)
{
    const LaneVector centers = splat(center);
    Lanes farthest2 = splat(-1);
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

using Pair = double __attribute__((vector_size(2 * sizeof(double))));

/// Two vectors side by side.
struct PairVector
{
    Pair x, y, z;
};
PairVector operator-(const PairVector& a, const PairVector& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Pair dot(const PairVector& a, const PairVector& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
PairVector cross(const PairVector& a, const PairVector& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
PairVector makePair(Float3 a, Float3 b)
{
    return {Pair{a.x, b.x}, Pair{a.y, b.y}, Pair{a.z, b.z}};
}
PairVector makePair(Double3 a)
{
    return {Pair{a.x, a.x}, Pair{a.y, a.y}, Pair{a.z, a.z}};
}

/// The planes of two triangles.
struct PlanePair
{
    PairVector normal; ///< unit
    PairVector point;
};

/// Compute the planes of the triangles, the last one twice if their number is odd. Empty if a triangle has no
/// normal in double precision.
std::vector<PlanePair> computePlanes(std::span<const Float3> corners)
{
    std::vector<PlanePair> planes((corners.size() / 3 + 1) / 2);
    for (size_t i = 0; i < planes.size(); ++i)
    {
        const Float3* const first = &corners[6 * i];
        const Float3* const second = &corners[std::min(6 * i + 3, corners.size() - 3)];
        const PairVector a = makePair(first[0], second[0]);
        const PairVector normal = cross(makePair(first[1], second[1]) - a, makePair(first[2], second[2]) - a);
        const Pair area2 = dot(normal, normal);
        const Pair area{std::sqrt(area2[0]), std::sqrt(area2[1])};
        if (!(area[0] > 0 && area[1] > 0))
            return {};
        planes[i] = {{normal.x / area, normal.y / area, normal.z / area}, a};
    }
    return planes;
}

/// Return the normals, four side by side; unused lanes repeat the last. Floats suffice to search for an axis.
std::vector<LaneVector> gatherNormals(std::span<const PlanePair> planes)
{
    std::vector<LaneVector> blocks((planes.size() + 1) / 2);
    for (size_t i = 0; i < blocks.size(); ++i)
    {
        const PairVector& first = planes[2 * i].normal;
        const PairVector& second = planes[std::min(2 * i + 1, planes.size() - 1)].normal;
        const auto four = [](Pair a, Pair b)
        {
            return Lanes{static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(b[0]),
                         static_cast<float>(b[1])};
        };
        blocks[i] = {four(first.x, second.x), four(first.y, second.y), four(first.z, second.z)};
    }
    return blocks;
}

struct MinCosine
{
    float cosine = 1;
    Float3 normal; ///< the normal farthest from the axis
};

MinCosine findMinCosine(Float3 axis, std::span<const LaneVector> normals)
{
    const LaneVector axes = splat(axis);
    Lanes least = splat(2);
    LaneMask block_of_least{};
    for (size_t b = 0; b < normals.size(); ++b)
    {
        const Lanes cosine = dot(axes, normals[b]);
        const LaneMask less = cosine < least;
        const auto number = static_cast<int32_t>(b);
        least = less ? cosine : least;
        block_of_least = less ? LaneMask{number, number, number, number} : block_of_least;
    }
    size_t lane = 0;
    for (size_t k = 1; k < kLanes; ++k)
        if (least[k] < least[lane])
            lane = k;
    const LaneVector& block = normals[static_cast<size_t>(block_of_least[lane])];
    return {least[lane], {block.x[lane], block.y[lane], block.z[lane]}};
}

/// Find an axis near that of the narrowest cone: start at the mean normal, then step towards the farthest
/// normal.
Float3 findConeAxis(std::span<const LaneVector> normals)
{
    LaneVector sums{};
    for (const LaneVector& block : normals)
        sums = sums + block;
    const Float3 sum{sumOfLanes(sums.x), sumOfLanes(sums.y), sumOfLanes(sums.z)};
    if (!(length(sum) > 1e-4f))
        return {};
    Float3 axis = sum / length(sum);
    Float3 best = axis;
    MinCosine least = findMinCosine(axis, normals);
    float best_cosine = least.cosine;
    for (int step = 1; step <= 6; ++step)
    {
        axis += (least.normal - axis) * (0.5f / static_cast<float>(step + 1));
        axis = axis / length(axis);
        least = findMinCosine(axis, normals);
        if (least.cosine > best_cosine)
        {
            best = axis;
            best_cosine = least.cosine;
        }
    }
    return best;
}

} // namespace

Sphere sphereOfPoints(std::span<const Float3> points)
{
    HEARTH_ASSERT(!points.empty());
    const DoubleSphere start = ritterSphere(points);
    const std::vector<LaneVector> blocks = toUnitSphere(start, points);
    Float3 best;
    float best_radius = 1;
    Float3 center;
    for (int step = 1; step <= kSphereSteps; ++step)
    {
        const FarthestPoint farthest = findFarthest(center, blocks);
        if (farthest.distance < best_radius)
        {
            best = center;
            best_radius = farthest.distance;
        }
        center += (farthest.point - center) * (0.3f / static_cast<float>(step + 1));
    }
    const Sphere sphere = roundedSphere(start.center + widen(best) * start.radius, points);
    HEARTH_ASSERT(sphere.radius >= 0);
    return sphere;
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
    const Sphere result{stored, roundUp(radiusAround(stored, spheres))};
    HEARTH_ASSERT(result.radius >= 0);
    return result;
}

void growToContain(Sphere& sphere, std::span<const Float3> points)
{
    const float radius = roundedSphere(widen(sphere.center), points).radius;
    if (radius > sphere.radius)
        sphere.radius = roundUp(radius * kMonotoneSlack);
}

NormalCone computeNormalCone(std::span<const Float3> corners, Float3 middle)
{
    HEARTH_ASSERT(corners.size() % 3 == 0);
    NormalCone cone;
    const std::vector<PlanePair> planes = computePlanes(corners);
    // a triangle too thin for a normal in double precision could face anywhere
    if (planes.empty())
        return cone;
    const Float3 near_axis = findConeAxis(gatherNormals(planes));
    if (!(length(near_axis) > 0))
        return cone;
    cone.axis = formats::NormalCode<8>::encode(near_axis);
    Double3 axis = widen(formats::NormalCode<8>::decode(cone.axis));
    axis = axis * (1 / length(axis));

    Pair cosines{1, 1};
    Pair reaches2{};
    Pair backs{};
    const PairVector axes = makePair(axis);
    const PairVector middles = makePair(widen(middle));
    for (const PlanePair& plane : planes)
    {
        const PairVector away = middles - plane.point;
        const Pair cosine = dot(axes, plane.normal);
        const Pair reach2 = dot(away, away);
        // meaningless where the cosine is not positive, but then there is no cone
        const Pair back = dot(away, plane.normal) / cosine;
        cosines = cosine < cosines ? cosine : cosines;
        reaches2 = reach2 > reaches2 ? reach2 : reaches2;
        backs = back > backs ? back : backs;
    }
    const double cosine = std::min(cosines[0], cosines[1]);
    const double back = std::max(backs[0], backs[1]);
    if (cosine <= kMinConeCosine)
        return cone;
    const double reach = std::sqrt(std::max(reaches2[0], reaches2[1]));
    // margin for the runtime's arithmetic
    const double magnitude = length(widen(middle)) + reach + back;
    cone.back = back + 1e-5 * (reach + back) + magnitude * 4e-7 / cosine;
    cone.cutoff = std::min(1.0, std::sqrt(std::max(0.0, 1 - cosine * cosine)) + kConeMargin);
    HEARTH_ASSERT(cone.cutoff > 0 && cone.back >= 0);
    return cone;
}

void setBounds(formats::ClusterRecord& record, double grid_step, std::span<const Float3> points,
               std::span<const Float3> corners, bool wide)
{
    HEARTH_ASSERT(!points.empty() && grid_step > 0);
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
    HEARTH_ASSERT(shift <= 16);
    record.extent_shift = static_cast<uint8_t>(shift);
    for (int axis = 0; axis < 3; ++axis)
        record.extent[axis] = static_cast<uint16_t>((steps[axis] + (int64_t{1} << shift) - 1) >> shift);

    const NormalCone cone =
        computeNormalCone(corners, formats::clusterBox(record, static_cast<float>(grid_step)).center());
    const double cutoff = std::ceil(cone.cutoff * 65536);
    const double back = std::ceil(cone.back / (grid_step * formats::kConeBackSteps * (1 << shift)));
    const bool fits = cutoff < formats::kNoCone && back <= 0xFFFF;
    record.cone_axis = static_cast<uint16_t>(cone.axis);
    record.cone_cutoff = fits ? static_cast<uint16_t>(cutoff) : formats::kNoCone;
    record.cone_back = fits ? static_cast<uint16_t>(back) : uint16_t{0};
}

} // namespace hearth::clusters
