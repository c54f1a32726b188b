// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/opacity.h"

#include <algorithm>
#include <tbb/parallel_for.h>

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
    const std::vector<Cell> cells = grid.brickCells();
    tbb::parallel_for(size_t{0}, grid.bricks.size(),
                      [&](size_t b)
                      {
                          uint32_t voxel = grid.bricks[b].first;
                          for (uint64_t rest = grid.bricks[b].mask; rest != 0; rest &= rest - 1, ++voxel)
                          {
                              const Cell cell =
                                  cellOf(cells[b], static_cast<uint32_t>(std::countr_zero(rest)));
                              grid.voxels[voxel].opacity = opacityOf(grid, cell, grid.voxels[voxel].hidden);
                          }
                      });
}

} // namespace hearth::bricks
