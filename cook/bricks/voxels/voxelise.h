// From a scene's clusters to the solid voxels of a grid.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"
#include "cook/bricks/voxels/static_scene.h"

namespace hearth::bricks
{

struct VoxeliseCounts
{
    uint64_t clusters = 0;  ///< of the cut, each once for every instance
    uint64_t triangles = 0; ///< of them
    uint64_t pieces = 0;    ///< that they were cut to
};

struct Voxelised
{
    SolidGrid grid; ///< opacities still 0
    VoxeliseCounts counts;
    uint64_t tiles_skipped = 0; ///< that are so far away that their bricks would be dropped for certain
};

/// All voxels that a cut's triangles have an area in; in masked or blended materials, something that hides. Tile by tile:
/// a page is decoded where a tile needs it, so that memory follows the voxels, not the scene. The same bytes for any number
/// of threads: each tile sums in the order of `placed`.
///
/// Tiles are taken from the nearest focus on; once the bricks that are nearer than all tiles left need more than `memory` bytes
/// with no face at all, these are skipped: a size of voxels that is far too fine takes no more memory here than there.
///
/// placed  sorted
/// foci    world space, one at least
/// errors: those of decodePage and of reading textures; meaning_geometry
Result<Voxelised> voxelise(const StaticScene& scene, std::span<const PlacedCluster> placed,
                           const GridFrame& frame, std::span<const Float3> foci, uint64_t memory);

} // namespace hearth::bricks
