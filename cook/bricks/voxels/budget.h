// Keeps a grid within its memory: the bricks that matter least go first.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/visible_faces.h"

namespace hearth::bricks
{

/// What did not fit.
struct Dropped
{
    uint64_t bricks = 0;
    uint64_t voxels = 0;
    uint64_t tiles = 0; ///< of 32 x 32 x 32 voxels, that were not even looked at, and count nowhere else
    double from_distance = 0; ///< metres from the nearest focus: everything farther away was dropped

    bool any() const { return bricks + tiles > 0; }
};

/// A grid whose faces are known.
struct FacedGrid
{
    SolidGrid solid;
    std::vector<uint8_t> faces;
    SeenSpaces seen;
    Dropped dropped;

    BrickBytes bytes() const;
};

/// Find spaces and faces of a grid whose opacities hideSheets has set; where its tables would take more than `memory`
/// bytes, drop the bricks that are farthest from all foci. What is left keeps its faces, and gets none where it now ends: to
/// what looks from there it is dark, and the insides of walls stay closed.
///
/// memory       at least what the groups take
/// seen_points  places that are seen, world space
/// foci         what matters, world space, one at least
FacedGrid withinBudget(SolidGrid solid, std::span<const Float3> seen_points, std::span<const Float3> foci,
                       uint64_t memory);

} // namespace hearth::bricks
