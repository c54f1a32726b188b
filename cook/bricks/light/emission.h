// Computes the emission of faces, such that bricks send out the light that the emissive triangles send out.
//
// A voxel's sides are larger than a round or slanted surface in it: a ball of one radiance sends out 1.5
// times its light if each side has that radiance. And much of the light of a strip that hangs a centimetre
// off its wall leaves its voxel by way of the wall. So emission_paths.h follows the light to the voxel by
// which it comes into the air, and emission_fit.h splits it among the faces of that voxel by its directions.
// The radiance of a face is that of its light, over what of it gets past the source's own voxels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_view.h"
#include "cook/bricks/voxels/grid_part.h"

#include <vector>

namespace hearth::bricks
{

/// Flux of light in a grid, in units of radiance times voxel side areas times pi.
struct EmittedFlux
{
    Double3 sent;     ///< by emissive triangles
    Double3 credited; ///< to faces; the rest is absorbed before it reaches the air, or sealed off
};

/// Set the emission of all faces, and their initial light, which is the emission. Without an emissive
/// material the grid does not change. The result does not depend on the number of threads.
/// errors: errors of decoding pages
Result<EmittedFlux> traceEmission(const StaticScene& scene, CookedGrid& grid);

/// Part of a face's emission that an instance causes.
struct EmissionShare
{
    uint32_t face;
    uint32_t instance; ///< of the static scene
    Float3 share; ///< by channel; those of a face's instances sum to 1, or 0 where none sends the channel
};

/// Find which instances the emission of faces is from, by the paths of traceEmission. Sorted by face, then
/// instance; empty without an emissive material. The result does not depend on the number of threads.
/// bricks  grid that was cooked from the scene, with clusters of the default error: voxels of other clusters
///         have no shares
/// errors: errors of decoding pages
Result<std::vector<EmissionShare>> findEmissionShares(const StaticScene& scene, const BrickView& bricks);

} // namespace hearth::bricks
