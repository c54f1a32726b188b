// Compares the empty spaces of a grid with a plain flood fill, and tests that no light leaks between two
// spaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/brick_codes.h"
#include "tests/cook/bricks/bricks_scene.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace hearth::bricks
{

namespace
{

uint32_t getIndex(const GridFrame& frame, const Cell& cell)
{
    return cell[0] + frame.voxels[0] * (cell[1] + frame.voxels[1] * cell[2]);
}

template <typename Visit>
void forEachCell(const GridFrame& frame, const Visit& visit)
{
    for (uint32_t z = 0; z < frame.voxels[2]; ++z)
        for (uint32_t y = 0; y < frame.voxels[1]; ++y)
            for (uint32_t x = 0; x < frame.voxels[0]; ++x)
                visit(Cell{x, y, z});
}

/// Grid with these voxels, all with opacity 100 and front faces on all sides.
template <typename IsSolid>
SolidGrid makeGrid(const GridFrame& frame, const IsSolid& is_solid)
{
    SolidGrid grid{frame, std::vector<MaskedCells>(frame.groupCount()), {}, {}};
    SolidVoxel voxel{};
    voxel.opacity = 100;
    voxel.front_visible = 63;
    const Cell groups = frame.groups();
    for (uint32_t g = 0; g < grid.groups.size(); ++g)
    {
        const Cell group{g % groups[0] * 16, g / groups[0] % groups[1] * 16, g / groups[0] / groups[1] * 16};
        grid.groups[g].first = static_cast<uint32_t>(grid.bricks.size());
        for (uint32_t b = 0; b < 64; ++b)
        {
            const Cell at{group[0] + (b & 3) * 4, group[1] + (b >> 2 & 3) * 4, group[2] + (b >> 4) * 4};
            MaskedCells brick{0, static_cast<uint32_t>(grid.voxels.size())};
            for (uint32_t v = 0; v < 64; ++v)
                if (isInside(frame, cellFromBit(at, v)) && is_solid(cellFromBit(at, v)))
                    brick.mask |= uint64_t{1} << v;
            if (brick.mask == 0)
                continue;
            grid.groups[g].mask |= uint64_t{1} << b;
            grid.bricks.push_back(brick);
            grid.voxels.insert(grid.voxels.end(), static_cast<size_t>(std::popcount(brick.mask)), voxel);
        }
    }
    return grid;
}

/// Label the space of each cell that `opens` lets through, by a flood fill from cell to cell; 0 is outside.
template <typename Opens>
std::vector<uint32_t> floodedSpaces(const GridFrame& frame, const Opens& opens)
{
    std::vector<uint32_t> spaces(size_t{frame.voxels[0]} * frame.voxels[1] * frame.voxels[2], kInvalidIndex);
    const auto flood = [&](std::vector<Cell> queue, uint32_t space)
    {
        while (!queue.empty())
        {
            const Cell cell = queue.back();
            queue.pop_back();
            if (!isInside(frame, cell) || !opens(cell) || spaces[getIndex(frame, cell)] != kInvalidIndex)
                continue;
            spaces[getIndex(frame, cell)] = space;
            for (uint32_t face = 0; face < kFaces; ++face)
                queue.push_back(across(cell, face));
        }
    };
    std::vector<Cell> rim;
    forEachCell(frame,
                [&](const Cell& cell)
                {
                    for (uint32_t face = 0; face < kFaces; ++face)
                        if (!isInside(frame, across(cell, face)))
                            rim.push_back(cell);
                });
    flood(rim, 0);
    uint32_t next = 1;
    forEachCell(frame,
                [&](const Cell& cell)
                {
                    if (opens(cell) && spaces[getIndex(frame, cell)] == kInvalidIndex)
                        flood({cell}, next++);
                });
    return spaces;
}

/// Check that both partitions are equal up to renumbering, and that the outside is 0 in both.
void expectSameSpaces(const SolidGrid& grid, const EmptySpaces& spaces, const std::vector<uint32_t>& expected)
{
    std::map<uint32_t, uint32_t> number{{0, EmptySpaces::kOutside}};
    std::set<uint32_t> used;
    forEachCell(grid.frame,
                [&](const Cell& cell)
                {
                    if (grid.voxelAt(cell) != kInvalidIndex)
                        return;
                    const uint32_t space = spaces.at(grid, cell);
                    const auto [at, is_new] = number.emplace(expected[getIndex(grid.frame, cell)], space);
                    EXPECT_EQ(at->second, space);
                    EXPECT_TRUE(!is_new || (used.insert(space).second && space != EmptySpaces::kOutside));
                    EXPECT_LT(space, spaces.count());
                });
}

/// Room with thin walls: a box that faces in, inside a slightly larger one that faces out. Rotated at random;
/// with acute edges if `skewed`.
struct Room
{
    Double3 middle;
    std::array<Double3, 3> half; ///< from the middle to the inner sides
    std::vector<Corners> triangles;
};

Room randomRoom(Random& random, double size, double thickness, bool skewed)
{
    Room room;
    room.middle = Double3{size / 2, size / 2, size / 2} + uniformPoint(random, -0.5, 0.5);
    const std::array<Double3, 3> frame = randomFrame(random);
    std::array<Double3, 3> outer;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        const double half = uniform(random, 0.12, 0.25) * size;
        room.half[axis] = frame[axis] * half;
        outer[axis] = frame[axis] * (half + thickness);
    }
    if (skewed)
        for (std::array<Double3, 3>* sides : {&room.half, &outer})
        {
            const auto& [a, b, c] = *sides;
            *sides = {a * 0.7, b * 0.7 + a * 0.8, c * 0.6 + b * 0.5};
        }
    addBox(room.triangles, room.middle, room.half[0], room.half[1], room.half[2], true);
    if (thickness > 0)
        addBox(room.triangles, room.middle, outer[0], outer[1], outer[2], false);
    return room;
}

/// Return the share of light that leaves the grid from a point along a direction, as lighting rays compute
/// it.
double transmittance(const BrickTables& tables, const Double3& from, const Double3& direction)
{
    const shared::BrickMasks masks = tables.masks();
    double left = 1;
    shared::BrickRay ray = shared::brickMarch(
        masks, shared::brickRay(masks.grid, narrow(from), narrow(direction), shared::kBrickInfinity));
    while (ray.inside != 0)
    {
        left *= 1 - tables.opacity[shared::brickVoxel(tables.bricks[ray.brick], ray.bit)] / 255.0;
        ray = shared::brickMarch(masks, shared::brickSkipVoxel(masks, ray));
    }
    return left;
}

Double3 randomDirection(Random& random)
{
    return randomFrame(random)[0];
}

} // namespace

TEST(EmptySpaces, isWhatAFloodFinds)
{
    Random random(5);
    for (int round = 0; round < 40; ++round)
    {
        const auto upTo = [&](uint32_t most) { return 1 + static_cast<uint32_t>(random()) % most; };
        const uint32_t x = upTo(40), y = upTo(24);
        const GridFrame frame = frameOfSize(x, y, upTo(20));
        const double share = uniform(random, 0, 1), blocks = 1 + static_cast<double>(random() % 5);
        const uint32_t seed = static_cast<uint32_t>(random());
        const auto isSolid = [&](const Cell& cell)
        {
            // in blocks, so that bricks and groups are empty too
            uint32_t hash = seed;
            for (const uint32_t at : cell)
            {
                hash = (hash ^ static_cast<uint32_t>(at / blocks)) * 0x9E3779B1u;
                hash ^= hash >> 15;
            }
            return hash / 4294967296.0 < share;
        };
        const SolidGrid grid = makeGrid(frame, isSolid);
        expectSameSpaces(grid, EmptySpaces(grid),
                         floodedSpaces(frame, [&](const Cell& cell) { return !isSolid(cell); }));
    }
}

TEST(EmptySpaces, isWholeWhereNothingIs)
{
    const SolidGrid grid = makeGrid(frameOfSize(33, 20, 5), [](const Cell&) { return false; });
    EXPECT_EQ(EmptySpaces(grid).count(), 1u);
}

TEST(SeparateSpaces, leaveNoWayFromOneToAnother)
{
    Random random(6);
    for (int round = 0; round < 40; ++round)
    {
        const GridFrame frame = frameOfSize(12, 12, 12);
        std::vector<bool> solid(12 * 12 * 12);
        for (size_t i = 0; i < solid.size(); ++i)
            solid[i] = uniform(random, 0, 1) < 0.7;
        SolidGrid grid = makeGrid(frame, [&](const Cell& cell) { return solid[getIndex(frame, cell)]; });
        for (SolidVoxel& voxel : grid.voxels)
            voxel.opacity = uniform(random, 0, 1) < 0.3 ? kOpaque : 100;
        const EmptySpaces spaces(grid);
        const SolidGrid before = grid;
        const std::vector<uint32_t> space_of_voxel = separateSpaces(grid, spaces);
        const auto opens = [&](const Cell& cell)
        {
            const uint32_t voxel = grid.voxelAt(cell);
            return voxel == kInvalidIndex || grid.voxels[voxel].opacity != kOpaque;
        };
        const std::vector<uint32_t> through = floodedSpaces(frame, opens);
        std::map<uint32_t, uint32_t> space_of;
        forEachCell(frame,
                    [&](const Cell& cell)
                    {
                        const uint32_t voxel = grid.voxelAt(cell);
                        if (voxel == kInvalidIndex)
                        {
                            const uint32_t space = spaces.at(grid, cell);
                            EXPECT_EQ(space_of.emplace(through[getIndex(frame, cell)], space).first->second,
                                      space);
                            return;
                        }
                        EXPECT_TRUE(opens(cell) || space_of_voxel[voxel] == kInvalidIndex);
                    });
        // each voxel that became opaque separates two spaces
        size_t changed = 0;
        for (size_t v = 0; v < grid.voxels.size(); ++v)
        {
            EXPECT_TRUE(grid.voxels[v].opacity == before.voxels[v].opacity ||
                        grid.voxels[v].opacity == kOpaque);
            changed += grid.voxels[v].opacity != before.voxels[v].opacity ? 1u : 0u;
        }
        EXPECT_LT(changed, grid.voxels.size());
    }
}

TEST(SeparateSpaces, changesNothingInTheOpen)
{
    Random random(7);
    SolidGrid grid =
        makeGrid(frameOfSize(20, 20, 20), [&](const Cell&) { return uniform(random, 0, 1) < 0.05; });
    separateSpaces(grid, EmptySpaces(grid));
    for (const SolidVoxel& voxel : grid.voxels)
        EXPECT_EQ(voxel.opacity, 100);
}

TEST(Rooms, areExactlyDarkHoweverTheyAreTurned)
{
    Random random(8);
    for (int round = 0; round < 24; ++round)
    {
        const double thickness = round % 3 == 0 ? 0 : round % 3 == 1 ? 0.3 : 1.7;
        const Room room = randomRoom(random, 40, thickness, round % 2 == 0);
        const GridWithFaces grid = addFaces(makeSolidGrid(room.triangles, frameOfSize(40, 40, 40)));
        const BrickTables tables = makeBrickTables(grid.solid, grid.faces);
        int rays = 0;
        for (int ray = 0; ray < 3000; ++ray)
        {
            Double3 from = room.middle;
            for (const Double3& half : room.half)
                from = from + half * uniform(random, -1, 1);
            const Cell cell{static_cast<uint32_t>(from.x), static_cast<uint32_t>(from.y),
                            static_cast<uint32_t>(from.z)};
            if (grid.solid.voxelAt(cell) != kInvalidIndex)
                continue;
            EXPECT_EQ(transmittance(tables, from, randomDirection(random)), 0) << "round " << round;
            ++rays;
        }
        EXPECT_GT(rays, 1000);
    }
}

TEST(Rooms, haveFacesInsideAndRocksDoNot)
{
    Random random(9);
    for (int round = 0; round < 6; ++round)
    {
        const bool inwards = round % 2 == 0;
        std::vector<Corners> triangles;
        const std::array<Double3, 3> frame = randomFrame(random);
        addBox(triangles, {16, 16, 16}, frame[0] * 8, frame[1] * 7, frame[2] * 6, inwards);
        const auto insideFaces = [&](std::span<const Float3> seeds)
        {
            const GridWithFaces grid = addFaces(makeSolidGrid(triangles, frameOfSize(32, 32, 32)), seeds);
            EXPECT_EQ(grid.seen.sealed, inwards || !seeds.empty() ? 0u : 1u);
            const EmptySpaces spaces(grid.solid);
            size_t faces = 0;
            forEachCell(grid.solid.frame,
                        [&](const Cell& cell)
                        {
                            const uint32_t voxel = grid.solid.voxelAt(cell);
                            if (voxel == kInvalidIndex)
                                return;
                            for (uint32_t face = 0; face < kFaces; ++face)
                            {
                                const Cell next = across(cell, face);
                                if (isInside(grid.solid.frame, next) &&
                                    grid.solid.voxelAt(next) == kInvalidIndex &&
                                    spaces.at(grid.solid, next) != EmptySpaces::kOutside)
                                    faces += (grid.faces[voxel] >> face & 1) != 0 ? 1u : 0u;
                            }
                        });
            return faces;
        };
        EXPECT_EQ(insideFaces({}) > 500, inwards);
        const Float3 seed{16, 16, 16};
        EXPECT_GT(insideFaces({&seed, 1}), 500u); // a camera in a rock sees the rock's inside
    }
}

TEST(Opacity, isAllOfAPlaneAndAShareOfBlades)
{
    Random random(10);
    for (int round = 0; round < 12; ++round)
    {
        // a plane that ends outside of the grid: rays through its middle are stopped
        const std::array<Double3, 3> frame = randomFrame(random);
        const Double3 middle = uniformPoint(random, 14, 18);
        const auto at = [&](double u, double v) { return middle + frame[0] * u + frame[1] * v; };
        const std::vector<Corners> plane{{{at(-80, -80), at(80, -80), at(80, 80)}},
                                         {{at(-80, -80), at(80, 80), at(-80, 80)}}};
        const SolidGrid grid = makeSolidGrid(plane, frameOfSize(32, 32, 32));
        const GridWithFaces faced = addFaces(grid);
        const BrickTables tables = makeBrickTables(faced.solid, faced.faces);
        for (int ray = 0; ray < 500; ++ray)
        {
            const Double3 through = at(uniform(random, -4, 4), uniform(random, -4, 4));
            Double3 direction = randomDirection(random);
            if (std::abs(dot(direction, frame[2])) < 0.2)
                continue;
            EXPECT_EQ(transmittance(tables, through - direction * 100, direction), 0);
        }
    }
    // blades a twentieth of a voxel thick, a tenth high, five a voxel: no voxel there is opaque
    std::vector<Corners> blades;
    for (int i = 0; i < 1280; ++i)
    {
        const Double3 root = Double3{uniform(random, 2, 18), uniform(random, 3, 4), uniform(random, 2, 18)};
        const Double3 across{uniform(random, -0.05, 0.05), 0, uniform(random, -0.05, 0.05)};
        blades.push_back({{root - across, root + across, root + Double3{0, 0.8, 0}}});
    }
    const SolidGrid grass = makeSolidGrid(blades, frameOfSize(20, 8, 20));
    double sum = 0;
    for (const SolidVoxel& voxel : grass.voxels)
    {
        EXPECT_GT(voxel.opacity, 0);
        EXPECT_LT(voxel.opacity, 160);
        sum += voxel.opacity;
    }
    EXPECT_GT(sum / static_cast<double>(grass.voxels.size()), 10);
}

} // namespace hearth::bricks
