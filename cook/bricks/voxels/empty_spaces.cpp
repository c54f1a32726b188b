// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/empty_spaces.h"

#include "cook/bricks/voxels/opacity.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>

namespace hearth::bricks
{

namespace
{

// Mask of the cells whose coordinate along an axis is 0.
constexpr std::array<uint64_t, 3> kLowSide{0x1111111111111111u, 0x000F000F000F000Fu, 0x000000000000FFFFu};
// Bits from a cell to the next one along an axis.
constexpr std::array<uint32_t, 3> kStep{1, 4, 16};

constexpr uint64_t highSide(uint32_t axis)
{
    return kLowSide[axis] << 3 * kStep[axis];
}

/// Flood fill: return the cells of `open` that are reachable from `start`.
uint64_t floodFill(uint64_t start, uint64_t open)
{
    for (uint64_t reached = start;;)
    {
        uint64_t next = reached;
        for (uint32_t axis = 0; axis < 3; ++axis)
            next |= (reached & ~highSide(axis)) << kStep[axis] | (reached & ~kLowSide[axis]) >> kStep[axis];
        next &= open;
        if (next == reached)
            return reached;
        reached = next;
    }
}

} // namespace

EmptySpaces::EmptySpaces(const SolidGrid& grid)
{
    parts_.push_back(0); // the outside
    const auto add = [&](uint64_t open)
    {
        Parts parts{static_cast<uint32_t>(parts_.size()), 0};
        for (; open != 0; ++parts.count)
        {
            parts_.push_back(floodFill(open & (~open + 1), open));
            open &= ~parts_.back();
        }
        parts_of_brick_.push_back(parts);
    };
    for (const MaskedCells& group : grid.groups)
    {
        bricks_of_group_.push_back(group.mask == 0 ? kInvalidIndex
                                                   : static_cast<uint32_t>(parts_of_brick_.size()));
        group_parts_.push_back(static_cast<uint32_t>(parts_of_brick_.size()));
        if (group.mask == 0)
            add(~uint64_t{0});
        else
            for (uint32_t bit = 0; bit < 64; ++bit)
                add(group.has(bit) ? ~grid.bricks[group.at(bit)].mask : ~uint64_t{0});
    }
    parents_.resize(parts_.size());
    for (uint32_t node = 0; node < parents_.size(); ++node)
        parents_[node] = node;

    const Cell count = grid.frame.groups();
    for (uint32_t z = 0; z < count[2]; ++z)
        for (uint32_t y = 0; y < count[1]; ++y)
            for (uint32_t x = 0; x < count[0]; ++x)
            {
                joinInside(grid, {x, y, z});
                for (uint32_t axis = 0; axis < 3; ++axis)
                    joinGroups(grid, {x, y, z}, axis);
            }
    joinOutside(grid);
    number();
}

uint32_t EmptySpaces::at(const SolidGrid& grid, const Cell& cell) const
{
    if (!isInside(grid.frame, cell))
        return kOutside;
    const Parts& parts = partsAt(grid.groupIndex(cell), cellBit(cell, 2));
    const uint64_t bit = uint64_t{1} << cellBit(cell);
    for (uint32_t i = parts.first; i < parts.first + parts.count; ++i)
        if ((parts_[i] & bit) != 0)
            return parents_[i];
    HEARTH_ASSERT(false); // the cell is solid
    return kInvalidIndex;
}

/// Join the bricks within a group.
void EmptySpaces::joinInside(const SolidGrid& grid, const Cell& group)
{
    const Cell count = grid.frame.groups();
    const uint32_t first = bricks_of_group_[group[0] + count[0] * (group[1] + count[1] * group[2])];
    if (first == kInvalidIndex)
        return;
    for (uint32_t bit = 0; bit < 64; ++bit)
        for (uint32_t axis = 0; axis < 3; ++axis)
            if ((highSide(axis) >> bit & 1) == 0)
                joinBricks(first + bit, first + bit + kStep[axis], axis);
}

/// Join a group with the next one along an axis.
void EmptySpaces::joinGroups(const SolidGrid& grid, const Cell& group, uint32_t axis)
{
    const Cell count = grid.frame.groups();
    Cell next = group;
    if (++next[axis] == count[axis])
        return;
    const auto index = [&](const Cell& g) { return g[0] + count[0] * (g[1] + count[1] * g[2]); };
    const uint32_t from = index(group), to = index(next);
    if (bricks_of_group_[from] == kInvalidIndex && bricks_of_group_[to] == kInvalidIndex)
        return joinBricks(group_parts_[from], group_parts_[to], axis);
    for (uint32_t bit = 0; bit < 64; ++bit)
        if ((kLowSide[axis] >> bit & 1) != 0)
            joinBricks(
                bricks_of_group_[from] == kInvalidIndex ? group_parts_[from]
                                                        : bricks_of_group_[from] + bit + 3 * kStep[axis],
                bricks_of_group_[to] == kInvalidIndex ? group_parts_[to] : bricks_of_group_[to] + bit, axis);
}

/// Join two bricks, given by their indices in parts_of_brick_. The second follows the first along an axis.
void EmptySpaces::joinBricks(uint32_t first, uint32_t second, uint32_t axis)
{
    const Parts& a = parts_of_brick_[first];
    const Parts& b = parts_of_brick_[second];
    for (uint32_t i = a.first; i < a.first + a.count; ++i)
        for (uint32_t j = b.first; j < b.first + b.count; ++j)
            if (((parts_[i] & highSide(axis)) >> 3 * kStep[axis] & parts_[j]) != 0)
                join(i, j);
}

/// Join everything at the boundary of the grid's groups with the outside. The last voxels of the grid may lie
/// within it.
void EmptySpaces::joinOutside(const SolidGrid& grid)
{
    const Cell count = grid.frame.groups();
    const auto joinSide = [&](uint32_t group, uint64_t side)
    {
        const uint32_t bricks = bricks_of_group_[group];
        const auto joinParts = [&](const Parts& parts)
        {
            for (uint32_t i = parts.first; i < parts.first + parts.count; ++i)
                if ((parts_[i] & side) != 0)
                    join(0, i);
        };
        if (bricks == kInvalidIndex)
            return joinParts(parts_of_brick_[group_parts_[group]]);
        for (uint32_t bit = 0; bit < 64; ++bit)
            if ((side >> bit & 1) != 0)
                joinParts(parts_of_brick_[bricks + bit]);
    };
    for (uint32_t g = 0; g < bricks_of_group_.size(); ++g)
    {
        const Cell group{g % count[0], g / count[0] % count[1], g / count[0] / count[1]};
        for (uint32_t axis = 0; axis < 3; ++axis)
        {
            if (group[axis] == 0)
                joinSide(g, kLowSide[axis]);
            if (group[axis] + 1 == count[axis])
                joinSide(g, highSide(axis));
        }
    }
}

uint32_t EmptySpaces::root(uint32_t node)
{
    while (parents_[node] != node)
        node = parents_[node] = parents_[parents_[node]];
    return node;
}

/// Join two sets. The smaller root stays root, so the result does not depend on the order.
void EmptySpaces::join(uint32_t a, uint32_t b)
{
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
}

/// Replace roots by space numbers. A root precedes all nodes of its set.
void EmptySpaces::number()
{
    for (uint32_t node = 0; node < parents_.size(); ++node)
        parents_[node] = root(node);
    for (uint32_t node = 0; node < parents_.size(); ++node)
        parents_[node] = parents_[node] == node ? count_++ : parents_[parents_[node]];
}

VisibleSpaces findVisibleSpaces(const SolidGrid& grid, const EmptySpaces& spaces,
                                std::span<const Float3> points)
{
    struct Sides
    {
        uint64_t fronts = 0, backs = 0;
    };
    std::vector<Sides> sides(spaces.count());
    grid.forEachBrick(
        [&](uint32_t brick, const Cell& at)
        {
            uint32_t voxel = grid.bricks[brick].first;
            for (uint64_t rest = grid.bricks[brick].mask; rest != 0; rest &= rest - 1, ++voxel)
            {
                const Cell cell = cellFromBit(at, static_cast<uint32_t>(std::countr_zero(rest)));
                for (uint32_t face = 0; face < kFaces; ++face)
                {
                    const Cell next = across(cell, face);
                    if (isInside(grid.frame, next) && grid.voxelAt(next) != kInvalidIndex)
                        continue;
                    Sides& around = sides[spaces.at(grid, next)];
                    ++((grid.voxels[voxel].front_visible >> face & 1) != 0 ? around.fronts : around.backs);
                }
            }
        });
    VisibleSpaces result;
    result.seen.resize(spaces.count());
    for (uint32_t space = 0; space < spaces.count(); ++space)
        result.seen[space] = space == EmptySpaces::kOutside || sides[space].fronts >= sides[space].backs;
    for (const Float3& point : points)
    {
        const Float3 place = (point - grid.frame.origin) / grid.frame.voxel_size;
        const auto size = [&](size_t axis) { return static_cast<float>(grid.frame.voxels[axis]); };
        if (!(place.x >= 0 && place.y >= 0 && place.z >= 0 && place.x < size(0) && place.y < size(1) &&
              place.z < size(2)))
            continue;
        const Cell cell{static_cast<uint32_t>(place.x), static_cast<uint32_t>(place.y),
                        static_cast<uint32_t>(place.z)};
        if (grid.voxelAt(cell) == kInvalidIndex)
            result.seen[spaces.at(grid, cell)] = true;
    }
    for (uint32_t space = 0; space < spaces.count(); ++space)
        if (!result.seen[space])
        {
            ++result.sealed;
            result.sealed_sides += sides[space].fronts + sides[space].backs;
        }
    return result;
}

std::vector<uint32_t> separateSpaces(SolidGrid& grid, const EmptySpaces& spaces)
{
    std::vector<uint32_t> space_of_voxel(grid.voxels.size(), kInvalidIndex);
    struct Place
    {
        Cell cell;
        uint32_t voxel;
    };
    std::vector<Place> queue;
    /// Assign the voxel to the one space around it, or make it opaque if there are several.
    const auto settle = [&](const Place& place)
    {
        uint32_t space = kInvalidIndex;
        for (uint32_t face = 0; face < kFaces; ++face)
        {
            const Cell next = across(place.cell, face);
            const uint32_t neighbour = isInside(grid.frame, next) ? grid.voxelAt(next) : kInvalidIndex;
            const uint32_t found =
                neighbour == kInvalidIndex ? spaces.at(grid, next) : space_of_voxel[neighbour];
            if (found == kInvalidIndex || found == space)
                continue;
            if (space != kInvalidIndex)
            {
                grid.voxels[place.voxel].opacity = kOpaque;
                return;
            }
            space = found;
        }
        if (space == kInvalidIndex)
            return;
        space_of_voxel[place.voxel] = space;
        queue.push_back(place);
    };
    // process voxels in their order, then the queue: the result is deterministic
    grid.forEachBrick(
        [&](uint32_t brick, const Cell& at)
        {
            uint32_t voxel = grid.bricks[brick].first;
            for (uint64_t rest = grid.bricks[brick].mask; rest != 0; rest &= rest - 1, ++voxel)
                if (grid.voxels[voxel].opacity != kOpaque)
                    settle({cellFromBit(at, static_cast<uint32_t>(std::countr_zero(rest))), voxel});
        });
    for (size_t i = 0; i < queue.size(); ++i)
        for (uint32_t face = 0; face < kFaces; ++face)
        {
            const Cell next = across(queue[i].cell, face);
            const uint32_t voxel = isInside(grid.frame, next) ? grid.voxelAt(next) : kInvalidIndex;
            if (voxel != kInvalidIndex && grid.voxels[voxel].opacity != kOpaque &&
                space_of_voxel[voxel] == kInvalidIndex)
                settle({next, voxel});
        }
    return space_of_voxel;
}

} // namespace hearth::bricks
