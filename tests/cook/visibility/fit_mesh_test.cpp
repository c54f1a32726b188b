// Tests the fit mesh mesh on which visibility is fitted.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/closest_point.h"
#include "cook/visibility/fit/vertex_fit.h"
#include "cook/visibility/mesh/fit_mesh.h"
#include "cook/visibility/mesh/moment_clamp.h"
#include "cook/visibility/mesh/vertex_weld.h"
#include "tests/cook/visibility/mesh_samples.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

namespace hearth::visibility
{

using test::getPoint;
using test::makeMeshView;
using test::makeSamples;

namespace
{

constexpr Float3 kUp{0, 0, 1};

/// A mesh whose normals all point up.
struct FlatMesh
{
    std::vector<Float3> positions;
    std::vector<uint32_t> indices;
    std::vector<Float3> normals{};

    MeshView view()
    {
        normals.assign(positions.size(), kUp);
        return {positions, normals, indices};
    }
};

double lowestTriangle(const FitMesh& fit_mesh)
{
    double least = 1;
    for (size_t t = 0; t < fit_mesh.smooth_count; ++t)
    {
        const uint32_t* corner = &fit_mesh.indices[t * 3];
        const Float3 a = fit_mesh.positions[corner[0]], b = fit_mesh.positions[corner[1]],
                     c = fit_mesh.positions[corner[2]];
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        least =
            std::min(least, length(cross(widen(b) - widen(a), widen(c) - widen(a))) / (longest * longest));
    }
    return least;
}

double computeArea(const MeshView& mesh)
{
    double area = 0;
    for (const SurfaceSample& sample : makeSamples(mesh, 1))
        area += sample.area;
    return area;
}

size_t distinctPositions(std::span<const Float3> positions)
{
    std::set<std::array<float, 3>> distinct;
    for (const Float3 p : positions)
        distinct.insert({p.x, p.y, p.z});
    return distinct.size();
}

/// A unit square of n x n quads.
FlatMesh square(uint32_t n)
{
    FlatMesh mesh;
    for (uint32_t y = 0; y <= n; ++y)
        for (uint32_t x = 0; x <= n; ++x)
            mesh.positions.push_back({static_cast<float>(x) / static_cast<float>(n),
                                      static_cast<float>(y) / static_cast<float>(n), 0});
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x)
        {
            const uint32_t v = y * (n + 1) + x;
            for (const uint32_t corner : {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1})
                mesh.indices.push_back(corner);
        }
    return mesh;
}

} // namespace

TEST(WeldVertices, isWhatComparingAllPairsGives)
{
    std::mt19937 random(7);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    std::vector<Float3> positions, normals;
    for (int i = 0; i < 150; ++i)
    {
        const Float3 p{unit(), unit() - 0.5f, unit()};
        const Float3 n = normalizeOr(Float3{unit() - 0.5f, unit() - 0.5f, unit() - 0.5f}, kUp);
        for (int copy = 0; copy < 4; ++copy)
        {
            const auto jitter = [&](float size) { return (unit() - 0.5f) * size; };
            positions.push_back(p + Float3{jitter(0.03f), jitter(0.03f), jitter(0.03f)});
            normals.push_back(n + Float3{jitter(0.3f), jitter(0.3f), jitter(0.3f)});
        }
    }
    constexpr double kPosition = 0.02, kNormal = 0.1;
    std::vector<uint32_t> expected(positions.size());
    std::iota(expected.begin(), expected.end(), 0u);
    const auto near = [&](size_t a, size_t b)
    {
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(double{positions[a][axis]} - positions[b][axis]) > kPosition ||
                std::abs(double{normals[a][axis]} - normals[b][axis]) > kNormal)
                return false;
        return true;
    };
    for (bool changed = true; changed;)
    {
        changed = false;
        for (size_t a = 0; a < positions.size(); ++a)
            for (size_t b = 0; b < a; ++b)
                if (expected[a] != expected[b] && near(a, b))
                {
                    expected[a] = expected[b] = std::min(expected[a], expected[b]);
                    changed = true;
                }
    }
    EXPECT_EQ(weldVertices(positions, normals, kPosition, kNormal), expected);
    EXPECT_GT(std::set(expected.begin(), expected.end()).size(), 200u) << "nothing was kept apart";
    EXPECT_LT(std::set(expected.begin(), expected.end()).size(), 550u) << "nothing was to be welded";
}

TEST(MakeFitMesh, weldsSeamsAndKeepsHardEdges)
{
    const mesh::SourceMesh rock = shapes::rock(8, 0.3f);
    const FitMesh smooth = makeFitMesh(makeMeshView(rock));
    EXPECT_LT(distinctPositions(rock.positions), rock.vertexCount()) << "the rock has no seams";
    EXPECT_EQ(smooth.positions.size(), distinctPositions(rock.positions));
    EXPECT_EQ(smooth.edges.size() * 2, smooth.smooth_count * 3) << "it is closed";

    const mesh::SourceMesh blocks = shapes::blocks(4);
    const FitMesh hard = makeFitMesh(makeMeshView(blocks));
    for (size_t v = 0; v < blocks.vertexCount(); ++v)
        EXPECT_EQ(dot(hard.normals[hard.bindings[v].vertices[0]], blocks.normals[v]), 1)
            << "of faces that meet at a right angle";
}

TEST(MakeFitMesh, dropsFacesThatAreThereTwice)
{
    FlatMesh mesh = square(3);
    const size_t once = mesh.indices.size();
    // again rotated, again from the back, and again with separate vertices
    mesh.indices.insert(mesh.indices.end(), {mesh.indices[1], mesh.indices[2], mesh.indices[0]});
    mesh.indices.insert(mesh.indices.end(), {mesh.indices[5], mesh.indices[4], mesh.indices[3]});
    for (size_t i = 0; i < once; ++i)
    {
        mesh.positions.push_back(mesh.positions[mesh.indices[i]]);
        mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size() - 1));
    }
    mesh.indices.insert(mesh.indices.end(), {4, 4, 5});
    const MeshView view = mesh.view();
    const FitMesh fit_mesh = makeFitMesh(view);
    EXPECT_EQ(fit_mesh.indices.size(), once);
    EXPECT_EQ(fit_mesh.positions.size(), 16u);
    EXPECT_EQ(fit_mesh.statistics.thin.duplicate, once / 3 + 2);
    EXPECT_EQ(fit_mesh.statistics.thin.degenerate, 1u);
    const std::vector<SurfaceSample> samples = makeSamples(view, 2);
    const std::vector<SurfaceSample> moved = mapSamplesToFitMesh(fit_mesh, view, samples);
    for (size_t i = 0; i < samples.size(); ++i)
        EXPECT_LT(length(getPoint(view, samples[i]) - getPoint(fit_mesh.view(), moved[i])), 1e-6f);
}

TEST(MakeFitMesh, collapsesNeedlesAndFlipsCaps)
{
    FlatMesh mesh = square(4);
    const double area = computeArea(mesh.view());
    // a T-junction: the midpoint of the edge between the triangles of the first quad, slightly off, and a cap
    // to close it; the triangle below is split there, the one above is not
    ASSERT_EQ((std::vector<uint32_t>(mesh.indices.begin(), mesh.indices.begin() + 6)),
              (std::vector<uint32_t>{0, 1, 6, 0, 6, 5}));
    const auto middle = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back({0.125f, 0.12499f, 0});
    mesh.indices[2] = middle;
    mesh.indices.insert(mesh.indices.end(), {middle, 1, 6, 0, middle, 6});
    // a crack: a vertex almost at the position of another, and the needle triangle between them
    const auto beside = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back(mesh.positions[12] + Float3{0, 1e-5f, 0});
    for (size_t i = mesh.indices.size(); i-- > 0;)
        if (mesh.indices[i] == 12)
        {
            mesh.indices[i] = beside;
            const size_t t = i / 3 * 3;
            const uint32_t next = mesh.indices[t + (i - t + 1) % 3];
            const bool left = mesh.positions[next].x < mesh.positions[12].x; // faces up
            mesh.indices.insert(mesh.indices.end(), {left ? 12 : beside, left ? beside : 12, next});
            break;
        }
    const MeshView view = mesh.view();
    const FitMesh fit_mesh = makeFitMesh(view);
    EXPECT_GE(fit_mesh.statistics.thin.collapsed, 1u);
    EXPECT_GE(fit_mesh.statistics.thin.flipped, 1u);
    EXPECT_EQ(fit_mesh.statistics.thin.dropped, 0u);
    EXPECT_GE(lowestTriangle(fit_mesh), 1e-3);
    EXPECT_NEAR(computeArea(fit_mesh.view()), area, 1e-4) << "a hole was left";
    const std::vector<SurfaceSample> samples = makeSamples(view, 3),
                                     moved = mapSamplesToFitMesh(fit_mesh, view, samples);
    for (size_t i = 0; i < samples.size(); ++i)
    {
        ASSERT_NE(moved[i].triangle, kInvalidIndex);
        EXPECT_LT(length(getPoint(fit_mesh.view(), moved[i]) - getPoint(view, samples[i])), 3e-5f);
    }
    for (const Binding& binding : fit_mesh.bindings)
        EXPECT_EQ(binding.weights[0], 1) << "all vertices still have triangles";
}

TEST(MakeFitMesh, keepsAFanOfFineNeedlesFromCollapsingIntoOne)
{
    FlatMesh strip; // 1 x 1, cut into 3000 slices
    constexpr uint32_t kSlices = 3000;
    for (uint32_t i = 0; i <= kSlices; ++i)
        for (const float y : {0.0f, 1.0f})
            strip.positions.push_back({static_cast<float>(i) / kSlices, y, 0});
    for (uint32_t i = 0; i < kSlices * 2; i += 2)
        for (const uint32_t corner : {i, i + 2, i + 3, i, i + 3, i + 1})
            strip.indices.push_back(corner);
    const FitMesh fit_mesh = makeFitMesh(strip.view());
    EXPECT_GE(lowestTriangle(fit_mesh), 1e-3);
    EXPECT_GE(fit_mesh.smooth_count, 500u);
    EXPECT_NEAR(computeArea(fit_mesh.view()), 1, 1e-3);
}

TEST(MakeFitMesh, keepsABladeThatIsAllSlivers)
{
    FlatMesh mesh = square(2);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    // above the square, so thin that both triangles are removed, but no other surface has visibility there
    for (const Float3 p :
         {Float3{0.5f, 0.5f, 1}, Float3{0.5f, 0.5004f, 1}, Float3{0.5f, 0.5f, 2}, Float3{0.5f, 0.5004f, 2}})
        mesh.positions.push_back(p);
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
    const MeshView view = mesh.view();
    const FitMesh fit_mesh = makeFitMesh(view);
    EXPECT_EQ(fit_mesh.smooth_count, 8u);
    EXPECT_EQ(fit_mesh.statistics.loose, 2u);
    const std::vector<SurfaceSample> samples = makeSamples(view, 4);
    std::vector<Moments> values;
    for (const SurfaceSample& sample : samples)
        values.push_back({sample.triangle < 8 ? 1.0f : 4.0f + getPoint(view, sample).z, {}});
    const FitResult fit = fitVertices(fit_mesh, mapSamplesToFitMesh(fit_mesh, view, samples), values);
    const std::vector<Moments> source = mapValuesToSource(fit_mesh, fit.moments, view.normals);
    for (uint32_t v = 0; v < first; ++v)
        EXPECT_NEAR(source[v].m0, 1, 1e-5f);
    for (uint32_t v = first; v < view.positions.size(); ++v)
        EXPECT_NEAR(source[v].m0, 4 + view.positions[v].z, 0.01f);
}

TEST(MakeFitMesh, bindsEveryVertexToWhereItIs)
{
    mesh::SourceMesh rock = shapes::rock(6, 0.4f);
    std::mt19937 random(3);
    // slivers of all kinds between the vertices: some without area, some with separate vertices
    for (int i = 0; i < 60; ++i)
    {
        const size_t t = random() % rock.triangleCount() * 3;
        const Float3 a = rock.positions[rock.indices[t]], b = rock.positions[rock.indices[t + 1]];
        const auto along = static_cast<float>(random() % 11) * 0.1f;
        rock.positions.push_back(a + (b - a) * along);
        rock.normals.push_back(rock.normals[rock.indices[t]]);
        rock.indices.insert(rock.indices.end(), {rock.indices[t], rock.indices[t + 1],
                                                 static_cast<uint32_t>(rock.positions.size() - 1)});
    }
    const MeshView view{rock.positions, rock.normals, rock.indices};
    const FitMesh fit_mesh = makeFitMesh(view);
    EXPECT_GE(lowestTriangle(fit_mesh), 1e-3);
    for (size_t v = 0; v < fit_mesh.bindings.size(); ++v)
    {
        Float3 point;
        for (size_t k = 0; k < 3; ++k)
            point += fit_mesh.positions[fit_mesh.bindings[v].vertices[k]] * fit_mesh.bindings[v].weights[k];
        EXPECT_LT(length(point - rock.positions[v]), 0.01f);
    }
}

TEST(MakeFitMesh, givesUnreferencedVerticesTheNearestValue)
{
    FlatMesh mesh = square(4);
    mesh.positions.push_back({0.3f, 0.4f, 7});
    mesh.positions.push_back({0.3f, 0.4f, -7});
    const MeshView view = mesh.view();
    const FitMesh fit_mesh = makeFitMesh(view);
    EXPECT_EQ(fit_mesh.statistics.nearest, 2u);
    std::vector<Moments> values;
    for (const Float3 p : fit_mesh.positions)
        values.push_back({p.x + 2 * p.y, {}});
    const std::vector<Moments> source = mapValuesToSource(fit_mesh, values, view.normals);
    EXPECT_NEAR(source[25].m0, 1.1f, 1e-6f);
    EXPECT_NEAR(source[26].m0, 1.1f, 1e-6f);
}

TEST(MakeFitMesh, isEmptyForMeshesWithoutTriangles)
{
    FlatMesh mesh{{{1, 2, 3}}, {}};
    const MeshView view = mesh.view();
    const FitMesh fit_mesh = makeFitMesh(view);
    EXPECT_TRUE(fit_mesh.positions.empty());
    const FitResult fit = fitVertices(fit_mesh, {}, {});
    const std::vector<Moments> source = mapValuesToSource(fit_mesh, fit.moments, view.normals);
    EXPECT_EQ(source[0].m1, kUp * std::numbers::pi_v<float>);
}

TEST(MakeFitMesh, takesAnyTriangles)
{
    mesh::SourceMesh tangle = shapes::tangle(60, 400), soup = shapes::soup(100),
                     moebius = shapes::moebius(30, 3);
    for (mesh::SourceMesh* mesh : {&tangle, &soup, &moebius})
    {
        mesh->normals.resize(mesh->vertexCount(), kUp);
        const FitMesh fit_mesh = makeFitMesh(makeMeshView(*mesh));
        const std::vector<SurfaceSample> samples =
            mapSamplesToFitMesh(fit_mesh, makeMeshView(*mesh), makeSamples(makeMeshView(*mesh), 1));
        std::vector<Moments> values(samples.size(), Moments{3, {}});
        for (const Moments& m : fitVertices(fit_mesh, samples, values).moments)
            EXPECT_NEAR(m.m0, 3, 1e-5f);
    }
}

TEST(ClosestPoint, isWhatTryingAllTrianglesGives)
{
    const mesh::SourceMesh rock = shapes::rock(5, 0.5f);
    const MeshView view = makeMeshView(rock);
    const mesh::ClosestPoint tree(view, view.triangleCount());
    std::vector<mesh::ClosestPoint> single; // one per triangle
    for (size_t t = 0; t < view.triangleCount(); ++t)
        single.emplace_back(MeshView{view.positions, view.normals, view.indices.subspan(t * 3, 3)}, 1);
    std::mt19937 random(5);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1; };
    for (int i = 0; i < 200; ++i)
    {
        const Float3 p = Float3{unit(), unit(), unit()} * 1.5f, n{unit(), unit(), unit()};
        const double limit2 = i % 2 == 0 ? 100 : 0.02;
        double least = limit2;
        for (const mesh::ClosestPoint& one : single)
            least = std::min(least, one.find(p, n, limit2, kInvalidIndex).distance2);
        const mesh::ClosestPoint::Hit found = tree.find(p, n, limit2, static_cast<uint32_t>(i));
        EXPECT_EQ(found.distance2, least);
        if (found.triangle == kInvalidIndex)
            continue;
        const Float3 at = getPoint(view, {found.triangle, found.u, found.v, 0});
        EXPECT_NEAR(length(at - p), std::sqrt(least), 1e-5);
        EXPECT_GE(std::min({found.u, found.v, 1 - found.u - found.v}), -1e-6f);
        const uint32_t* c = &view.indices[size_t{found.triangle} * 3];
        EXPECT_GT(dot(cross(view.positions[c[1]] - view.positions[c[0]],
                            view.positions[c[2]] - view.positions[c[0]]),
                      n),
                  0);
    }
}

TEST(ClampMoments, leavesWhatIsPossible)
{
    const float pi = std::numbers::pi_v<float>;
    for (const Moments m : {Moments{2 * pi, {0, 0, pi}}, Moments{0, {}},
                            Moments{pi, {0.3f, 0, 0.75f * pi - 0.1f}}, Moments{3, {1, -0.5f, 0}}})
    {
        Moments clamped = m;
        EXPECT_FALSE(clampMoments(clamped, kUp));
        EXPECT_NEAR(clamped.m0, m.m0, 1e-6f);
        EXPECT_LT(length(clamped.m1 - m.m1), 1e-6f);
    }
}

TEST(ClampMoments, projectsWhatIsNot)
{
    const float pi = std::numbers::pi_v<float>;
    std::mt19937 random(11);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1; };
    uint32_t changed = 0;
    for (int i = 0; i < 1000; ++i)
    {
        const Float3 n = normalizeOr(Float3{unit(), unit(), unit()}, kUp);
        Moments m{unit() * 10, Float3{unit(), unit(), unit()} * 4};
        changed += clampMoments(m, n);
        EXPECT_GE(m.m0, 0);
        EXPECT_LE(m.m0, 2 * pi * 1.0000001f);
        EXPECT_LE(length(m.m1), m.m0 * (1 - m.m0 / (4 * pi)) + 1e-5f);
        EXPECT_GE(dot(m.m1, n), -1e-5f);
        Moments again = m;
        EXPECT_FALSE(clampMoments(again, n));
    }
    EXPECT_GT(changed, 500u);
    Moments bad{std::nanf(""), {1, 1, 1}};
    EXPECT_TRUE(clampMoments(bad, kUp));
    EXPECT_EQ(bad.m0, 0);
}

} // namespace hearth::visibility
