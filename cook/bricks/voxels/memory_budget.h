// Keeps a grid within its memory budget by dropping the bricks farthest from all focus points.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/visible_faces.h"

namespace hearth::bricks
{

/// Bricks that did not fit the memory budget.
struct DroppedBricks
{
    uint64_t bricks = 0;
    uint64_t voxels = 0;
    /// of 32 x 32 x 32 voxels; skipped before voxelisation, so not counted in bricks or voxels
    uint64_t tiles = 0;
    double from_distance = 0; ///< metres from the nearest focus point: everything farther away was dropped

    bool any() const { return bricks + tiles > 0; }
};

/// Grid with its visible faces.
struct GridWithFaces
{
    SolidGrid solid;
    /// Mask for each solid voxel; bit f: side f is a face.
    std::vector<uint8_t> faces;
    VisibleSpaces seen;
    DroppedBricks dropped;

    BrickBytes bytes() const;
};

/// Find the spaces and faces of a grid whose opacities computeOpacities has set. Drop the bricks farthest
/// from all focus points if the tables need more than `memory` bytes. The remaining bricks keep their faces
/// and get no new ones where the grid now ends: these sides stay dark, and the interiors of walls stay
/// closed.
///
/// memory       bytes, at least what the groups take
/// seen_points  visible positions (cameras and seeds), world space
/// foci         focus points, world space, at least one
GridWithFaces fitToMemory(SolidGrid solid, std::span<const Float3> seen_points, std::span<const Float3> foci,
                          uint64_t memory);

} // namespace hearth::bricks
