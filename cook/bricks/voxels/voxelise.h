// Voxelises the clusters of a scene: computes the solid voxels of a grid.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"
#include "cook/bricks/voxels/static_scene.h"

namespace hearth::bricks
{

struct VoxeliseStatistics
{
    uint64_t clusters = 0;  ///< of the cut, counted once for each instance
    uint64_t triangles = 0; ///< in these clusters
    uint64_t pieces = 0;    ///< polygons that the triangles were clipped to
};

struct VoxeliseResult
{
    SolidGrid grid; ///< opacities are still 0
    VoxeliseStatistics counts;
    uint64_t tiles_skipped = 0; ///< tiles so far away that their bricks would certainly be dropped
};

/// Find all voxels in which a triangle of the cut has an area, for masked or blended materials with an
/// opacity above 0. Works tile by tile and decodes a page when a tile needs it, so memory grows with the
/// voxels, not with the scene. The bytes do not depend on the number of threads: each tile sums in the order
/// of `placed`.
///
/// Processes tiles from the nearest focus point on. Stops and skips the remaining tiles once the bricks
/// nearer than all of them need more than `memory` bytes even without faces. So a far too small voxel size
/// does not exhaust memory.
///
/// placed  sorted
/// foci    focus points, world space, at least one
/// errors: errors of decodePage and of reading textures; meaning_geometry
Result<VoxeliseResult> voxelise(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                const GridFrame& frame, std::span<const Float3> foci, uint64_t memory);

} // namespace hearth::bricks
