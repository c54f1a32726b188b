// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/blend_sides.h"

#include "cook/bricks/voxels/for_each_voxel.h"
#include "cook/bricks/voxels/opacity.h"
#include "formats/gpu_shared/brick_codes.h"

#include <bit>

namespace hearth::bricks
{

namespace
{

const SolidVoxel* voxelAt(const SolidGrid& grid, const Cell& cell)
{
    const uint32_t voxel = isInside(grid.frame, cell) ? grid.voxelAt(cell) : kInvalidIndex;
    return voxel == kInvalidIndex ? nullptr : &grid.voxels[voxel];
}

uint64_t coverageAlong(const SolidVoxel* voxel, size_t axis)
{
    return voxel == nullptr ? 0 : voxel->coverage[axis];
}

bool showsFront(const SolidVoxel* voxel, uint32_t face)
{
    return voxel != nullptr && (voxel->front_visible >> face & 1) != 0;
}

/// Return the part of an opaque side that shows the surfaces of the voxel behind it, of all that it shows.
float computeShareBehind(const SolidGrid& grid, const Cell& cell, const SolidVoxel& voxel, uint32_t face)
{
    const size_t axis = face / 2;
    const SolidVoxel* const next = voxelAt(grid, across(cell, face ^ 1));
    if (!showsFront(next, face))
        return 0;
    const int own = std::popcount(voxel.coverage[axis]);
    const int behind = std::popcount(coverageAlong(next, axis) & ~voxel.coverage[axis]);
    return behind == 0 ? 0 : static_cast<float>(behind) / static_cast<float>(own + behind);
}

SolidVoxel blendVoxel(const SolidGrid& grid, const Cell& cell, const SolidVoxel& voxel)
{
    SolidVoxel result = voxel;
    if (voxel.opacity < kOpaque)
        return result;
    for (uint32_t face = 0; face < kFaces; ++face)
    {
        const float share = showsFront(&voxel, face) ? computeShareBehind(grid, cell, voxel, face) : 0;
        if (share == 0)
            continue;
        const SolidVoxel& next = *voxelAt(grid, across(cell, face ^ 1));
        const Float3 albedo = shared::decodeAlbedo(voxel.albedo[face]) * (1 - share) +
                              shared::decodeAlbedo(next.albedo[face]) * share;
        const float depth = shared::decodeFaceDepth(voxel.albedo[face]);
        result.albedo[face] = shared::encodeAlbedo(albedo) | shared::encodeFaceDepth(depth);
    }
    return result;
}

} // namespace

void blendSides(SolidGrid& grid)
{
    std::vector<SolidVoxel> voxels(grid.voxels.size());
    forEachVoxel(grid, [&](uint32_t voxel, const Cell& cell)
                 { voxels[voxel] = blendVoxel(grid, cell, grid.voxels[voxel]); });
    grid.voxels = std::move(voxels);
}

} // namespace hearth::bricks
