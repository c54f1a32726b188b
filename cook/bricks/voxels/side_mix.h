// What a side of a voxel shows as a whole, where the surfaces in it are not all that is seen there.
//
// Rays know a voxel's opacity and take the light of its face as often as that says. A lamp two hands wide in a voxel of half a
// metre must not shine as if it filled it: the face's light is that of its surfaces where they are, and of what lies behind
// them in the next voxel elsewhere, for where the voxel is opaque that is not met any more.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

namespace hearth::bricks
{

/// Mix albedo and emission of all sides that a front is seen through. Opacities must be set. Emission is then such that what
/// rays find along an axis, opacity times light, is what the samples of that axis give off. Albedo is the mean of the surfaces
/// that are seen: a room of one albedo has it on all its faces, and no light is lost beside their rims.
void mixSides(SolidGrid& grid);

} // namespace hearth::bricks
