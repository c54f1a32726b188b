// Tests surface fitting: it moves only what it may, and the fitted surface is nearer to the old one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_fit.h"

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/partition/split.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace hearth;
using namespace hearth::clusters;
using mesh::SourceMesh;

/// Group, its simplification, and the result of fitting.
struct Fitted
{
    GroupMesh group;
    SimplifiedGroup before;
    SimplifiedGroup after;
    SurfacePoints points;
    Surface surface;
};

/// All clusters of a mesh as one group, with every `lock_every`-th position locked.
Fitted fit(const SourceMesh& mesh, double share, size_t lock_every)
{
    const PreparedMesh prepared = prepareMesh(mesh);
    const ClusterStore store = splitMesh(prepared);
    const IdRange<ClusterId> all = store.shapes.ids();
    const std::vector<ClusterId> members(all.begin(), all.end());
    IdVector<MeshPositionId, uint8_t> locked(prepared.position_count, 0);
    for (size_t p = 0; p < locked.size(); p += lock_every)
        locked[toId<MeshPositionId>(p)] = 1;
    GroupMesh group = gatherGroup(prepared, store, members, locked, {});
    const auto target = static_cast<size_t>(share * static_cast<double>(group.triangleCount()));
    const SimplifiedGroup before = simplifyGroup(group, target, target);
    SimplifiedGroup after = before;
    Surface surface(gatherPositionIds(group, after.corners), after.placement.positions);
    SurfacePoints points = findPoints(group, after, surface);
    fitToGroup(group, after, surface, points);
    return {std::move(group), before, std::move(after), std::move(points), std::move(surface)};
}

double rmsDistance(const GroupMesh& group, const SimplifiedGroup& simplified)
{
    const auto numbers = [](const CornerVector<PositionId>& ids)
    {
        std::vector<uint32_t> result;
        for (const PositionId id : ids)
            result.push_back(toIndex(id));
        return result;
    };
    const std::vector<uint32_t> old_triangles = numbers(gatherPositionIds(group, group.corners));
    const std::vector<uint32_t> new_triangles = numbers(gatherPositionIds(group, simplified.corners));
    const SurfaceDistance distance(simplified.placement.positions, new_triangles);
    double sum = 0;
    const auto points = evenlySpread(group.positions, old_triangles, 20000);
    for (const SurfacePoint& point : points)
    {
        const double away = distance.to(valueAt(point, group.positions, old_triangles));
        sum += away * away;
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

SourceMesh sphere()
{
    return shapes::rock(16, 0);
}

TEST(SurfaceFit, bringsCurvedGroundNearer)
{
    const Fitted ball = fit(sphere(), 0.3, 1000000);
    EXPECT_LT(rmsDistance(ball.group, ball.after), 0.85 * rmsDistance(ball.group, ball.before));
}

TEST(SurfaceFit, bringsRoughGroundNearer)
{
    const Fitted rock = fit(shapes::rock(20, 0.3f), 0.3, 50);
    EXPECT_LT(rmsDistance(rock.group, rock.after), 0.97 * rmsDistance(rock.group, rock.before));
}

/// Stairs: floors three cells deep, walls one cell high.
SourceMesh stairs()
{
    constexpr uint32_t kCells = 36;
    SourceMesh mesh = shapes::grid(kCells);
    for (Float3& p : mesh.positions)
    {
        const auto along = static_cast<uint32_t>(std::lround(p.x * kCells));
        p.x = static_cast<float>(along / 4 * 3 + along % 4) / kCells;
        p.z = static_cast<float>(along / 4) / kCells;
    }
    return mesh;
}

TEST(SurfaceFit, leavesWhatIsExactAsItIs)
{
    // geometry beyond the border of a fan must not attract it
    for (const double share : {0.8, 0.6, 0.4})
    {
        const Fitted fitted = fit(stairs(), share, 1000000);
        const double before = rmsDistance(fitted.group, fitted.before);
        EXPECT_LT(rmsDistance(fitted.group, fitted.after), 1.2 * before + 1e-6) << share << ", " << before;
    }
}

/// Square floors of `cells` x `cells`, each at its own height, with walls between them.
SourceMesh terraces(uint32_t cells)
{
    const uint32_t across = cells + 1;
    const uint32_t count = across * 7;
    SourceMesh mesh = shapes::grid(count);
    for (Float3& p : mesh.positions)
    {
        const auto x = static_cast<uint32_t>(std::lround(p.x * static_cast<float>(count)));
        const auto y = static_cast<uint32_t>(std::lround(p.y * static_cast<float>(count)));
        p = {static_cast<float>(x / across * cells + x % across),
             static_cast<float>(y / across * cells + y % across),
             static_cast<float>((x / across * 5 + y / across * 3) % 4) * 0.375f};
    }
    return mesh;
}

TEST(SurfaceFit, keepsFloorsFlatBesideWalls)
{
    // more than half of the triangles can go without loss; walls and other floors must not attract the
    // remaining vertices
    for (const uint32_t cells : {3u, 4u, 6u})
        for (const double share : {0.6, 0.5, 0.4})
        {
            const Fitted fitted = fit(terraces(cells), share, 1000000);
            ASSERT_LT(rmsDistance(fitted.group, fitted.before), 1e-9);
            EXPECT_LT(rmsDistance(fitted.group, fitted.after), 1e-9) << cells << ", " << share;
        }
}

TEST(SurfaceFit, movesOnlyWhatIsRemade)
{
    const Fitted rock = fit(shapes::rock(20, 0.3f), 0.4, 3);
    size_t moved = 0;
    for (const PositionId p : rock.group.positions.ids())
    {
        const bool stays = rock.after.placement.positions[p] == rock.before.placement.positions[p];
        EXPECT_TRUE(stays || (rock.before.placement.modified[p] != 0 && rock.group.locked[p] == 0))
            << toIndex(p);
        moved += stays ? 0 : 1;
    }
    EXPECT_GT(moved, 100u);
    EXPECT_EQ(rock.after.corners.values(), rock.before.corners.values());
    EXPECT_EQ(rock.after.placement.modified.values(), rock.before.placement.modified.values());
}

TEST(SurfaceFit, keepsMovedPlacesOnTheGrid)
{
    const Fitted rock = fit(shapes::rock(20, 0.3f), 0.4, 3);
    for (const PositionId p : rock.group.positions.ids())
        if (rock.after.placement.modified[p] != 0)
            for (int axis = 0; axis < 3; ++axis)
            {
                const double steps = rock.after.placement.object_positions[p][axis] / rock.group.grid_step;
                EXPECT_EQ(steps, std::nearbyint(steps));
            }
}

TEST(SurfaceFit, leavesAttributesAtSeamsAlone)
{
    // one UV chart for each face of the cube: two wedges at each position between charts
    const Fitted rock = fit(shapes::rock(20, 0.2f), 0.4, 1000000);
    const uint32_t rows = rock.group.attribute_rows;
    size_t changed = 0, at_seams = 0;
    for (const WedgeId wedge : rock.group.vertex_of_wedge.ids())
    {
        const PositionId position = rock.group.position_id_of_wedge[wedge];
        bool same = true;
        for (uint32_t r = 0; r < rows; ++r)
            for (size_t lane = 0; lane < kLanes; ++lane)
                same &= rock.after.placement.attributes[rock.group.firstRow(wedge) + r][lane] ==
                        rock.before.placement.attributes[rock.group.firstRow(wedge) + r][lane];
        if (rock.points.on_seam[position] != 0 && rock.after.placement.modified[position] != 0)
        {
            EXPECT_TRUE(same) << toIndex(wedge);
            ++at_seams;
        }
        changed += same ? 0 : 1;
    }
    EXPECT_GT(at_seams, 10u);
    EXPECT_GT(changed, 100u);
}

TEST(SurfaceFit, pointsAndSurfaceGoWithIt)
{
    const Fitted rock = fit(shapes::rock(20, 0.3f), 0.4, 3);
    for (const CornerId corner : rock.surface.position_ids.ids())
        EXPECT_EQ(rock.surface.corner_positions[corner],
                  rock.after.placement.positions[rock.surface.position_ids[corner]]);
    for (const PositionId p : rock.group.positions.ids())
        if (const TrianglePoint& point = rock.points.of_position[p]; point.triangle != kInvalid)
        {
            const Float3 away = rock.group.positions[p] - trianglePosition(point, rock.surface.triangles);
            EXPECT_EQ(point.distance2, dot(away, away));
        }
}

} // namespace
