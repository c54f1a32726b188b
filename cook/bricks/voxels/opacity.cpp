// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/opacity.h"

#include "cook/bricks/voxels/each_voxel.h"

#include <algorithm>

namespace hearth::bricks
{

namespace
{

uint64_t hiddenAt(const SolidGrid& grid, const Cell& cell, size_t axis)
{
    if (!isInside(grid.frame, cell))
        return 0;
    const uint32_t voxel = grid.voxelAt(cell);
    return voxel == kNowhere ? 0 : grid.voxels[voxel].hidden[axis];
}

uint8_t opacityOf(const SolidGrid& grid, const Cell& cell, const CrossSections& hidden)
{
    int most = 0;
    for (uint32_t axis = 0; axis < 3; ++axis)
    {
        most = std::max(most, std::popcount(hidden[axis]));
        if (hidesAll(hiddenAt(grid, across(cell, 2 * axis), axis), hidden[axis],
                     hiddenAt(grid, across(cell, 2 * axis + 1), axis)))
            return kOpaque;
    }
    return static_cast<uint8_t>(std::max(1, (most * 255 + 32) / 64));
}

} // namespace

void hideSheets(SolidGrid& grid)
{
    forEachVoxel(grid, [&](uint32_t voxel, const Cell& cell)
                 { grid.voxels[voxel].opacity = opacityOf(grid, cell, grid.voxels[voxel].hidden); });
}

} // namespace hearth::bricks
