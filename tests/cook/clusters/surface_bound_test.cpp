// Tests the bound on the distance of whole surfaces: valid, tight, and the same for any number of threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_bound.h"

#include "cook/clusters/surface/surface_tree.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using clusters::boundSurfaces;
using clusters::SurfaceBound;
using clusters::SurfaceView;
using mesh::SourceMesh;

/// Surface of a mesh; converts to a view of itself.
class MeshSurface
{
public:
    explicit MeshSurface(const SourceMesh& mesh)
        : positions_(mesh.positions), corners_(clusters::convertIds<clusters::VertexId>(mesh.indices))
    {
    }
    operator SurfaceView() const { return {positions_, corners_}; }

private:
    clusters::IdVector<clusters::VertexId, Float3> positions_;
    clusters::CornerVector<clusters::VertexId> corners_;
};

/// Return the distance between two surfaces by sampling.
double sampled(const SourceMesh& a, const SourceMesh& b)
{
    constexpr size_t kSamples = 200000;
    return std::max(
        largestDistance(a.positions, a.indices, kSamples, SurfaceDistance(b.positions, b.indices)),
        largestDistance(b.positions, b.indices, kSamples, SurfaceDistance(a.positions, a.indices)));
}

void expectTight(const SourceMesh& a, const SourceMesh& b)
{
    const SurfaceBound bound = boundSurfaces(MeshSurface(a), MeshSurface(b), 0);
    const double found = sampled(a, b);
    EXPECT_GE(bound.upper, found * (1 - 1e-6));
    EXPECT_LE(bound.upper, 1.1 * bound.sure * (1 + 1e-9));
    EXPECT_LE(bound.sure, bound.upper);
    EXPECT_GE(bound.sure, found * 0.98) << "the search knows at least what sampling finds";
    EXPECT_EQ(bound.loose_pieces, 0u);
}

SourceMesh square(uint32_t n, Float3 offset)
{
    SourceMesh mesh = shapes::grid(n);
    for (Float3& p : mesh.positions)
        p += offset;
    return mesh;
}

TEST(SurfaceBound, ofTwoRocksIsTight)
{
    expectTight(shapes::rock(40, 0.4f), shapes::rock(9, 0.4f));
}

TEST(SurfaceBound, ofARockAndABallIsTight)
{
    expectTight(shapes::rock(30, 0.5f), shapes::rock(3, 0));
}

TEST(SurfaceBound, ofTerrainsIsTight)
{
    expectTight(shapes::terrain(100), shapes::terrain(7));
}

TEST(SurfaceBound, ofLooseTrianglesIsTight)
{
    expectTight(shapes::soup(3000, 1), shapes::soup(500, 2));
}

TEST(SurfaceBound, ofAFoldIsFoundInsideALargeTriangle)
{
    // two triangles meet in a ridge over the middle of the large one: no corner is as far away as the ridge's
    // end
    SourceMesh flat, ridge;
    flat.positions = {{-10, 0, -10}, {10, 0, -10}, {0, 0, 10}};
    flat.indices = {0, 1, 2};
    ridge.positions = {{-10, 0, -10}, {0, 0, 10}, {10, 0, -10}, {-1, 0, 0}, {1, 0, 0}};
    ridge.indices = {0, 3, 1, 1, 4, 2};
    const SurfaceBound bound = boundSurfaces(MeshSurface(flat), MeshSurface(ridge), 0);
    EXPECT_GE(bound.upper, sampled(flat, ridge) * (1 - 1e-6));
    EXPECT_LE(bound.upper, 1.1 * sampled(flat, ridge) * 1.02);
}

TEST(SurfaceBound, onAPlaneIsRounding)
{
    // common refinement of both surfaces, at an offset that gives them no common edge
    const SurfaceBound bound =
        boundSurfaces(MeshSurface(square(2, {0, 0, 0})), MeshSurface(square(37, {0, 0, 0})), 0);
    EXPECT_LE(bound.upper, 2e-6);
    EXPECT_EQ(bound.loose_pieces, 0u);
}

TEST(SurfaceBound, ofParallelPlanesIsTheirDistance)
{
    const SurfaceBound bound =
        boundSurfaces(MeshSurface(square(3, {0, 0.25f, 0})), MeshSurface(square(10, {0, 0, 0})), 0);
    EXPECT_NEAR(bound.sure, 0.25, 1e-7);
    EXPECT_GE(bound.upper, 0.25 - 1e-7);
    EXPECT_LE(bound.upper, 0.275 + 1e-7);
}

TEST(SurfaceBound, doesNotTellApartWhatIsNearEnough)
{
    const SourceMesh fine = shapes::rock(40, 0.4f), coarse = shapes::rock(20, 0.4f);
    const double tight = boundSurfaces(MeshSurface(fine), MeshSurface(coarse), 0).upper;
    const double enough = boundSurfaces(MeshSurface(fine), MeshSurface(coarse), 10 * tight).upper;
    EXPECT_GE(enough, sampled(fine, coarse) * (1 - 1e-6));
    EXPECT_LE(enough, 11 * tight);
}

TEST(SurfaceBound, doesNotDependOnThreads)
{
    const SourceMesh a = shapes::rock(50, 0.4f), b = shapes::rock(11, 0.3f);
    const SurfaceBound many = boundSurfaces(MeshSurface(a), MeshSurface(b), 0);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const SurfaceBound single = boundSurfaces(MeshSurface(a), MeshSurface(b), 0);
    EXPECT_EQ(many.upper, single.upper);
    EXPECT_EQ(many.sure, single.sure);
}

TEST(SurfaceTree, findsTheNearestTriangle)
{
    const SourceMesh mesh = shapes::tangle(60, 300);
    const MeshSurface surface(mesh);
    const clusters::SurfaceTree tree(surface);
    std::mt19937 random(5);
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
    for (int i = 0; i < 500; ++i)
    {
        const Double3 point{uniform(), uniform(), uniform()};
        double nearest2 = 1e30;
        for (uint32_t t = 0; t < mesh.triangleCount(); ++t)
            nearest2 = std::min(
                nearest2, clusters::distance2(point, tree.triangle(clusters::toId<clusters::TriangleId>(t))));
        EXPECT_EQ(tree.nearest(point, 0, clusters::TriangleId{0}).distance2, nearest2);
        EXPECT_LE(tree.nearest(point, 4 * nearest2, clusters::TriangleId{0}).distance2, 4 * nearest2);
    }
}

TEST(SurfaceTree, measuresNeedlesAndPoints)
{
    const clusters::Corners3 needle{{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}};
    EXPECT_DOUBLE_EQ(clusters::distance2({0.25, 2, 0}, needle), 4);
    EXPECT_DOUBLE_EQ(clusters::distance2({-3, 0, 4}, needle), 25);
    const clusters::Corners3 point{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
    EXPECT_DOUBLE_EQ(clusters::distance2({1, 1, 3}, point), 4);
}

TEST(SurfaceBound, endsBetweenTwoTrianglesThatAreNearlyAsNear)
{
    // cuts along the border of one and of the other, neither of which crosses a piece, took turns without end
    SourceMesh a, b;
    a.positions = {{0.0846862793f, -0.0545043945f, 0.161590576f},
                   {0.0935058594f, -0.0508728027f, 0.179046631f},
                   {0.0843200684f, -0.0507507324f, 0.179382324f}};
    b.positions = {
        {0.0846821219f, -0.054502029f, 0.16157569f},   {0.0784514099f, -0.0521856584f, 0.165604174f},
        {0.077847138f, -0.0234357435f, 0.167034283f},  {0.0788139701f, -0.0218914952f, 0.178945169f},
        {0.0782499835f, -0.0500438735f, 0.175776094f}, {0.0843262747f, -0.0507555678f, 0.179374874f}};
    a.indices = {0, 1, 2};
    b.indices = {0, 1, 2, 3, 4, 5};
    EXPECT_EQ(boundSurfaces(MeshSurface(a), MeshSurface(b), 0).loose_pieces, 0u);
    expectTight(a, b);
}

TEST(SurfaceBound, endsWhereCutsLeaveSlivers)
{
    // the chest of a fox and its proxy: pieces much smaller than the distance were cut along one triangle and
    // another, and rounding left slivers as long as the piece
    SourceMesh a, b;
    a.positions = {{-8.02685547f, 35.2236328f, -65.0991211f},
                   {-4.77001953f, 23.9956055f, -78.0830078f},
                   {0.0009765625f, 16.2451172f, -71.2070312f}};
    a.indices = {0, 1, 2};
    const Float3 front{-2.93600583f, 14.7740917f, -86.0077515f}, side{-6.40307093f, 17.834837f, -72.8394547f},
        low{-3.90036845f, 15.1836386f, -69.9520416f}, middle{0, 14.2964172f, -69.4144058f};
    b.positions = {low,
                   front,
                   middle,
                   side,
                   front,
                   low,
                   {-4.76979542f, 23.9955254f, -78.0829391f},
                   front,
                   side,
                   front,
                   {0, 13.9951525f, -85.6884308f},
                   middle,
                   {-4.76979542f, 23.9955254f, -78.0829391f},
                   side,
                   {-7.79518318f, 34.607151f, -64.6526642f},
                   side,
                   low,
                   {-8.62242031f, 25.1335049f, -59.1995926f}};
    b.indices.resize(b.positions.size());
    std::iota(b.indices.begin(), b.indices.end(), 0u);
    const SurfaceBound bound = clusters::boundSurfaceSides(MeshSurface(a), MeshSurface(b), 4.75380175).a;
    EXPECT_EQ(bound.loose_pieces, 0u);
    EXPECT_LE(bound.upper, 1.1 * 4.75380175 * (1 + 1e-9));
}

} // namespace
