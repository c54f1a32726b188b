// Sparse bricks of voxels that stand for a scene's light: their records as files and buffers hold them, and the codes of a
// face. Written once for C++ and GLSL. FORMAT.md, "Bricks", has the meaning; README.md of cook/bricks how they are made.
//
// A group is 4 x 4 x 4 bricks, a brick 4 x 4 x 4 voxels. In both, cell (x, y, z) is bit x + 4 y + 16 z of a 64-bit mask,
// whose lower half is the first word, and children lie in the order of their bits: child of a bit = first child + number of
// lower bits that are set. So nothing is stored for what is empty, and no table of offsets is needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICKS_H
#define HEARTH_SHARED_BRICKS_H

#include "formats/shared/language.h"

HEARTH_SHARED_BEGIN

HEARTH_CONSTANT uint kBrickVoxels = 4;      ///< along an edge of a brick
HEARTH_CONSTANT uint kGroupBricks = 4;      ///< along an edge of a group
HEARTH_CONSTANT uint kGroupVoxels = 16;     ///< along an edge of a group
HEARTH_CONSTANT uint kNoFace = 0xFFFFFFFFu; ///< a voxel without a face there
HEARTH_CONSTANT uint kVoxelFaces =
    6; ///< x- x+ y- y+ z- z+: face f looks along axis f / 2, upwards where f is odd

/// 16 x 16 x 16 voxels of the grid, solid or empty.
struct BrickGroup
{
    uint brick_mask_low;
    uint brick_mask_high;
    uint first_brick;
};

/// 4 x 4 x 4 voxels, one of which is solid at least.
struct Brick
{
    uint voxel_mask_low;
    uint voxel_mask_high;
    uint face_masks[12]; ///< for each face of kVoxelFaces two words: the voxels that have it
    uint first_voxel;    ///< of its solid voxels, in the order of their bits: index into the opacities
    uint first_face;     ///< of its faces: those of x- in the order of their bits, then those of x+, ...
};

HEARTH_SHARED_END

#endif
