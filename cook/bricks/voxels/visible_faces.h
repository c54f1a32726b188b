// Which sides of solid voxels are faces, and the grid's tables by them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_tables.h"
#include "cook/bricks/voxels/open_space.h"

namespace hearth::bricks
{

/// For each solid voxel a bit for each face that it has: those across which an empty voxel of a seen space lies, or one
/// that is not opaque and that light from a seen space reaches.
///
/// space_of_voxel  of separateSpaces
std::vector<uint8_t> visibleFaces(const SolidGrid& grid, const OpenSpace& spaces, const SeenSpaces& seen,
                                  std::span<const uint32_t> space_of_voxel);

/// The tables, faces lit by what they give off themselves.
/// faces  of visibleFaces
BrickTables tablesOf(const SolidGrid& grid, std::span<const uint8_t> faces);

} // namespace hearth::bricks
