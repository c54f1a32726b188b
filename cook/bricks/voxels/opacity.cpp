// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/opacity.h"

#include "cook/bricks/voxels/for_each_voxel.h"

#include <algorithm>

namespace hearth::bricks
{

namespace
{

uint64_t coverageAt(const SolidGrid& grid, const Cell& cell, size_t axis)
{
    if (!isInside(grid.frame, cell))
        return 0;
    const uint32_t voxel = grid.voxelAt(cell);
    return voxel == kInvalidIndex ? 0 : grid.voxels[voxel].coverage[axis];
}

uint8_t computeOpacity(const SolidGrid& grid, const Cell& cell, const CoverageMasks& coverage)
{
    int max_count = 0;
    for (uint32_t axis = 0; axis < 3; ++axis)
    {
        max_count = std::max(max_count, std::popcount(coverage[axis]));
        if (coversAll(coverageAt(grid, across(cell, 2 * axis), axis), coverage[axis],
                      coverageAt(grid, across(cell, 2 * axis + 1), axis)))
            return kOpaque;
    }
    return static_cast<uint8_t>(std::max(1, (max_count * 255 + 32) / 64));
}

} // namespace

void computeOpacities(SolidGrid& grid)
{
    forEachVoxel(grid, [&](uint32_t voxel, const Cell& cell)
                 { grid.voxels[voxel].opacity = computeOpacity(grid, cell, grid.voxels[voxel].coverage); });
}

} // namespace hearth::bricks
