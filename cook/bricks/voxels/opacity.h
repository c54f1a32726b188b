// Computes the opacity of each solid voxel from its coverage masks.
//
// A closed surface must block all light, although a slanted one only cuts a corner off some voxels; grass
// must not. Therefore a voxel is opaque if it and its two neighbours along an axis have full coverage
// together: a sheet passes through the three. A plane crosses at most three voxels of a column along the axis
// that it faces most, and no path from one side to the other avoids the middle voxels (proof in the test).
// Otherwise the opacity of a voxel is its own largest coverage over the three axes.
//
// Gaps remain at sharp edges. separateSpaces (open_space.h) closes them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

namespace hearth::bricks
{

inline constexpr uint8_t kOpaque = 255;

/// Set all opacities, to at least 1.
void computeOpacities(SolidGrid& grid);

} // namespace hearth::bricks
