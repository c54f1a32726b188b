// Bakes the initial lighting of brick faces: outgoing radiance under the scene's own lights, by ray tracing
// the triangles.
//
// Marched rays know only voxels. These rays meet the triangles of the LOD cut that the grid was made from, so
// light through narrow gaps and on thin objects is correct. The radiance at a hit is the outgoing radiance of
// the face of its voxel: each sweep over all faces adds one bounce and needs no texture. Frames on the GPU
// start from this lighting and converge to their own solution.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/grid_part.h"

namespace hearth::bricks
{

struct BakeSettings
{
    /// indirect bounces of light from lamps, sky and emissive surfaces; 0: direct light only
    uint32_t bounces = 4;
    uint32_t rays = 64; ///< per face, at least 1
};

/// Set the grid's lighting. Surfaces with holes are represented by the opacity of their voxels. The result
/// does not depend on the number of threads.
/// grid  made from the scene
/// errors: errors of decoding pages
Status bakeLight(const StaticScene& scene, const BakeSettings& settings, CookedGrid& grid);

} // namespace hearth::bricks
