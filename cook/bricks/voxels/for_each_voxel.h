// Visits all solid voxels of a grid in parallel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

#include <tbb/parallel_for.h>

namespace hearth::bricks
{

/// Call visit(index of the voxel, its cell) for each solid voxel, in parallel.
template <typename Visit>
void forEachVoxel(const SolidGrid& grid, const Visit& visit)
{
    const std::vector<Cell> cells = grid.brickCells();
    tbb::parallel_for(size_t{0}, grid.bricks.size(),
                      [&](size_t b)
                      {
                          uint32_t voxel = grid.bricks[b].first;
                          for (uint64_t rest = grid.bricks[b].mask; rest != 0; rest &= rest - 1, ++voxel)
                              visit(voxel,
                                    cellFromBit(cells[b], static_cast<uint32_t>(std::countr_zero(rest))));
                      });
}

} // namespace hearth::bricks
