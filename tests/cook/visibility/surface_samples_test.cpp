// Tests surface samples: they represent all of the surface evenly, and their rays start at the right points.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/sample_points.h"
#include "cook/visibility/rays/surface_samples.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/global_control.h>

namespace hearth::visibility
{
namespace
{

struct Mesh
{
    std::vector<Float3> positions;
    std::vector<uint32_t> corners;
};

Mesh makeMesh(const mesh::SourceMesh& source)
{
    return {source.positions, source.indices};
}

double computeArea(const Mesh& mesh, size_t triangle)
{
    const auto at = [&](size_t k) { return mesh.positions[mesh.corners[triangle * 3 + k]]; };
    return double{length(cross(at(1) - at(0), at(2) - at(0)))} / 2;
}

std::vector<uint32_t> countSamples(const Mesh& mesh, const std::vector<SurfaceSample>& samples)
{
    std::vector<uint32_t> counts(mesh.corners.size() / 3);
    for (const SurfaceSample& sample : samples)
        ++counts[sample.triangle];
    return counts;
}

/// Triangle of half of the unit square, and the other half in 2 n triangles.
Mesh halfFine(uint32_t n)
{
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {0, 1, 2}};
    // fans of slivers between the diagonal and corner (0, 1)
    for (uint32_t i = 0; i < n; ++i)
    {
        const float a = static_cast<float>(i) / static_cast<float>(n),
                    b = static_cast<float>(i + 1) / static_cast<float>(n);
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{a, a, 0}, {b, b, 0}, {0, 1, 0}});
        mesh.corners.insert(mesh.corners.end(), {first, first + 1, first + 2});
    }
    return mesh;
}

TEST(SurfaceSamples, standForTheWholeSurface)
{
    for (const Mesh& mesh :
         {makeMesh(shapes::rock(12, 0.4f)), halfFine(100), makeMesh(shapes::tangle(40, 200))})
    {
        const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, {});
        std::map<uint32_t, double> area_of_triangle;
        for (const SurfaceSample& s : samples)
        {
            ASSERT_LT(s.triangle, mesh.corners.size() / 3);
            ASSERT_GE(s.u, 0);
            ASSERT_GE(s.v, 0);
            ASSERT_LE(s.u + s.v, 1);
            area_of_triangle[s.triangle] += double{s.area};
        }
        for (uint32_t t = 0; t < mesh.corners.size() / 3; ++t)
            EXPECT_NEAR(area_of_triangle[t], computeArea(mesh, t), 1e-5 * computeArea(mesh, t) + 1e-12);
    }
}

TEST(SurfaceSamples, areAsManyAsAskedForAndEvenInArea)
{
    const Mesh mesh = makeMesh(shapes::rock(20, 0.4f));
    const SurfaceSampleSettings settings{.samples_per_vertex = 16};
    const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, settings);
    EXPECT_NEAR(static_cast<double>(samples.size()), 16.0 * static_cast<double>(mesh.positions.size()), 1);
    const std::vector<uint32_t> counts = countSamples(mesh, samples);
    double area = 0;
    for (size_t t = 0; t < counts.size(); ++t)
        area += computeArea(mesh, t);
    const double density = static_cast<double>(samples.size()) / area;
    for (size_t t = 0; t < counts.size(); ++t)
    {
        ASSERT_GE(counts[t], 1u);
        // the samples of the smallest triangles are taken from all others alike: few here
        ASSERT_LE(counts[t], std::max(1.0, std::ceil(computeArea(mesh, t) * density)));
        if (computeArea(mesh, t) * density > 1.2)
        {
            ASSERT_GE(counts[t], std::floor(0.95 * computeArea(mesh, t) * density));
        }
    }
}

TEST(SurfaceSamples, giveEachTriangleTheLeastNumberAndTheRestByArea)
{
    const Mesh mesh = halfFine(300);
    // 903 positions: 300 slivers with 4 samples each take 1200 of 1806; the large triangle gets the other 606
    const SurfaceSampleSettings settings{.samples_per_vertex = 2, .min_per_triangle = 4};
    const std::vector<uint32_t> counts =
        countSamples(mesh, surfaceSamples(mesh.positions, mesh.corners, settings));
    EXPECT_NEAR(counts[0], 606, 1);
    for (size_t t = 1; t < counts.size(); ++t)
        EXPECT_EQ(counts[t], 4u);
    // and no more than the minimum where the minimum exceeds the request
    for (const uint32_t count :
         countSamples(mesh, surfaceSamples(mesh.positions, mesh.corners, {.samples_per_vertex = 0.3})))
        EXPECT_EQ(count, 1u);
}

TEST(SurfaceSamples, giveEachVertexTheLeastNumberInItsTriangles)
{
    // a vertex whose only triangle has a hundredth of its neighbours' area: by area it would have at most one
    // sample
    Mesh mesh = makeMesh(shapes::grid(20));
    const Float3 a = mesh.positions[0], b = mesh.positions[1];
    const auto corner = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a + (b - a) * 0.1f, a + Float3{0, 0, 0.005f}});
    mesh.corners.insert(mesh.corners.end(), {0, corner, corner + 1});
    SurfaceSampleSettings settings;
    const uint32_t by_area =
        countSamples(mesh, surfaceSamples(mesh.positions, mesh.corners, settings)).back();
    EXPECT_EQ(by_area, 1u);
    settings.min_per_vertex = 18;
    const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, settings);
    const std::vector<uint32_t> counts = countSamples(mesh, samples);
    EXPECT_GE(counts.back(), 18u);
    EXPECT_NEAR(static_cast<double>(samples.size()), 8.0 * static_cast<double>(mesh.positions.size()), 1);
    EXPECT_EQ(*std::min_element(counts.begin(), counts.end()), 3u) << "six triangles around a vertex";
    // exactly the available number where all triangles ask for more
    settings.min_per_vertex = 1000;
    const size_t count = surfaceSamples(mesh.positions, mesh.corners, settings).size();
    EXPECT_NEAR(static_cast<double>(count), 8.0 * static_cast<double>(mesh.positions.size()), 1);
}

TEST(SurfaceSamples, areStratifiedWithinLargeTriangles)
{
    // 4096 points of a triangle in the 256 pieces of its fourfold subdivision: random points would deviate by
    // 4
    const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}};
    const std::vector<SurfaceSample> samples =
        surfaceSamples(mesh.positions, mesh.corners, {.samples_per_vertex = 4096.0 / 3});
    ASSERT_NEAR(static_cast<double>(samples.size()), 4096, 1);
    std::map<std::array<int, 3>, int> hits;
    for (const SurfaceSample& s : samples)
        ++hits[{static_cast<int>(s.u * 16), static_cast<int>(s.v * 16),
                static_cast<int>((1 - s.u - s.v) * 16)}];
    double squares = 0;
    for (const auto& [piece, count] : hits)
        squares += (count - 16) * (count - 16);
    EXPECT_EQ(hits.size(), 256u);
    EXPECT_LT(std::sqrt(squares / 256), 2);
}

TEST(SurfaceSamples, areStratifiedOverSmallTriangles)
{
    // half a sample for each triangle: each cell of 8 x 8 triangles has its 32 samples within a few
    const Mesh mesh = makeMesh(shapes::grid(64));
    const size_t triangle_count = mesh.corners.size() / 3;
    const SurfaceSampleSettings settings{.samples_per_vertex = 3 * static_cast<double>(triangle_count) /
                                                               static_cast<double>(mesh.positions.size())};
    const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, settings);
    for (const uint32_t count : countSamples(mesh, samples))
        EXPECT_EQ(count, 3u);
}

TEST(SurfaceSamples, leaveOutTrianglesWithoutArea)
{
    Mesh mesh = makeMesh(shapes::rock(4, 0.2f));
    const auto count = static_cast<uint32_t>(mesh.corners.size() / 3);
    mesh.corners.insert(mesh.corners.end(), {0, 0, 1, 2, 2, 2});
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
    const auto first = static_cast<uint32_t>(mesh.positions.size() - 3);
    mesh.corners.insert(mesh.corners.end(), {first, first + 1, first + 2});
    const std::vector<uint32_t> counts = countSamples(mesh, surfaceSamples(mesh.positions, mesh.corners, {}));
    for (uint32_t t = 0; t < counts.size(); ++t)
        EXPECT_EQ(counts[t] > 0, t < count) << t;
    EXPECT_TRUE(surfaceSamples({}, {}, {}).empty());
    EXPECT_TRUE(surfaceSamples(mesh.positions, std::vector<uint32_t>{0, 0, 0}, {}).empty());
}

TEST(SurfaceSamples, comeInAnOrderOfNeighbours)
{
    const Mesh mesh = makeMesh(shapes::grid(40));
    const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, {});
    const std::vector<SamplePoint> points = samplePoints(mesh.positions, mesh.corners, samples);
    double steps = 0;
    for (size_t i = 1; i < points.size(); ++i)
        steps += double{length(points[i].position - points[i - 1].position)};
    // distance from one of n points of a square to the next: about 1 / sqrt(n); in random order: 0.52
    EXPECT_LT(steps / static_cast<double>(points.size()), 2 / std::sqrt(static_cast<double>(points.size())));
}

TEST(SurfaceSamples, areTakenOfTheLargestAndTheSmallestOfMeshes)
{
    for (const float size : {3e38f, 1e-36f})
    {
        const Mesh mesh{{{-size, 0, 0}, {size, 0, 0}, {0, size, size}}, {0, 1, 2}};
        const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, {});
        EXPECT_EQ(samples.size(), 24u);
        for (const SamplePoint& point : samplePoints(mesh.positions, mesh.corners, samples))
        {
            EXPECT_TRUE(isFinite(point.position));
            EXPECT_NEAR(length(point.normal), 1, 1e-6);
            EXPECT_GT(point.lift, 0);
        }
    }
}

TEST(SurfaceSamples, areTheSameForAnyNumberOfThreads)
{
    const Mesh mesh = makeMesh(shapes::rock(16, 0.4f));
    const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, {});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(surfaceSamples(mesh.positions, mesh.corners, {}), samples);
    EXPECT_NE(surfaceSamples(mesh.positions, mesh.corners, {.seed = 1}), samples);
}

TEST(SamplePoints, lieOnTheTrianglesWithTheirNormals)
{
    const Mesh mesh = makeMesh(shapes::rock(6, 0.4f));
    const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, {});
    const std::vector<SamplePoint> points = samplePoints(mesh.positions, mesh.corners, samples);
    for (size_t i = 0; i < points.size(); ++i)
    {
        const uint32_t* c = &mesh.corners[size_t{samples[i].triangle} * 3];
        const Float3 a = mesh.positions[c[0]], b = mesh.positions[c[1]], d = mesh.positions[c[2]];
        const Float3 n = normalizeOr(cross(b - a, d - a), {});
        EXPECT_LT(length(points[i].normal - n), 2e-5f);
        EXPECT_LT(length(points[i].position - (a + (b - a) * samples[i].u + (d - a) * samples[i].v)), 1e-6f);
        EXPECT_GT(points[i].lift, 0);
        // a small multiple of float precision, though slivers need more
        EXPECT_LT(points[i].lift, 1e-4f);
    }
}

TEST(SamplePoints, keepTheFrontInFrontInMirroredAndSkewedInstances)
{
    const Mesh mesh = makeMesh(shapes::rock(6, 0.2f)); // around the origin, normals outwards
    const std::vector<SurfaceSample> samples = surfaceSamples(mesh.positions, mesh.corners, {});
    for (const Affine3& world_from_mesh : {Affine3{{{-2, 0, 0, 5}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
                                           Affine3{{{1, 0.5f, 0, 0}, {0, 1, 0, 3}, {0, -0.3f, 4, 0}}}})
    {
        const std::vector<SamplePoint> points =
            samplePoints(mesh.positions, mesh.corners, samples, world_from_mesh);
        const std::vector<SamplePoint> before = samplePoints(mesh.positions, mesh.corners, samples);
        for (size_t i = 0; i < points.size(); ++i)
        {
            EXPECT_LT(length(points[i].position - transformPoint(world_from_mesh, before[i].position)),
                      1e-5f);
            // moved along the normal in object space, then transformed: still in front of the plane
            const Float3 ahead = transformVector(world_from_mesh, before[i].normal);
            EXPECT_GT(dot(points[i].normal, ahead), 0);
            const uint32_t* c = &mesh.corners[size_t{samples[i].triangle} * 3];
            const Float3 edge = normalizeOr(
                transformVector(world_from_mesh, mesh.positions[c[1]] - mesh.positions[c[0]]), {});
            EXPECT_NEAR(dot(points[i].normal, edge), 0, 1e-5);
        }
    }
}

} // namespace
} // namespace hearth::visibility
