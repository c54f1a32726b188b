// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/budget.h"

#include <algorithm>
#include <numeric>

namespace hearth::bricks
{

namespace
{

/// Distance of each brick's middle from the nearest focus, metres.
std::vector<double> distancesOf(const SolidGrid& grid, std::span<const Float3> foci)
{
    std::vector<double> distances;
    for (const Cell& cell : grid.brickCells())
    {
        const auto along = [&](size_t axis) {
            return grid.frame.origin[static_cast<int>(axis)] +
                   double{grid.frame.voxel_size} * (cell[axis] + 2.0);
        };
        const Double3 middle{along(0), along(1), along(2)};
        double nearest = std::numeric_limits<double>::infinity();
        for (const Float3& focus : foci)
            nearest = std::min(nearest, length(middle - widen(focus)));
        distances.push_back(nearest);
    }
    return distances;
}

uint64_t bytesOfBrick(const SolidGrid& grid, std::span<const uint8_t> faces, uint32_t brick)
{
    const auto voxels = static_cast<uint32_t>(std::popcount(grid.bricks[brick].mask));
    uint64_t face_count = 0;
    for (uint32_t v = grid.bricks[brick].first; v < grid.bricks[brick].first + voxels; ++v)
        face_count += static_cast<uint64_t>(std::popcount(faces[v]));
    return bytesOf(0, 1, voxels, face_count).total();
}

FacedGrid faced(SolidGrid solid, std::span<const Float3> seen_points)
{
    const OpenSpace spaces(solid);
    FacedGrid grid{std::move(solid), {}, {}, {}};
    grid.seen = seenSpaces(grid.solid, spaces, seen_points);
    const std::vector<uint32_t> space_of_voxel = separateSpaces(grid.solid, spaces);
    grid.faces = visibleFaces(grid.solid, spaces, grid.seen, space_of_voxel);
    return grid;
}

/// The grid with the bricks that are kept.
SolidGrid filtered(const SolidGrid& grid, const std::vector<bool>& kept)
{
    SolidGrid some{grid.frame, {}, {}, {}};
    for (const MaskedCells& group : grid.groups)
    {
        MaskedCells of_group{0, static_cast<uint32_t>(some.bricks.size())};
        uint32_t brick = group.first;
        for (uint64_t rest = group.mask; rest != 0; rest &= rest - 1, ++brick)
        {
            if (!kept[brick])
                continue;
            of_group.mask |= rest & (~rest + 1);
            const MaskedCells& solid = grid.bricks[brick];
            some.bricks.push_back({solid.mask, static_cast<uint32_t>(some.voxels.size())});
            const auto first = grid.voxels.begin() + solid.first;
            some.voxels.insert(some.voxels.end(), first, first + std::popcount(solid.mask));
        }
        some.groups.push_back(of_group);
    }
    return some;
}

} // namespace

BrickBytes FacedGrid::bytes() const
{
    uint64_t face_count = 0;
    for (const uint8_t of_voxel : faces)
        face_count += static_cast<uint64_t>(std::popcount(of_voxel));
    return bytesOf(solid.groups.size(), solid.bricks.size(), solid.voxels.size(), face_count);
}

FacedGrid withinBudget(SolidGrid solid, std::span<const Float3> seen_points, std::span<const Float3> foci,
                       uint64_t memory)
{
    FacedGrid grid = faced(std::move(solid), seen_points);
    if (grid.bytes().total() <= memory)
        return grid;

    const SolidGrid whole = std::move(grid.solid);
    const std::vector<double> distances = distancesOf(whole, foci);
    std::vector<uint64_t> bytes(whole.bricks.size());
    for (uint32_t brick = 0; brick < bytes.size(); ++brick)
        bytes[brick] = bytesOfBrick(whole, grid.faces, brick);
    std::vector<uint32_t> nearest_first(whole.bricks.size());
    std::iota(nearest_first.begin(), nearest_first.end(), 0u);
    std::ranges::stable_sort(nearest_first, {}, [&](uint32_t brick) { return distances[brick]; });

    uint64_t allowed = memory;
    for (;;)
    {
        std::vector<bool> kept(whole.bricks.size());
        uint64_t used = bytesOf(whole.groups.size(), 0, 0, 0).total();
        size_t count = 0;
        for (; count < nearest_first.size() && used + bytes[nearest_first[count]] <= allowed; ++count)
        {
            used += bytes[nearest_first[count]];
            kept[nearest_first[count]] = true;
        }
        grid = faced(filtered(whole, kept), seen_points);
        grid.dropped = {whole.bricks.size() - count, whole.voxels.size() - grid.solid.voxels.size(),
                        distances[nearest_first[count]]};
        const uint64_t total = grid.bytes().total();
        if (total <= memory)
            return grid;
        // what stood behind dropped bricks has faces now
        allowed -= std::min(allowed, total - memory);
    }
}

} // namespace hearth::bricks
