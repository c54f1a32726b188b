// How much light each solid voxel stops.
//
// A closed surface must stop all, though a slanted one fills no voxel that it merely cuts a corner of; grass must not. So:
// where a voxel and its two neighbours along an axis hide the whole cross-section together, a sheet goes through the three,
// and each of them is opaque. A plane that leans most towards that axis crosses three voxels of a column at most, and no way
// from its one side to the other leads past the middle ones (the test has the reason). Else a voxel stops what it hides itself,
// along the axis on which that is most.
//
// That alone leaves gaps at sharp edges. What closes them for sure is separateSpaces (open_space.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

namespace hearth::bricks
{

inline constexpr uint8_t kOpaque = 255;

/// Set all opacities, to 1 at least.
void hideSheets(SolidGrid& grid);

} // namespace hearth::bricks
