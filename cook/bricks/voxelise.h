// From a scene's clusters to the solid voxels of a grid.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/solid_grid.h"
#include "cook/bricks/static_scene.h"

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
};

/// All voxels that a cut's triangles have an area in; in masked or blended materials, something that hides. Tile by tile:
/// a page is decoded where a tile needs it, so that memory follows the voxels, not the scene. The same bytes for any number
/// of threads: each tile sums in the order of `placed`.
///
/// placed  sorted
/// errors: those of decodePage and of reading textures; meaning_geometry
Result<Voxelised> voxelise(const StaticScene& scene, std::span<const PlacedCluster> placed,
                           const GridFrame& frame);

} // namespace hearth::bricks
