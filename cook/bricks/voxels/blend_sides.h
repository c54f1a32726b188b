// Blends the albedo of a voxel's sides with that of the voxel behind them.
//
// Rays end in an opaque voxel. Where its own surfaces cover only a part of a side, the light that comes back
// is that of the next voxel's surfaces, which rays do not reach.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

namespace hearth::bricks
{

/// Blend the albedo of all opaque sides that show a front face. Opacities must be set. A room with one albedo
/// has it on all faces, and no light is lost at edges.
void blendSides(SolidGrid& grid);

} // namespace hearth::bricks
