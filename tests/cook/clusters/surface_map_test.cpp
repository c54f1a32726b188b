// Compares the map between a group's surfaces, and the errors that it carries on, with brute force over
// single points.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_map.h"

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/error/deviation.h"
#include "cook/clusters/partition/split.h"
#include "cook/clusters/simplify/cell_merge.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using namespace hearth;
using namespace hearth::clusters;
using mesh::SourceMesh;

// Rounding of distances between points in [-1, 1]^3.
constexpr double kRounding = 4e-6;

/// Group and its simplification.
struct Pair
{
    GroupMesh group;
    SimplifiedGroup simplified;
    Surface before;
    Surface after;
    SurfacePoints points;
};

/// A few clusters of a mesh, with some positions locked.
GroupMesh makeGroup(const SourceMesh& mesh, double locked_share, std::mt19937& random)
{
    const PreparedMesh prepared = prepareMesh(mesh);
    const ClusterStore store = splitMesh(prepared);
    const auto few = makeIds<ClusterId>(std::min<size_t>(store.shapes.size(), 8));
    const std::vector<ClusterId> members(few.begin(), few.end());
    IdVector<MeshPositionId, uint8_t> locked(prepared.position_count);
    std::bernoulli_distribution stays(locked_share);
    for (uint8_t& lock : locked)
        lock = stays(random) ? 1 : 0;
    GroupMesh group = gatherGroup(prepared, store, members, locked, {});
    std::uniform_real_distribution<float> error(0, 0.05f);
    for (float& e : group.errors)
        e = error(random);
    return group;
}

Pair simplifiedTo(double share, const GroupMesh& group, bool merge)
{
    const auto target = static_cast<size_t>(share * static_cast<double>(group.triangleCount()));
    SimplifiedGroup simplified = simplifyGroup(group, target, target);
    if (merge)
        mergeByCells(group, target, simplified);
    Surface before(gatherPositionIds(group, group.corners), group.positions);
    Surface after(gatherPositionIds(group, simplified.corners), simplified.placement.positions);
    SurfacePoints points = findPoints(group, simplified, after);
    return {group, std::move(simplified), std::move(before), std::move(after), std::move(points)};
}

double distanceToSegment(Float3 p, Float3 a, Float3 b)
{
    const Float3 ab = b - a;
    const float t = dot(ab, ab) > 0 ? std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0f, 1.0f) : 0.0f;
    return length(p - (a + ab * t));
}

double distanceToTriangle(Float3 p, const Corners& t)
{
    const Float3 n = cross(t[1] - t[0], t[2] - t[0]);
    bool inside = dot(n, n) > 0;
    double nearest = 1e30;
    for (size_t k = 0; k < 3; ++k)
    {
        const Float3 a = t[k], b = t[(k + 1) % 3];
        inside = inside && dot(cross(b - a, p - a), n) >= 0;
        nearest = std::min(nearest, distanceToSegment(p, a, b));
    }
    return inside ? std::min(nearest, std::abs(double{dot(p - t[0], n)}) / length(n)) : nearest;
}

std::vector<Float3> makeSamples(const Corners& triangle, std::mt19937& random)
{
    std::vector<Float3> samples(triangle.begin(), triangle.end());
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 5; ++i)
    {
        float v = unit(random), w = unit(random);
        if (v + w > 1)
        {
            v = 1 - v;
            w = 1 - w;
        }
        if (i < 2)
            v = 0; // on an edge
        samples.push_back(triangle[0] * (1 - v - w) + triangle[1] * v + triangle[2] * w);
    }
    return samples;
}

/// Check that each point of the triangles of `from` for which `tells` is true is within `allowed` (a distance
/// for the pair of triangles) of a triangle of `to`.
template <typename Tells, typename Allowed>
void expectNear(const Surface& from, const Surface& to, Tells tells, Allowed allowed, const char* what)
{
    std::mt19937 random(9);
    size_t bad = 0;
    for (size_t i = 0; i < from.triangleCount(); i += test::kSanitized ? 10 : 1)
    {
        const auto t = toId<TriangleId>(i);
        if (!tells(t))
            continue;
        for (const Float3 point : makeSamples(from.triangleCorners(t), random))
        {
            const auto isNear = [&](TriangleId f)
            {
                const double limit = allowed(t, f) + kRounding;
                return limit >= 0 && distanceToTriangle(point, to.triangleCorners(f)) <= limit;
            };
            const auto others = to.triangles.ids();
            bad += std::any_of(others.begin(), others.end(), isNear) ? 0u : 1u;
        }
    }
    EXPECT_EQ(bad, 0u) << what;
}

struct Shares
{
    double mapped = 0, covered = 0; ///< area of the triangles that changed
};

/// Check everything that the map claims.
Shares expectSoundMap(const Pair& pair, IdSpan<PositionId, const TrianglePoint> points)
{
    IdVector<TriangleId, uint8_t> all(pair.before.triangleCount(), 1);
    const SurfaceMap map(pair.group, pair.simplified, pair.before.position_ids, pair.after, points, all);
    const IdVector<TriangleId, float>& errors = pair.group.errors;
    const IdVector<TriangleId, float> sums = map.maxSums(errors);
    // a source point at the maximum distance from a triangle is near the triangle's image
    expectNear(
        pair.before, pair.after, [&](TriangleId t) { return map.maps(t); },
        [&](TriangleId t, TriangleId f)
        { return std::min(double{map.maxDistance(t)}, double{sums[f]} - double{errors[t]}); },
        "before to after");
    expectNear(
        pair.after, pair.before, [&](TriangleId f) { return map.covers(f); },
        [&](TriangleId f, TriangleId t) { return map.maps(t) ? double{sums[f]} - double{errors[t]} : -1.0; },
        "after to before");
    Shares shares;
    for (const TriangleId t : all.ids())
        shares.mapped += map.maps(t) ? 1.0 : 0.0;
    for (const TriangleId f : pair.after.triangles.ids())
        shares.covered += map.covers(f) ? 1.0 : 0.0;
    shares.mapped /= static_cast<double>(all.size());
    shares.covered /= static_cast<double>(pair.after.triangleCount());
    return shares;
}

void expectSoundErrors(const Pair& pair)
{
    const Deviation deviation =
        boundDeviation(pair.group, pair.simplified, pair.after, pair.points.of_position);
    const auto allowed = [&](TriangleId t, TriangleId f)
    { return double{deviation.errors[f]} - double{pair.group.errors[t]}; };
    const auto always = [](TriangleId) { return true; };
    expectNear(pair.before, pair.after, always, allowed, "errors, before to after");
    expectNear(
        pair.after, pair.before, always, [&](TriangleId f, TriangleId t) { return allowed(t, f); },
        "errors, after to before");
}

/// Points scattered at random: the map may be bad, but its claims must hold.
IdVector<PositionId, TrianglePoint> scattered(const Pair& pair, double share, std::mt19937& random)
{
    IdVector<PositionId, TrianglePoint> points = pair.points.of_position;
    std::uniform_real_distribution<float> unit(0, 1);
    for (const PositionId p : points.ids())
    {
        TrianglePoint& point = points[p];
        if (point.triangle == kInvalid || unit(random) > share)
            continue;
        for (int steps = 0; steps < 2; ++steps)
        {
            const CornerId corner = makeCorner(point.triangle, static_cast<uint32_t>(random() % 3));
            const auto fan = pair.after.triangles_at.list(pair.after.position_ids[corner]);
            point.triangle = fan[random() % fan.size()];
        }
        point.v = unit(random);
        point.w = unit(random) * (1 - point.v);
        if (random() % 4 == 0)
            point.v = 0;
        if (random() % 4 == 0)
            point.w = 0;
        const Corners c = pair.after.triangleCorners(point.triangle);
        const Float3 away =
            c[0] * (1 - point.v - point.w) + c[1] * point.v + c[2] * point.w - pair.group.positions[p];
        point.distance2 = dot(away, away);
    }
    return points;
}

/// Minimum shares over several simplifications of a mesh.
Shares expectSound(const SourceMesh& mesh)
{
    std::mt19937 random(3);
    Shares least{1, 1};
    for (const double locked : {0.0, 0.3})
    {
        const GroupMesh group = makeGroup(mesh, locked, random);
        for (const double share : {0.5, 0.1})
            for (const bool merge : {false, true})
            {
                SCOPED_TRACE(testing::Message()
                             << locked << " locked, " << share << " left, merge " << merge);
                const Pair pair = simplifiedTo(share, group, merge);
                if (pair.after.triangleCount() == 0)
                    continue;
                const Shares shares = expectSoundMap(pair, pair.points.of_position);
                expectSoundMap(pair, scattered(pair, 0.05, random));
                expectSoundMap(pair, scattered(pair, 1, random));
                expectSoundErrors(pair);
                if (share == 0.5 && !merge)
                    least = {std::min(least.mapped, shares.mapped), std::min(least.covered, shares.covered)};
            }
    }
    return least;
}

TEST(SurfaceMap, ofARockIsSoundAndWhole)
{
    const Shares shares = expectSound(shapes::rock(9, 0.4f));
    EXPECT_GT(shares.mapped, 0.99);
    EXPECT_GT(shares.covered, 0.97);
}

TEST(SurfaceMap, ofATerrainIsSoundAndWholeInside)
{
    const Shares shares = expectSound(shapes::terrain(22));
    EXPECT_GT(shares.mapped, 0.97);
    EXPECT_GT(shares.covered, 0.5) << "not where the border moved";
}

TEST(SurfaceMap, ofBlocksIsSound)
{
    expectSound(shapes::blocks(9));
}

TEST(SurfaceMap, ofAPlaneIsSound)
{
    expectSound(shapes::grid(20));
}

TEST(SurfaceMap, ofAMoebiusStripIsSound)
{
    expectSound(shapes::moebius(60, 6));
}

TEST(SurfaceMap, ofLooseQuadsIsSound)
{
    expectSound(shapes::foliage(300));
}

TEST(SurfaceMap, ofNonManifoldTrianglesIsSound)
{
    expectSound(shapes::tangle(120, 500));
    expectSound(shapes::tangle(30, 300));
    expectSound(shapes::soup(300));
}

TEST(SurfaceMap, ofSheetsThatLieOnEachOtherIsSound)
{
    SourceMesh mesh = shapes::rock(5, 0.4f);
    SourceMesh other = mesh;
    for (Float3& p : other.positions)
        p = p * 1.001f;
    shapes::append(mesh, other);
    for (size_t i = 0; i < other.indices.size(); i += 3)
        std::swap(other.indices[i], other.indices[i + 1]);
    shapes::append(mesh, other);
    expectSound(mesh);
}

std::vector<HalfEdgeId> findOpposites(std::span<const uint32_t> positions, size_t position_count)
{
    const CornerVector<PositionId> ids(convertIds<PositionId>(positions));
    return findOppositeHalfEdges(ids, position_count).values();
}

TEST(OppositeHalfEdges, areWhereTwoRunTheOtherWayBetweenTheSamePositions)
{
    // two triangles that share an edge; three around another edge; one with a corner twice
    const std::vector<uint32_t> positions{0, 1, 2, 0, 2, 3, 3, 4, 5, 4, 3, 6, 4, 3, 7, 8, 8, 9};
    const std::vector<HalfEdgeId> opposites = findOpposites(positions, 10);
    EXPECT_EQ(opposites[2], HalfEdgeId{3});
    EXPECT_EQ(opposites[3], HalfEdgeId{2});
    for (size_t half_edge = 4; half_edge < 16; ++half_edge)
        EXPECT_EQ(opposites[half_edge], HalfEdgeId{kInvalid}) << half_edge;
    // more triangles around one position than usual
    std::vector<uint32_t> fan;
    for (uint32_t k = 1; k <= 30; ++k)
        fan.insert(fan.end(), {0, k, k % 30 + 1});
    const std::vector<HalfEdgeId> around = findOpposites(fan, 31);
    for (uint32_t k = 0; k < 30; ++k)
        EXPECT_EQ(around[k * 3], HalfEdgeId{(k + 29) % 30 * 3 + 2});
}

} // namespace
