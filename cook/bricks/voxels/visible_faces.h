// Selects the sides of solid voxels that are faces, and builds the grid's tables.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_tables.h"
#include "cook/bricks/voxels/empty_spaces.h"

namespace hearth::bricks
{

/// Find the visible faces: for each solid voxel a mask with one bit per side. A side is a face if the cell
/// across it is an empty voxel of a visible space, or a voxel that is not opaque and belongs to a visible
/// space.
///
/// space_of_voxel  result of separateSpaces
std::vector<uint8_t> visibleFaces(const SolidGrid& grid, const EmptySpaces& spaces, const VisibleSpaces& seen,
                                  std::span<const uint32_t> space_of_voxel);

/// Build the tables. No face emits light yet, nor is it lit: traceEmission.
/// faces  result of visibleFaces
BrickTables makeBrickTables(const SolidGrid& grid, std::span<const uint8_t> faces);

} // namespace hearth::bricks
