// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/memory_budget.h"

#include "cook/bricks/voxels/focus.h"

#include <algorithm>
#include <numeric>

namespace hearth::bricks
{

namespace
{

/// Return the distance of each brick to the nearest focus point.
std::vector<double> computeBrickDistances(const SolidGrid& grid, std::span<const Float3> foci)
{
    std::vector<double> distances;
    for (const Cell& cell : grid.brickCells())
        distances.push_back(brickDistance(grid.frame, foci, cell));
    return distances;
}

uint64_t brickMemory(const SolidGrid& grid, std::span<const uint8_t> faces, uint32_t brick)
{
    const auto voxels = static_cast<uint32_t>(std::popcount(grid.bricks[brick].mask));
    uint64_t face_count = 0;
    for (uint32_t v = grid.bricks[brick].first; v < grid.bricks[brick].first + voxels; ++v)
        face_count += static_cast<uint64_t>(std::popcount(faces[v]));
    return computeBrickBytes(0, 1, voxels, face_count).total();
}

GridWithFaces findFaces(SolidGrid solid, std::span<const Float3> seen_points)
{
    const EmptySpaces spaces(solid);
    GridWithFaces grid{std::move(solid), {}, {}, {}};
    grid.seen = findVisibleSpaces(grid.solid, spaces, seen_points);
    const std::vector<uint32_t> space_of_voxel = separateSpaces(grid.solid, spaces);
    grid.faces = visibleFaces(grid.solid, spaces, grid.seen, space_of_voxel);
    return grid;
}

/// Return the grid with the selected bricks and their faces.
GridWithFaces keepBricks(const GridWithFaces& whole, const std::vector<bool>& kept)
{
    GridWithFaces some{{whole.solid.frame, {}, {}, {}}, {}, whole.seen, {}};
    for (const MaskedCells& group : whole.solid.groups)
    {
        MaskedCells kept_group{0, static_cast<uint32_t>(some.solid.bricks.size())};
        uint32_t brick = group.first;
        for (uint64_t rest = group.mask; rest != 0; rest &= rest - 1, ++brick)
        {
            if (!kept[brick])
                continue;
            kept_group.mask |= rest & (~rest + 1);
            const MaskedCells& solid = whole.solid.bricks[brick];
            some.solid.bricks.push_back({solid.mask, static_cast<uint32_t>(some.solid.voxels.size())});
            const auto count = std::popcount(solid.mask);
            const auto first = whole.solid.voxels.begin() + solid.first;
            some.solid.voxels.insert(some.solid.voxels.end(), first, first + count);
            const auto first_face = whole.faces.begin() + solid.first;
            some.faces.insert(some.faces.end(), first_face, first_face + count);
        }
        some.solid.groups.push_back(kept_group);
    }
    return some;
}

} // namespace

BrickBytes GridWithFaces::bytes() const
{
    uint64_t face_count = 0;
    for (const uint8_t face_mask : faces)
        face_count += static_cast<uint64_t>(std::popcount(face_mask));
    return computeBrickBytes(solid.groups.size(), solid.bricks.size(), solid.voxels.size(), face_count);
}

GridWithFaces fitToMemory(SolidGrid solid, std::span<const Float3> seen_points, std::span<const Float3> foci,
                          uint64_t memory)
{
    GridWithFaces grid = findFaces(std::move(solid), seen_points);
    if (grid.bytes().total() <= memory)
        return grid;

    const std::vector<double> distances = computeBrickDistances(grid.solid, foci);
    std::vector<uint32_t> nearest_first(distances.size());
    std::iota(nearest_first.begin(), nearest_first.end(), 0u);
    std::ranges::stable_sort(nearest_first, {}, [&](uint32_t brick) { return distances[brick]; });
    std::vector<bool> kept(distances.size());
    uint64_t used = computeBrickBytes(grid.solid.groups.size(), 0, 0, 0).total();
    size_t count = 0;
    for (;; ++count)
    {
        used += brickMemory(grid.solid, grid.faces, nearest_first[count]);
        if (used > memory)
            break;
        kept[nearest_first[count]] = true;
    }
    GridWithFaces some = keepBricks(grid, kept);
    some.dropped = {distances.size() - count, grid.solid.voxels.size() - some.solid.voxels.size(), 0,
                    distances[nearest_first[count]]};
    return some;
}

} // namespace hearth::bricks
