// Tests how many pixels a UV unit is said to cover, and the reach of boxes behind it, against doubles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/double3.h"
#include "formats/base/scale_bound.h"
#include "formats/gpu_shared/decisions.h"
#include "runtime/frame/frame.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr float kGridStep = 1.0f / 256;
constexpr float kPi = 3.14159265f;

class Random
{
public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    uint32_t below(uint32_t count) { return static_cast<uint32_t>(engine_() % count); }
    Float3 point(float reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }

private:
    std::mt19937 engine_;
};

enum class Shape
{
    turned,    ///< a rotation, possibly mirrored, with one scale
    stretched, ///< a rotation with three scales
    sheared,   ///< any matrix
};

Affine3 randomPlace(Random& random, Shape shape)
{
    Affine3 place;
    const Float3 x = normalizeOr(random.point(1), {1, 0, 0});
    const Float3 y = normalizeOr(cross(x, random.point(1)), {0, 1, 0});
    const Float3 axes[3] = {x, y, cross(x, y)};
    const float scale = std::exp2(random.in(-3, 3));
    const float mirrored = random.below(2) == 0 ? -1.0f : 1.0f;
    for (int column = 0; column < 3; ++column)
    {
        const float stretch = shape == Shape::turned ? scale : scale * std::exp2(random.in(-2, 2));
        for (int row = 0; row < 3; ++row)
            place.m[row][column] =
                mirrored * stretch * (shape == Shape::sheared ? random.in(-1, 1) : axes[column][row]);
    }
    for (auto& row : place.m)
        row[3] = random.in(-20, 20);
    return place;
}

/// Instance of one cluster, and a view.
struct Placed
{
    formats::InstanceRecord record{};
    Instance instance;
    InstanceState state;
    Cluster cluster{};
    FrameView view;

    Placed(const Affine3& place, Float3 box_min, Float3 box_max, const Camera& camera)
    {
        record.world_from_object = place;
        record.scale_max = scaleBound(place);
        std::memcpy(static_cast<void*>(&instance), &record, sizeof(instance));
        view = makeFrameView(camera, 1280, 720, 1, 1);
        formats::ClusterRecord cluster_record{};
        for (int axis = 0; axis < 3; ++axis)
        {
            cluster_record.base[axis] = static_cast<int32_t>(std::floor(box_min[axis] / kGridStep));
            const auto end = static_cast<int32_t>(std::ceil(box_max[axis] / kGridStep));
            cluster_record.extent[axis] = static_cast<uint16_t>(end - cluster_record.base[axis]);
        }
        std::memcpy(static_cast<void*>(&cluster), &cluster_record, sizeof(cluster));
        const MeshBounds bounds{box_min, kGridStep, box_max, 0};
        state = decideInstance(view, instance, makeInstanceInverse(record), bounds);
    }

    TexelReach reach() const { return clusterReach(view, instance, state, cluster); }

    /// Return a point of the box relative to the eye; each coordinate from 0 to 1.
    Double3 pointOfBox(const double (&along)[3]) const
    {
        const Float3 low = clusterBoxMin(cluster, kGridStep), high = clusterBoxMax(cluster, kGridStep);
        const auto& m = record.world_from_object.m;
        double at[3], relative[3];
        for (int i = 0; i < 3; ++i)
            at[i] = double{low[i]} + along[i] * (double{high[i]} - double{low[i]});
        for (int row = 0; row < 3; ++row)
            relative[row] = double{m[row][0]} * at[0] + double{m[row][1]} * at[1] +
                            double{m[row][2]} * at[2] + double{m[row][3]} - double{view.eye[row]};
        return {relative[0], relative[1], relative[2]};
    }

    /// Return the distance to the nearest point of the box, or a little more: along one axis after the other,
    /// from several starts, since thin matrices converge slowly.
    double nearest() const
    {
        double best = std::numeric_limits<double>::infinity();
        for (int corner = 0; corner < 8; ++corner)
        {
            double at[3] = {corner & 1 ? 1.0 : 0.0, corner & 2 ? 1.0 : 0.0, corner & 4 ? 1.0 : 0.0};
            for (int step = 0; step < 300; ++step)
            {
                const int i = step % 3;
                double start[3] = {at[0], at[1], at[2]}, end[3] = {at[0], at[1], at[2]};
                start[i] = 0;
                end[i] = 1;
                const Double3 from = pointOfBox(start), edge = pointOfBox(end) - from;
                const double squares = dot(edge, edge);
                at[i] = squares > 0 ? std::clamp(-dot(from, edge) / squares, 0.0, 1.0) : 0;
            }
            best = std::min(best, length(pointOfBox(at)));
        }
        return best;
    }
};

Camera cameraAt(Float3 eye, Float3 target, float y_fov)
{
    return {.position = eye, .target = target, .y_fov_rad = y_fov, .z_near = 0.0625f};
}

/// Cluster that the view sees, of any size and at any distance.
Placed randomCluster(Random& random, Shape shape)
{
    const Float3 middle = random.point(3);
    const Float3 half{std::exp2(random.in(-5, 1)), std::exp2(random.in(-5, 1)), std::exp2(random.in(-5, 1))};
    const Affine3 place = randomPlace(random, shape);
    const Float3 near = transformPoint(place, middle);
    const Float3 eye = near + random.point(1) * std::exp2(random.in(-4, 6));
    const Float3 target = near + random.point(0.7f) * length(near - eye);
    return {place, middle - half, middle + half, cameraAt(eye, target, random.in(0.3f, 2.2f))};
}

/// Project a point relative to the eye to pixels.
std::pair<double, double> project(const FrameView& view, Double3 p)
{
    const auto row = [&](const Float4& r)
    { return double{r.x} * p.x + double{r.y} * p.y + double{r.z} * p.z; };
    const double w = row(view.clip_w);
    return {row(view.clip_x) / w * 0.5 * double{view.width},
            row(view.clip_y) / w * 0.5 * double{view.height}};
}

/// Return the most pixels that a metre covers at a point, over all directions: by differences of projections
/// along the directions across the line of sight.
double pixelsOfMetre(const FrameView& view, Double3 p)
{
    const double step = 1e-5 * length(p);
    const Double3 sight = p * (1 / length(p));
    const Double3 other = std::abs(sight.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    Double3 across = cross(sight, other);
    across = across * (1 / length(across));
    const Double3 up = cross(sight, across);
    double most = 0;
    for (int i = 0; i < 16; ++i)
    {
        const double turn = i * 3.141592653589793 / 16;
        const Double3 direction = across * std::cos(turn) + up * std::sin(turn);
        const auto [x0, y0] = project(view, p - direction * step);
        const auto [x1, y1] = project(view, p + direction * step);
        most = std::max(most, std::hypot(x1 - x0, y1 - y0) / (2 * step));
    }
    return most;
}

/// Half space of the points inside of a plane: dot(normal, p) + offset >= 0.
struct HalfSpace
{
    Double3 normal;
    double offset;
};

/// Return the half spaces that a box and the sides of a frustum share. The near plane is left out.
std::vector<HalfSpace> listPlanes(const Placed& placed)
{
    std::vector<HalfSpace> planes;
    for (size_t i = 0; i < 4; ++i)
    {
        const Float4& plane = placed.view.planes[i];
        planes.push_back({{double{plane.x}, double{plane.y}, double{plane.z}}, 0});
    }
    const Double3 origin = placed.pointOfBox({0, 0, 0});
    const Double3 edges[] = {placed.pointOfBox({1, 0, 0}) - origin, placed.pointOfBox({0, 1, 0}) - origin,
                             placed.pointOfBox({0, 0, 1}) - origin};
    for (int axis = 0; axis < 3; ++axis)
    {
        Double3 normal = cross(edges[(axis + 1) % 3], edges[(axis + 2) % 3]);
        if (dot(normal, edges[axis]) < 0)
            normal = normal * -1;
        planes.push_back({normal, -dot(normal, origin)});
        planes.push_back({normal * -1, dot(normal, origin + edges[axis])});
    }
    return planes;
}

/// Return the point where three planes meet, nothing if they are nearly parallel.
std::optional<Double3> meet(const HalfSpace& i, const HalfSpace& j, const HalfSpace& k)
{
    const Double3 a = cross(j.normal, k.normal), b = cross(k.normal, i.normal), c = cross(i.normal, j.normal);
    const double volume = dot(i.normal, a);
    if (std::abs(volume) < 1e-12 * length(i.normal) * length(j.normal) * length(k.normal))
        return std::nullopt;
    return (a * i.offset + b * j.offset + c * k.offset) * (-1 / volume);
}

/// Return the least depth of what the frustum holds of the cluster's box, infinity if nothing: it is that of
/// a corner of what they share.
double leastDepthInView(const Placed& placed)
{
    const std::vector<HalfSpace> planes = listPlanes(placed);
    const Float4& row = placed.view.clip_w;
    const Double3 axis{double{row.x}, double{row.y}, double{row.z}};
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < planes.size(); ++i)
        for (size_t j = i + 1; j < planes.size(); ++j)
            for (size_t k = j + 1; k < planes.size(); ++k)
            {
                const std::optional<Double3> p = meet(planes[i], planes[j], planes[k]);
                const auto is_inside = [&](const HalfSpace& plane)
                {
                    const double slack = 1e-9 * length(plane.normal) * (1 + length(*p));
                    return dot(plane.normal, *p) + plane.offset >= -slack;
                };
                if (p && std::ranges::all_of(planes, is_inside))
                    least = std::min(least, dot(axis, *p));
            }
    return least;
}

/// Return a floor or wall, thin and much larger than its distance, before an eye that looks anywhere.
Placed randomFloor(Random& random)
{
    const Affine3 place = randomPlace(random, Shape::turned);
    const Float3 half{std::exp2(random.in(0, 5)), std::exp2(random.in(0, 5)), kGridStep};
    const auto point = [&](float height) {
        return transformPoint(place, {random.in(-1, 1) * half.x, random.in(-1, 1) * half.y, height});
    };
    Camera camera = cameraAt(point(random.in(0.1f, 3)), point(random.in(-3, 3)), random.in(0.5f, 1.9f));
    if (random.below(4) > 0) // upright
        camera.up = {place.m[0][2], place.m[1][2], place.m[2][2]};
    return {place, half * -1, half, camera};
}

/// Octaves by which bounds of depths are too small, and by which those would be that know of no frustum.
struct DepthErrors
{
    double mean = 0, worst = 0, mean_without = 0;
};

DepthErrors measureDepths(Random& random, size_t count, Placed (*makePlaced)(Random&))
{
    DepthErrors errors;
    size_t seen = 0;
    for (size_t trial = 0; trial < count; ++trial)
    {
        Placed placed = makePlaced(random);
        const double exact = leastDepthInView(placed), near = double{placed.view.z_near};
        if (std::isinf(exact))
            continue;
        ++seen;
        const auto octavesBeyond = [&](double depth)
        { return std::log2(std::max(exact, near) / std::max(depth, near)); };
        const double depth = double{placed.reach().depth};
        EXPECT_LE(depth, exact + 1e-6 * std::abs(exact));
        errors.mean += octavesBeyond(depth);
        errors.worst = std::max(errors.worst, octavesBeyond(depth));
        std::fill_n(placed.view.planes, 4, Float4{});
        errors.mean_without += octavesBeyond(double{placed.reach().depth});
    }
    EXPECT_GT(seen, count / 2);
    errors.mean /= static_cast<double>(seen);
    errors.mean_without /= static_cast<double>(seen);
    return errors;
}

double octavesOfRequest(uint32_t request)
{
    return static_cast<double>(request) / (1 << kTexelRequestBits) - kTexelRequestOctaves;
}

} // namespace

TEST(TexelRequest, logarithmsOfIntegersAreClose)
{
    Random random(3);
    double least = 1, most = -1;
    for (size_t trial = 0; trial < trials(100000); ++trial)
    {
        const float x = std::exp2(random.in(-40, 40));
        const double error = fixedLog2(x) / double{1 << kTexelRequestBits} - std::log2(double{x});
        least = std::min(least, error);
        most = std::max(most, error);
    }
    EXPECT_GT(least, -0.0081);
    EXPECT_LT(most, 0.0081);
    for (int exponent = -126; exponent < 128; ++exponent)
        ASSERT_EQ(fixedLog2(std::exp2(static_cast<float>(exponent))), exponent * (1 << kTexelRequestBits));
}

/// The oracle projects: it knows of no cosine.
TEST(TexelRequest, noPointInTheViewCoversMorePixels)
{
    Random random(7);
    size_t seen = 0, views = 0;
    double beyond = 0, without_cosine = 0;
    for (size_t trial = 0; trial < trials(400); ++trial)
    {
        const auto shape = static_cast<Shape>(random.below(3));
        const Placed placed = randomCluster(random, shape);
        const auto code = static_cast<uint32_t>(100 + random.below(60));
        const uint32_t request = texelRequest(placed.view, placed.instance, code, placed.reach());
        const double density = std::exp2((static_cast<int>(code) - 128.0) / 8);
        const double claimed = octavesOfRequest(request) + double{kTexelRequestError};
        double largest = -1e9;
        for (int sample = 0; sample < 100; ++sample)
        {
            const double along[3] = {double{random.in(0, 1)}, double{random.in(0, 1)},
                                     double{random.in(0, 1)}};
            const Double3 p = placed.pointOfBox(along);
            bool inside = true;
            for (const Float4& plane : placed.view.planes)
                inside = inside && double{plane.x} * p.x + double{plane.y} * p.y + double{plane.z} * p.z +
                                           double{plane.w} >=
                                       0;
            if (!inside)
                continue;
            ++seen;
            const double pixels = pixelsOfMetre(placed.view, p) * double{placed.instance.scale_max} / density;
            largest = std::max(largest, std::log2(pixels));
        }
        if (largest < -1e8)
            continue;
        ++views;
        ASSERT_GE(claimed, largest);
        beyond += claimed - largest;
        TexelReach flat = placed.reach();
        flat.depth = flat.farthest = std::max(flat.distance, placed.view.z_near);
        const double facing = octavesOfRequest(texelRequest(placed.view, placed.instance, code, flat));
        without_cosine += facing + double{kTexelRequestError} < largest ? 1 : 0;
    }
    EXPECT_GT(seen, trials(400) * 10);
    EXPECT_GT(without_cosine, 0.1 * static_cast<double>(views)) << "or no view looks aside";
    RecordProperty("mean_octaves_beyond", std::to_string(beyond / static_cast<double>(views)));
    EXPECT_LT(beyond, 1.1 * static_cast<double>(views)) << "of boxes as large as they are near";
}

TEST(TexelRequest, extremesStayInRangeAndOrder)
{
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    FrameView view{};
    view.z_near = 1e-30f;
    view.lod_scale = 1000;
    view.corner_cosine = 1;
    Instance instance{};
    const auto reach = [](float d) { return TexelReach{d, d, d}; };
    EXPECT_EQ(texelRequest(view, instance, 0, reach(1)), 0u) << "no UVs";
    EXPECT_EQ(texelRequest(view, instance, 128, reach(10)), 1u) << "an instance without a size";
    instance.scale_max = 1;
    EXPECT_EQ(texelRequest(view, instance, 255, reach(kInfinity)), 1u);
    EXPECT_GT(texelRequest(view, instance, 1, reach(0)), texelRequest(view, instance, 128, reach(1e-20f)));
    view.corner_cosine = 0;
    EXPECT_GE(texelRequest(view, instance, 1, {0, kInfinity, 0}), texelRequest(view, instance, 1, {0, 1, 0}));
}

TEST(TexelRequest, noDistanceIsGreaterThanThatOfTheNearestPoint)
{
    Random random(4);
    for (const Shape shape : {Shape::turned, Shape::stretched, Shape::sheared})
    {
        double whole = 0, found = 0;
        for (size_t trial = 0; trial < trials(150); ++trial)
        {
            const Placed placed = randomCluster(random, shape);
            const TexelReach reach = placed.reach();
            const double exact = placed.nearest(), distance = double{reach.distance};
            ASSERT_LE(distance, exact);
            if (shape != Shape::sheared)
            {
                ASSERT_GE(distance, exact * 0.9999 - 1e-3 * double{placed.instance.scale_max})
                    << "it is exact where axes stay perpendicular";
            }
            for (int corner = 0; corner < 8; ++corner)
            {
                const Double3 p = placed.pointOfBox(
                    {corner & 1 ? 1.0 : 0.0, corner & 2 ? 1.0 : 0.0, corner & 4 ? 1.0 : 0.0});
                ASSERT_LE(length(p), double{reach.farthest});
            }
            whole += exact;
            found += distance;
        }
        EXPECT_GT(found, whole * (shape == Shape::sheared ? 0.7 : 0.999));
    }
}

/// The oracle lists the corners of what box and frustum share.
TEST(TexelRequest, depthIsThatOfWhatTheViewSees)
{
    Random random(12);
    const DepthErrors boxes = measureDepths(
        random, trials(1500), [](Random& r) { return randomCluster(r, static_cast<Shape>(r.below(3))); });
    EXPECT_LT(boxes.mean, 0.002);
    EXPECT_GT(boxes.mean_without, 0.2);
    const DepthErrors floors = measureDepths(random, trials(1500), randomFloor);
    EXPECT_LT(floors.mean, 0.005);
    EXPECT_LT(floors.worst, 0.1);
    EXPECT_GT(floors.mean_without, 2) << "most floors reach below the eye";
}

/// The box along the axes of the world holds the eye.
TEST(TexelRequest, aTurnedWallIsAsFarAwayAsItLooks)
{
    Affine3 place;
    const float turn = std::sqrt(0.5f);
    const float rows[3][3] = {{turn, 0, turn}, {0, 1, 0}, {-turn, 0, turn}};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            place.m[row][column] = rows[row][column];
    const Float3 eye{4 * turn, 0, 4 * turn}; // before the middle of the wall, along its normal
    Placed wall(place, {-5, -5, -0.0625f}, {5, 5, 0}, cameraAt(eye, {0, 0, 0}, kPi / 3));
    EXPECT_NEAR(wall.reach().distance, 4, 1e-3);
    EXPECT_NEAR(wall.reach().depth, 4, 1e-3);
    EXPECT_EQ(eyeBoxDistance(toEyeBox(wall.view, wall.instance, {-5, -5, -0.0625f}, {5, 5, 0})), 0);
    wall.state.cone_valid = 0;
    EXPECT_EQ(wall.reach().distance, 0) << "without an inverse the box along the axes of the world is left";
}

} // namespace hearth::test
