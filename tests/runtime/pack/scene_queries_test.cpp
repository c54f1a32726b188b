// Tests rays against the triangles of a pack, and bounds, by a search of all triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/scene_queries.h"

#include "runtime/pack/cut.h"
#include "tests/reference/pack_geometry.h"
#include "tests/runtime/gpu/cooked_mesh.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace hearth::test
{

namespace
{

using pack::CastOptions;
using pack::Ray;
using pack::SceneQueries;
using pack::SurfacePoint;

constexpr uint64_t kRoomy = 64 << 20; ///< bytes: holds all pages of a test

/// Triangle in the world, with the name that queries give it.
struct WorldTriangle
{
    pack::TriangleId id;
    std::array<Double3, 3> corners;
};

/// Point of a ray on the plane of a triangle: t, and the weights of the corners.
struct PlanePoint
{
    double t;
    std::array<double, 3> weights;
    double least() const { return std::min({weights[0], weights[1], weights[2]}); }
};

/// Cramer's rule for origin + t direction = a + v (b - a) + w (c - a).
std::optional<PlanePoint> meetPlane(const Ray& ray, const std::array<Double3, 3>& corners)
{
    const Double3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], s = ray.origin - corners[0];
    const Double3 p = cross(ray.direction, e2), q = cross(s, e1);
    const double det = dot(e1, p);
    if (det == 0)
        return std::nullopt;
    const double v = dot(s, p) / det, w = dot(ray.direction, q) / det;
    return PlanePoint{dot(e2, q) / det, {1 - v - w, v, w}};
}

/// Vertices of a cluster of an instance in the world.
using Positions =
    std::function<Double3(const formats::ClusterGeometry& geometry, uint32_t instance, uint32_t vertex)>;

Positions placedBy(std::vector<Affine3> transforms)
{
    return [transforms](const formats::ClusterGeometry& geometry, uint32_t instance, uint32_t vertex)
    { return transformPoint(widened(transforms[instance]), widen(geometry.position(vertex))); };
}

std::vector<Affine3> readTransforms(const formats::PackView& view)
{
    std::vector<Affine3> transforms;
    for (const formats::InstanceRecord& instance : view.instances())
        transforms.push_back(instance.world_from_object);
    return transforms;
}

std::vector<uint32_t> sourceClusters(const formats::PackView& view, uint32_t mesh)
{
    const formats::Range range = view.meshes()[mesh].clusters;
    std::vector<uint32_t> clusters;
    for (uint32_t c = range.first; c < range.first + range.count; ++c)
        if (view.clusters()[c].level == 0)
            clusters.push_back(c);
    return clusters;
}

/// List the triangles of all instances.
/// clusters  of a mesh that are drawn
template <typename Clusters>
std::vector<WorldTriangle> listTriangles(const formats::PackView& view, const Positions& positions,
                                         const Clusters& clusters)
{
    const auto geometry = reference::PackGeometry::decode(view);
    HEARTH_ASSERT(geometry.ok());
    std::vector<WorldTriangle> triangles;
    for (uint32_t i = 0; i < view.instances().size(); ++i)
        for (const uint32_t c : clusters(view, view.instances()[i].mesh))
        {
            const formats::ClusterGeometry cluster = geometry->cluster(c);
            for (uint32_t t = 0; t < cluster.triangleCount(); ++t)
            {
                const auto [x, y, z] = cluster.triangle(t);
                triangles.push_back(
                    {{i, c, t},
                     {positions(cluster, i, x), positions(cluster, i, y), positions(cluster, i, z)}});
            }
        }
    return triangles;
}

std::vector<WorldTriangle> listTriangles(const formats::PackView& view, const Positions& positions)
{
    return listTriangles(view, positions, sourceClusters);
}

/// Result of a search of all triangles: the nearest t, and the nearest if triangles were a little larger or
/// smaller.
struct Nearest
{
    double exact = std::numeric_limits<double>::infinity();
    double grown = exact, shrunk = exact;
};

constexpr double kEdge = 1e-9; // far above the rounding of doubles, far below a triangle

Nearest searchAll(const std::vector<WorldTriangle>& triangles, const Ray& ray)
{
    Nearest nearest;
    for (const WorldTriangle& triangle : triangles)
    {
        const auto met = meetPlane(ray, triangle.corners);
        if (!met || !(met->t >= ray.begin && met->t < ray.end))
            continue;
        const double least = met->least();
        if (least >= -kEdge)
            nearest.grown = std::min(nearest.grown, met->t);
        if (least >= 0)
            nearest.exact = std::min(nearest.exact, met->t);
        if (least >= kEdge)
            nearest.shrunk = std::min(nearest.shrunk, met->t);
    }
    return nearest;
}

Double3 randomPoint(std::mt19937& random, float reach)
{
    return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

Ray randomRay(std::mt19937& random, float reach)
{
    Ray ray;
    ray.origin = randomPoint(random, reach);
    ray.direction = randomPoint(random, reach) - ray.origin;
    if (random() % 4 == 0)
        ray.direction = Double3{random() % 2 * 2.0 - 1, 0, 0}; // along an axis
    return ray;
}

/// Expect what the search of all triangles says of random rays, and that rays of both kinds are among them.
void expectRays(SceneQueries& queries, const std::vector<WorldTriangle>& triangles, uint32_t count,
                float reach, std::mt19937& random, const CastOptions& options = {})
{
    uint32_t hits = 0, ambiguous = 0;
    for (uint32_t i = 0; i < count && !testing::Test::HasFailure(); ++i)
    {
        const Ray ray = randomRay(random, reach);
        const Nearest nearest = searchAll(triangles, ray);
        if (nearest.grown != nearest.shrunk)
        {
            ++ambiguous;
            continue;
        }
        const auto found = queries.cast(ray, options);
        ASSERT_TRUE(found.ok()) << found.error().detail;
        ASSERT_EQ(found->has_value(), std::isfinite(nearest.exact)) << "ray " << i;
        CastOptions any = options;
        any.any_hit = true;
        const auto some = queries.cast(ray, any);
        ASSERT_TRUE(some.ok());
        ASSERT_EQ(some->has_value(), found->has_value()) << "ray " << i;
        if (!found->has_value())
            continue;
        ++hits;
        const SurfacePoint& point = **found;
        EXPECT_NEAR(point.t, nearest.exact, 1e-9 * (1 + nearest.exact)) << "ray " << i;
        EXPECT_GE((*some)->t, nearest.exact * (1 - 1e-9));
        const auto triangle = std::find_if(triangles.begin(), triangles.end(),
                                           [&](const WorldTriangle& t) { return t.id == point.id; });
        ASSERT_NE(triangle, triangles.end()) << "a triangle that is not drawn";
        const auto met = meetPlane(ray, triangle->corners);
        ASSERT_TRUE(met.has_value());
        EXPECT_NEAR(point.t, met->t, 1e-9 * (1 + met->t));
        for (size_t corner = 0; corner < 2; ++corner)
            EXPECT_NEAR(point.weights[corner], met->weights[corner + 1], 1e-6);
        EXPECT_LT(length(point.position - (ray.origin + ray.direction * met->t)),
                  1e-9 * (1 + length(point.position)));
        const Double3 normal =
            cross(triangle->corners[1] - triangle->corners[0], triangle->corners[2] - triangle->corners[0]);
        EXPECT_NEAR(std::abs(dot(point.normal, normal)), length(normal), 1e-9 * length(normal));
    }
    EXPECT_GT(hits, count / 20) << "or little is tested";
    EXPECT_LT(hits + ambiguous, count) << "some miss";
}

/// Rocks and a terrain at random places, some mirrored.
class RockScene
{
public:
    explicit RockScene(uint32_t seed) : random(seed)
    {
        formats::MaterialRecord two_sided = plainMaterial();
        two_sided.flags = formats::kMaterialDoubleSided;
        const uint32_t plain_material = scene.addMaterial(plainMaterial());
        const uint32_t sheet = scene.addMaterial(two_sided);
        const uint32_t meshes[] = {scene.addMesh(withMaterial(shapes::rock(14, 0.3f), plain_material)),
                                   scene.addMesh(withMaterial(shapes::terrain(24), sheet)),
                                   scene.addMesh(withMaterial(shapes::soup(40), plain_material))};
        for (uint32_t i = 0; i < 9; ++i)
            scene.addInstance(meshes[i % 3], randomAffine(random, 5));
        view.emplace(scene.build());
    }

    std::mt19937 random;
    TestScene scene;
    std::optional<formats::PackView> view;
};

constexpr uint32_t kRays = kSanitized ? 120 : 600;

} // namespace

TEST(SceneQueries, raysMeetTheNearestTriangle)
{
    RockScene test(1);
    const auto triangles = listTriangles(*test.view, placedBy(readTransforms(*test.view)));
    SceneQueries queries(*test.view, kRoomy);
    expectRays(queries, triangles, kRays, 7, test.random);
}

TEST(SceneQueries, aCacheOfOnePageFindsTheSame)
{
    RockScene test(2);
    SceneQueries roomy(*test.view, kRoomy), tight(*test.view, 0);
    for (uint32_t i = 0; i < kRays; ++i)
    {
        const Ray ray = randomRay(test.random, 7);
        const auto expected = roomy.cast(ray, {}), found = tight.cast(ray, {});
        ASSERT_TRUE(expected.ok() && found.ok());
        ASSERT_EQ(expected->has_value(), found->has_value());
        if (expected->has_value())
        {
            EXPECT_EQ((*expected)->id, (*found)->id);
            EXPECT_EQ((*expected)->t, (*found)->t);
        }
    }
}

TEST(SceneQueries, movedInstancesAreWhereTheyMoved)
{
    RockScene test(3);
    SceneQueries queries(*test.view, kRoomy);
    std::vector<Affine3> transforms = readTransforms(*test.view);
    for (int round = 0; round < 3; ++round)
    {
        for (const uint32_t instance : {1u, 4u, 6u})
        {
            transforms[instance] = randomAffine(test.random, 5);
            if (instance == 6 && round == 1)
                for (float& value : transforms[instance].m[1])
                    value = 0; // flat, in the plane y = 0
            ASSERT_TRUE(queries.states().checkMove(instance, transforms[instance]).ok());
            queries.move(instance, transforms[instance]);
        }
        expectRays(queries, listTriangles(*test.view, placedBy(transforms)), kRays / 3, 7, test.random);
    }
}

TEST(SceneQueries, raysPassBetweenNoTriangles)
{
    TestScene scene;
    scene.addInstance(scene.addMesh(plain(shapes::rock(8, 0.2f))), translated({1, 2, 3}));
    const formats::PackView view = scene.build();
    SceneQueries queries(view, kRoomy);
    const Double3 center{1, 2, 3};
    for (const WorldTriangle& triangle : listTriangles(view, placedBy(readTransforms(view))))
        for (size_t i = 0; i < 3; ++i)
        {
            const Double3 corner = triangle.corners[i], next = triangle.corners[(i + 1) % 3];
            for (const double share : {0.0, 0.25, 0.5, 0.613})
            {
                const Ray ray{.origin = center, .direction = corner + (next - corner) * share - center};
                const auto found = queries.cast(ray, {});
                ASSERT_TRUE(found.ok() && found->has_value()) << "the rock is closed";
                EXPECT_NEAR((*found)->t, 1, 1e-9);
            }
        }
}

TEST(SceneQueries, raysMeetWhatIsResident)
{
    TestScene scene;
    scene.addInstance(scene.addMesh(plain(shapes::rock(72, 0.3f))), Affine3{});
    const formats::PackView view = scene.build();
    const pack::PageGraph graph = pack::PageGraph::of(view);
    ASSERT_GT(graph.pageCount(), graph.pinned().size());
    std::mt19937 random(4);
    SceneQueries queries(view, kRoomy);
    std::set<size_t> sizes;
    for (const double chance : {0.0, 0.5, 0.7, 0.9, 1.0})
    {
        const std::vector<uint8_t> pages = randomClosedSet(graph, chance, random);
        pack::ResidentGroups resident(view);
        for (uint32_t page = 0; page < pages.size(); ++page)
            if (pages[page] != 0)
                resident.add(page);
        const auto groups = pack::residentGroups(view, pages);
        const auto triangles = listTriangles(view, placedBy(readTransforms(view)),
                                             [&](const formats::PackView& of, uint32_t m)
                                             { return pack::selectCut(of, m, 0, groups); });
        sizes.insert(triangles.size());
        expectRays(queries, triangles, kRays / 6, 2.5f, random, {.resident = &resident});
    }
    EXPECT_GE(sizes.size(), 3u) << "or the same is tested again";
}

TEST(SceneQueries, posedInstancesAreMetInTheirPose)
{
    const DeformedScene test({.rings = kSanitized ? 8u : 24u}, 5);
    const formats::PackView& view = test.pack();
    std::mt19937 random(6);
    SceneQueries queries(view, kRoomy);
    for (uint32_t round = 0; round < 2; ++round)
    {
        std::vector<TestPose> poses(view.instances().size());
        for (const uint32_t instance : test.deformedInstances())
        {
            poses[instance] = (instance + round) % 2 == 0 ? test.freePose(instance, random)
                                                          : test.randomPose(instance, random);
            const TestPose& pose = poses[instance];
            const pack::InstancePose input{{instance, pose.world_from_bind, pose.morph_weights}, pose.free};
            ASSERT_TRUE(queries.states().checkPose(input).ok());
            queries.pose(input);
        }
        const auto transforms = readTransforms(view);
        const auto triangles = listTriangles(
            view,
            [&](const formats::ClusterGeometry& geometry, uint32_t instance, uint32_t vertex)
            {
                return poses[instance].world_from_bind.empty()
                           ? transformPoint(widened(transforms[instance]), widen(geometry.position(vertex)))
                           : posedVertex(geometry, vertex, poses[instance]).position;
            });
        expectRays(queries, triangles, kRays / 3, 4, random);

        // each instance is inside of its bounds
        for (const WorldTriangle& triangle : triangles)
        {
            const Box3 box = queries.bounds(triangle.id.instance, 1);
            for (const Double3 corner : triangle.corners)
                for (int axis = 0; axis < 3; ++axis)
                {
                    const double at = axis == 0 ? corner.x : axis == 1 ? corner.y : corner.z;
                    ASSERT_GE(at, double{box.min[axis]}) << triangle.id.instance;
                    ASSERT_LE(at, double{box.max[axis]}) << triangle.id.instance;
                }
        }
    }
}

TEST(SceneQueries, boundsAreThoseOfTheTriangles)
{
    TestScene scene;
    const uint32_t mesh = scene.addMesh(plain(shapes::grid(4)));
    scene.addInstance(mesh, translated({3, 0, 0}));
    scene.addInstance(mesh, translated({-2, 5, 0}));
    const formats::PackView view = scene.build();
    SceneQueries queries(view, 0);
    Box3 expected[2];
    for (const WorldTriangle& triangle : listTriangles(view, placedBy(readTransforms(view))))
        for (const Double3 corner : triangle.corners)
            expected[triangle.id.instance].add(narrow(corner));
    for (uint32_t i = 0; i < 2; ++i)
    {
        EXPECT_EQ(queries.bounds(i, 1).min, expected[i].min);
        EXPECT_EQ(queries.bounds(i, 1).max, expected[i].max);
    }
    expected[0].add(expected[1]);
    EXPECT_EQ(queries.bounds(0, 2).min, expected[0].min);
    EXPECT_EQ(queries.bounds(0, 2).max, expected[0].max);
    EXPECT_TRUE(queries.bounds(0, 0).empty());
    queries.move(0, translated({0, 0, 9}));
    EXPECT_GE(queries.bounds(0, 1).min.z, 8);
}

TEST(SceneQueries, sidesBeginEndAndFilterAreHeeded)
{
    TestScene scene;
    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = formats::kMaterialDoubleSided;
    const uint32_t one_sided = scene.addMaterial(plainMaterial()), both = scene.addMaterial(two_sided);
    // towards +z, at z = 1, 2 and 3; the second is mirrored, the third is two-sided
    scene.addInstance(scene.addMesh(withMaterial(makeQuad(2, 2), one_sided)), translated({0, 0, 1}));
    Affine3 mirrored = translated({0, 0, 2});
    mirrored.m[0][0] = -1;
    scene.addInstance(0, mirrored);
    scene.addInstance(scene.addMesh(withMaterial(makeQuad(2, 2), both)), translated({0, 0, 3}));
    const formats::PackView view = scene.build();
    SceneQueries queries(view, 0);
    const Ray up{.origin = {0.1, 0.2, 0}, .direction = {0, 0, 2}},
        down{.origin = {0.1, 0.2, 4}, .direction = {0, 0, -1}};
    const auto hit = [&](Ray ray, const CastOptions& options)
    {
        const auto found = queries.cast(ray, options);
        EXPECT_TRUE(found.ok());
        return found->has_value() ? (*found)->id.instance : kInvalidIndex;
    };
    EXPECT_EQ(hit(up, {}), 0u);
    EXPECT_EQ(hit(down, {}), 2u);
    EXPECT_EQ(hit(up, {.culls_back = true}), 2u)
        << "one-sided quads are passed from behind, also mirrored ones";
    EXPECT_EQ(hit(down, {.culls_back = true}), 2u);
    Ray below = down;
    below.begin = 1.5;
    EXPECT_EQ(hit(below, {.culls_back = true}), 1u);
    below.end = 1.9;
    EXPECT_EQ(hit(below, {}), kInvalidIndex);
    EXPECT_EQ(hit(up, {.accept = [](const SurfacePoint& point) { return point.id.instance == 1; }}), 1u);
    EXPECT_EQ(hit(up, {.accept = [](const SurfacePoint&) { return false; }}), kInvalidIndex);
    const auto point = queries.cast(up, {});
    ASSERT_TRUE(point.ok() && point->has_value());
    EXPECT_EQ((*point)->t, 0.5);
    EXPECT_EQ((*point)->normal.z, 1);
    EXPECT_FALSE((*point)->faces_ray);
}

TEST(SceneQueries, pointsOfATriangleAreFoundForRaysBesideIt)
{
    RockScene test(7);
    SceneQueries queries(*test.view, kRoomy);
    uint32_t hits = 0;
    for (uint32_t i = 0; i < kRays; ++i)
    {
        Ray ray = randomRay(test.random, 7);
        const auto met = queries.cast(ray, {});
        ASSERT_TRUE(met.ok());
        if (!met->has_value())
            continue;
        ++hits;
        const SurfacePoint& expected = **met;
        const auto same = queries.findPoint(expected.id, ray);
        ASSERT_TRUE(same.ok());
        EXPECT_NEAR(same->t, expected.t, 1e-9 * (1 + expected.t));
        EXPECT_LT(length(same->position - expected.position), 1e-8 * (1 + length(expected.position)));
        ray.origin = ray.origin + randomPoint(test.random, 0.3f);
        const auto beside = queries.findPoint(expected.id, ray);
        ASSERT_TRUE(beside.ok());
        EXPECT_GE(
            std::min({beside->weights[0], beside->weights[1], 1 - beside->weights[0] - beside->weights[1]}),
            -1e-12);
    }
    EXPECT_GT(hits, kRays / 10);
    EXPECT_FALSE(queries.findPoint({100, 0, 0}, {}).ok());
    const uint32_t other = test.view->meshes()[test.view->instances()[1].mesh].clusters.first;
    EXPECT_FALSE(queries.findPoint({0, other, 0}, {}).ok()) << "a cluster of another mesh";
    EXPECT_FALSE(queries.findPoint({1, other, 128}, {}).ok());
}

TEST(SceneQueries, statesThatCannotBeAreRefused)
{
    std::mt19937 random(8);
    const DeformedScene test({.limbs = 1, .tentacles = 1, .blobs = 1, .rocks = 1, .rings = 8}, 9);
    const SceneQueries queries(test.pack(), 0);
    const uint32_t limb = test.deformedInstances()[0];
    uint32_t rock = 0;
    while (queries.states().isDeformed(rock))
        ++rock;
    TestPose pose = test.randomPose(limb, random);
    const auto check = [&](uint32_t instance) {
        return queries.states().checkPose({{instance, pose.world_from_bind, pose.morph_weights}, false});
    };
    EXPECT_TRUE(check(limb).ok());
    EXPECT_FALSE(check(rock).ok());
    EXPECT_FALSE(check(77).ok());
    pose.world_from_bind[0].m[2][3] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(check(limb).ok());
    pose.world_from_bind.pop_back();
    EXPECT_FALSE(check(limb).ok());
    EXPECT_FALSE(queries.states().checkMove(limb, Affine3{}).ok());
    EXPECT_FALSE(queries.states().checkMove(77, Affine3{}).ok());
    Affine3 far;
    far.m[0][3] = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(queries.states().checkMove(rock, far).ok());
    EXPECT_TRUE(queries.states().checkMove(rock, Affine3{}).ok());
}

} // namespace hearth::test
