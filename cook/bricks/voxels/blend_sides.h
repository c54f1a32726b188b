// Blends the material of a voxel's sides with the material of the voxel behind them.
//
// Rays weigh the light of a face by the opacity of its voxel. A lamp of 0.2 m in an opaque voxel of 0.5 m
// must not shine as if it filled the voxel. The light of a face is therefore the light of its own surfaces
// where they cover the side, and the light of the next voxel's surfaces elsewhere, because rays end in an
// opaque voxel and do not reach the next one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

namespace hearth::bricks
{

/// Blend albedo and emission of all sides that show a front face. Opacities must be set. Emission is scaled
/// such that opacity times light, as rays find it along an axis, equals the emission of that axis' coverage
/// samples. Albedo is the mean of the visible surfaces: a room with one albedo has it on all faces, and no
/// light is lost at edges.
void blendSides(SolidGrid& grid);

} // namespace hearth::bricks
