// Solid voxels of a grid with the material of all six sides, before visible faces are known.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"
#include "cook/bricks/voxels/coverage.h"
#include "formats/base/index.h"
#include "formats/gpu_shared/bricks.h"

#include <bit>
#include <vector>

namespace hearth::bricks
{

inline constexpr uint32_t kFaces = shared::kVoxelFaces;

/// Return the axis of a face.
constexpr int faceAxis(uint32_t face)
{
    return static_cast<int>(face / 2);
}
/// True if the face's normal points in the positive direction of its axis.
constexpr bool isPositiveFace(uint32_t face)
{
    return face % 2 != 0;
}

/// Material codes (formats/gpu_shared/brick_codes.h) for each of the six sides, as if all were faces.
struct SolidVoxel
{
    std::array<uint32_t, kFaces> albedo;
    std::array<uint16_t, kFaces> normal;
    uint8_t front_visible; ///< bit f: a front face of a surface is visible through side f
    uint8_t opacity;       ///< > 0; set by computeOpacities, then by separateSpaces
    CoverageMasks coverage;
};

/// Block of 4 x 4 x 4 cells, one bit each, and the index of its first set cell. Bit order as in
/// formats/records/bricks.h.
struct MaskedCells
{
    uint64_t mask = 0;
    uint32_t first = 0;

    bool has(uint32_t bit) const { return (mask >> bit & 1) != 0; }
    uint32_t at(uint32_t bit) const
    {
        return first + static_cast<uint32_t>(std::popcount(mask & ((uint64_t{1} << bit) - 1)));
    }
};

/// Return the bit of a voxel in its brick, or with shift 2 the bit of a brick in its group.
constexpr uint32_t cellBit(const Cell& cell, uint32_t shift = 0)
{
    return (cell[0] >> shift & 3u) | (cell[1] >> shift & 3u) << 2 | (cell[2] >> shift & 3u) << 4;
}

struct SolidGrid
{
    GridFrame frame;
    std::vector<MaskedCells> groups; ///< all groups of the grid, x fastest
    std::vector<MaskedCells> bricks;
    std::vector<SolidVoxel> voxels;

    uint32_t groupIndex(const Cell& cell) const
    {
        const Cell count = frame.groups();
        return (cell[0] >> 4) + count[0] * ((cell[1] >> 4) + count[1] * (cell[2] >> 4));
    }
    /// Return the index of a cell's brick, kInvalidIndex where it is empty.
    uint32_t brickAt(const Cell& cell) const
    {
        const MaskedCells& group = groups[groupIndex(cell)];
        const uint32_t bit = cellBit(cell, 2);
        return group.has(bit) ? group.at(bit) : kInvalidIndex;
    }
    /// Return the index of a solid voxel, kInvalidIndex for an empty one. The cell must lie in the grid.
    uint32_t voxelAt(const Cell& cell) const
    {
        const uint32_t brick = brickAt(cell);
        if (brick == kInvalidIndex || !bricks[brick].has(cellBit(cell)))
            return kInvalidIndex;
        return bricks[brick].at(cellBit(cell));
    }

    /// Call visit(brick, lowest cell of the brick) for all bricks in their order.
    template <typename Visit>
    void forEachBrick(const Visit& visit) const
    {
        const Cell count = frame.groups();
        for (uint32_t g = 0; g < groups.size(); ++g)
        {
            const Cell group{g % count[0] * 16, g / count[0] % count[1] * 16, g / count[0] / count[1] * 16};
            uint32_t brick = groups[g].first;
            for (uint64_t rest = groups[g].mask; rest != 0; rest &= rest - 1, ++brick)
            {
                const auto bit = static_cast<uint32_t>(std::countr_zero(rest));
                visit(brick, Cell{group[0] + (bit & 3) * 4, group[1] + (bit >> 2 & 3) * 4,
                                  group[2] + (bit >> 4) * 4});
            }
        }
    }

    /// Return the lowest cell of each brick.
    std::vector<Cell> brickCells() const
    {
        std::vector<Cell> cells(bricks.size());
        forEachBrick([&](uint32_t brick, const Cell& cell) { cells[brick] = cell; });
        return cells;
    }
};

/// Return the cell of a bit in a brick.
/// brick  lowest cell of the brick
constexpr Cell cellFromBit(const Cell& brick, uint32_t bit)
{
    return {brick[0] + (bit & 3), brick[1] + (bit >> 2 & 3), brick[2] + (bit >> 4)};
}

/// Return the cell across a face. It may lie outside the grid: a coordinate is then at least the grid's size,
/// because values below 0 wrap.
constexpr Cell across(Cell cell, uint32_t face)
{
    cell[face / 2] += isPositiveFace(face) ? 1u : ~0u;
    return cell;
}

inline bool isInside(const GridFrame& frame, const Cell& cell)
{
    return cell[0] < frame.voxels[0] && cell[1] < frame.voxels[1] && cell[2] < frame.voxels[2];
}

} // namespace hearth::bricks
