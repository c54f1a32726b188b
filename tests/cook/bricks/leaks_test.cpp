// Tests the insides of closed surfaces against what their solids are, and the gaps that they close.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/leaks.h"
#include "tests/cook/bricks/bricks_scene.h"

#include <gtest/gtest.h>
#include <set>

namespace hearth::bricks
{

namespace
{

ClosedSurface makeSurface(const std::vector<Corners>& triangles)
{
    ClosedSurface surface;
    for (const Corners& triangle : triangles)
        for (const Double3& corner : triangle.at)
        {
            surface.indices.push_back(static_cast<uint32_t>(surface.positions.size()));
            surface.positions.push_back(corner);
        }
    return surface;
}

struct Block
{
    Double3 middle;
    std::array<Double3, 3> half;

    bool has(const Double3& point) const
    {
        for (const Double3& axis : half)
            if (std::abs(dot(point - middle, axis)) > dot(axis, axis))
                return false;
        return true;
    }
    void addTo(std::vector<Corners>& triangles, bool inwards) const
    {
        addBox(triangles, middle, half[0], half[1], half[2], inwards);
    }
};

Block randomBlock(Random& random, const Double3& middle, double low, double high)
{
    Block block{middle, randomFrame(random)};
    for (Double3& axis : block.half)
        axis = axis * uniform(random, low, high);
    return block;
}

template <typename Visit>
void visitCells(const GridFrame& frame, const Visit& visit)
{
    for (uint32_t z = 0; z < frame.voxels[2]; ++z)
        for (uint32_t y = 0; y < frame.voxels[1]; ++y)
            for (uint32_t x = 0; x < frame.voxels[0]; ++x)
                visit(Cell{x, y, z});
}

// Room of the tests of gaps: its walls lie on planes of the grid, in voxels 8 to 23 along each axis.
constexpr double kLow = 8, kHigh = 24;

/// Walls of the room that face in, from one plane each, with a hole of `hole` x `hole` voxels in the one at
/// x = kHigh.
std::vector<Corners> makeLeakyRoom(double hole)
{
    std::vector<Corners> triangles;
    const double middle = (kLow + kHigh) / 2, half = (kHigh - kLow) / 2;
    addBox(triangles, {middle, middle, middle}, {half, 0, 0}, {0, half, 0}, {0, 0, half}, true);
    std::erase_if(triangles,
                  [](const Corners& triangle) {
                      return std::ranges::all_of(triangle.at,
                                                 [](const Double3& corner) { return corner.x == kHigh; });
                  });
    const auto quad = [&](double y0, double z0, double y1, double z1)
    {
        const Double3 a{kHigh, y0, z0}, b{kHigh, y0, z1}, c{kHigh, y1, z1}, d{kHigh, y1, z0};
        triangles.push_back({{a, b, c}});
        triangles.push_back({{a, c, d}});
    };
    const double from = middle - hole / 2, to = middle + hole / 2;
    quad(kLow, kLow, from, kHigh);
    quad(to, kLow, kHigh, kHigh);
    quad(from, kLow, to, from);
    quad(from, to, to, kHigh);
    return triangles;
}

/// Closed box at a distance around the room.
ClosedSurface makeRoomProxy(double distance)
{
    std::vector<Corners> triangles;
    const double middle = (kLow + kHigh) / 2, half = (kHigh - kLow) / 2 + distance;
    addBox(triangles, {middle, middle, middle}, {half, 0, 0}, {0, half, 0}, {0, 0, half}, false);
    return makeSurface(triangles);
}

bool isOutside(const SolidGrid& grid, const Cell& cell)
{
    return EmptySpaces(grid).at(grid, cell) == EmptySpaces::kOutside;
}

constexpr Cell kRoomMiddle{16, 16, 16};

} // namespace

TEST(Interior, isThatOfItsSolids)
{
    Random random(21);
    for (int round = 0; round < 12; ++round)
    {
        const GridFrame frame = frameOfSize(33, 30, 35);
        // two blocks that overlap, one with a cavity, and a mirrored one of its own
        const Block first = randomBlock(random, uniformPoint(random, 12, 14), 5, 8);
        const Block second = randomBlock(random, first.middle + Double3{5, 3, 2}, 4, 6);
        const Block cavity = randomBlock(random, first.middle - Double3{2, 2, 2}, 0.7, 1);
        const Block apart = randomBlock(random, {27, 5, 28}, 1, 4);
        std::vector<Corners> triangles;
        first.addTo(triangles, false);
        second.addTo(triangles, false);
        if (!second.has(cavity.middle))
            cavity.addTo(triangles, true);
        apart.addTo(triangles, true);
        const Interior interior(makeSurface(triangles), frame);
        size_t inside = 0;
        visitCells(frame,
                   [&](const Cell& cell)
                   {
                       const Double3 at{cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5};
                       const bool is_hollow = !second.has(cavity.middle) && cavity.has(at);
                       // the second block may reach into the cavity: the walls of both then count
                       if (is_hollow && second.has(at))
                           return;
                       const bool is_solid = first.has(at) || second.has(at) || apart.has(at);
                       EXPECT_EQ(interior.has(cell), is_solid && !is_hollow)
                           << cell[0] << ' ' << cell[1] << ' ' << cell[2];
                       inside += is_solid ? 1 : 0;
                   });
        EXPECT_GT(inside, 300u);
    }
}

TEST(Interior, endsAtTheGridAndIgnoresWhatHasNoPlace)
{
    std::vector<Corners> triangles;
    addBox(triangles, {0, 0, 0}, {100, 0, 0}, {0, 5, 0}, {0, 0, 100}, false);
    const double infinity = std::numeric_limits<double>::infinity();
    triangles.push_back({{Double3{0, 0, 0}, Double3{infinity, 1, 1}, Double3{1, 5, 1}}});
    const Interior interior(makeSurface(triangles), frameOfSize(9, 20, 7));
    size_t voxels = 0;
    visitCells(frameOfSize(9, 20, 7), [&](const Cell& cell) { voxels += interior.has(cell) ? 1 : 0; });
    EXPECT_EQ(voxels, 9u * 5 * 7);
    EXPECT_TRUE(interior.runs(9, 0).empty());
    EXPECT_TRUE(interior.runs(0, 5).empty());
}

TEST(CloseLeaks, dividesARoomFromTheOutsideByVoxelsInItsGapsAlone)
{
    for (const double hole : {3.0, 8.0, 15.0})
        for (const double distance : {0.02, 0.3, 0.9, 1.4, 2.0})
        {
            SolidGrid grid = makeSolidGrid(makeLeakyRoom(hole), frameOfSize(32, 32, 32));
            const SolidGrid before = grid;
            ASSERT_TRUE(isOutside(grid, kRoomMiddle)) << "the hole lets nothing in";
            const LeakStatistics statistics =
                closeLeaks(grid, 1, [&](size_t) { return makeRoomProxy(distance); });
            EXPECT_FALSE(isOutside(grid, kRoomMiddle)) << hole << ", " << distance;
            EXPECT_EQ(statistics.surfaces, 1u);
            EXPECT_EQ(statistics.loose_surfaces, 0u);
            EXPECT_EQ(grid.voxels.size(), before.voxels.size() + statistics.voxels);
            size_t added = 0;
            visitCells(grid.frame,
                       [&](const Cell& cell)
                       {
                           const uint32_t voxel = grid.voxelAt(cell), old = before.voxelAt(cell);
                           if (old != kInvalidIndex)
                           {
                               ASSERT_NE(voxel, kInvalidIndex);
                               EXPECT_EQ(grid.voxels[voxel].albedo, before.voxels[old].albedo);
                               EXPECT_EQ(grid.voxels[voxel].opacity, before.voxels[old].opacity);
                           }
                           else if (voxel != kInvalidIndex)
                           {
                               ++added;
                               EXPECT_EQ(grid.voxels[voxel].opacity, kOpaque);
                               // in the room, near the hole: no wall is thicker than before
                               EXPECT_TRUE(cell[0] >= 13 && cell[0] < 24);
                               EXPECT_TRUE(cell[1] >= 8 && cell[1] < 24 && cell[2] >= 8 && cell[2] < 24);
                           }
                       });
            EXPECT_EQ(added, statistics.voxels);
            EXPECT_LE(static_cast<double>(added), 2 * (hole + 8) * (hole + 8)) << hole << ", " << distance;
        }
}

TEST(CloseLeaks, changesNothingWhereMeshesAreClosed)
{
    Random random(22);
    for (int round = 0; round < 8; ++round)
    {
        std::vector<Corners> triangles, around;
        const Block block = randomBlock(random, uniformPoint(random, 15, 17), 4, 8);
        block.addTo(triangles, round % 2 == 0);
        Block proxy = block;
        for (Double3& axis : proxy.half)
            axis = axis * (1 + uniform(random, 0.01, 1.5) / length(axis));
        proxy.addTo(around, false);
        SolidGrid grid = makeSolidGrid(triangles, frameOfSize(32, 32, 32));
        const size_t voxels = grid.voxels.size();
        const LeakStatistics statistics = closeLeaks(grid, 1, [&](size_t) { return makeSurface(around); });
        EXPECT_EQ(statistics.voxels, 0u);
        EXPECT_EQ(grid.voxels.size(), voxels);
    }
}

TEST(CloseLeaks, leavesOutSurfacesThatAreFarFromTheirMesh)
{
    SolidGrid grid = makeSolidGrid(makeLeakyRoom(3), frameOfSize(32, 32, 32));
    const LeakStatistics statistics = closeLeaks(grid, 1, [&](size_t) { return makeRoomProxy(6); });
    EXPECT_EQ(statistics.loose_surfaces, 1u);
    EXPECT_EQ(statistics.voxels, 0u);
    EXPECT_TRUE(isOutside(grid, kRoomMiddle));
}

TEST(CloseLeaks, givesVoxelsTheColourOfTheNearestWall)
{
    SurfaceMaterial red = defaultMaterial();
    red.record.base_color = {0.8f, 0.1f, 0.1f, 1};
    SolidGrid grid = makeSolidGrid(makeLeakyRoom(8), frameOfSize(32, 32, 32), red);
    std::set<uint32_t> colours;
    for (const SolidVoxel& voxel : grid.voxels)
        for (const uint32_t code : voxel.albedo)
            colours.insert(code);
    closeLeaks(grid, 2, [&](size_t) { return makeRoomProxy(0.3); });
    for (const SolidVoxel& voxel : grid.voxels)
        for (const uint32_t code : voxel.albedo)
            EXPECT_TRUE(colours.contains(code));
}

} // namespace hearth::bricks
