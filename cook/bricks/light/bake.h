// The start value of the faces' light: what they send out with the scene's own lights, by rays against the real triangles.
//
// Marched rays know voxels only; these meet the triangles of the cut that the grid was made from, and light from narrow gaps
// and thin things is right. What a ray meets sends out what the face of its voxel there does, so that each sweep over all
// faces adds a bounce and no texture is looked at again. A frame on the GPU starts from this and comes to its own answer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/grid_part.h"

namespace hearth::bricks
{

struct BakeSettings
{
    uint32_t bounces =
        4;              ///< of light that lights, the sky and what shines send; 0: what is lit by them alone
    uint32_t rays = 64; ///< of each face, at least 1
};

/// Set the grid's lighting. Of surfaces with holes rays know the opacity of their voxels. The same for any number of threads.
/// grid  made from the scene
/// errors: those of decoding pages
Status bakeLight(const StaticScene& scene, const BakeSettings& settings, CookedGrid& grid);

} // namespace hearth::bricks
