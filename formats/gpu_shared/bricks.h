// Sparse bricks of voxels that stand for a scene's light: their records as files and buffers hold them, and the codes of a
// face. Written once for C++ and GLSL. FORMAT.md, "Bricks", has the meaning; README.md of cook/bricks how they are made.
//
// A group is 4 x 4 x 4 bricks, a brick 4 x 4 x 4 voxels. In both, cell (x, y, z) is bit x + 4 y + 16 z of a 64-bit mask,
// whose lower half is the first word, and children lie in the order of their bits: child of a bit = first child + number of
// lower bits that are set. So nothing is stored for what is empty, and no table of offsets is needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICKS_H
#define HEARTH_SHARED_BRICKS_H

#include "formats/gpu_shared/language.h"

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

/// Where the voxels are, and how many.
struct BrickGrid
{
    Float3 origin;    ///< least corner of voxel (0, 0, 0), world space, metres
    float voxel_size; ///< metres
    uint voxels_x;
    uint voxels_y;
    uint voxels_z;
    uint reserved;
};

/// Surfaces so near to a plane between voxels, in voxels, lie in it: in the voxels behind it.
HEARTH_CONSTANT float kBrickPlaneReach = 0.015625f;

/// Groups along an axis of so many voxels.
HEARTH_FUNCTION uint brickGroups(uint voxels)
{
    return (voxels + (kGroupVoxels - 1u)) / kGroupVoxels;
}

/// Bit of cell (x, y, z) of a group or brick: of a brick's place in voxels / 4, of a voxel's. Only their last two bits count.
HEARTH_FUNCTION uint brickBit(uint x, uint y, uint z)
{
    return (x & 3u) | (y & 3u) << 2 | (z & 3u) << 4;
}

HEARTH_FUNCTION bool maskHas(uint low, uint high, uint bit)
{
    return (((bit < 32u ? low : high) >> (bit & 31u)) & 1u) != 0u;
}

HEARTH_FUNCTION uint maskCount(uint low, uint high)
{
    return uint(bitCount(low)) + uint(bitCount(high));
}

/// How many bits below `bit` are set.
HEARTH_FUNCTION uint maskCountBelow(uint low, uint high, uint bit)
{
    uint below = (1u << (bit & 31u)) - 1u;
    return bit < 32u ? uint(bitCount(low & below)) : uint(bitCount(low)) + uint(bitCount(high & below));
}

/// Index into the opacities of the solid voxel at a bit.
HEARTH_FUNCTION uint brickVoxel(HEARTH_IN(Brick) brick, uint bit)
{
    return brick.first_voxel + maskCountBelow(brick.voxel_mask_low, brick.voxel_mask_high, bit);
}

/// Index into the tables of faces of face `face` (of kVoxelFaces) of the voxel at a bit, or kNoFace.
HEARTH_FUNCTION uint brickFace(HEARTH_IN(Brick) brick, uint bit, uint face)
{
    if (face >= kVoxelFaces || !maskHas(brick.face_masks[2u * face], brick.face_masks[2u * face + 1u], bit))
        return kNoFace;
    uint index =
        brick.first_face + maskCountBelow(brick.face_masks[2u * face], brick.face_masks[2u * face + 1u], bit);
    for (uint before = 0u; before < face; ++before)
        index += maskCount(brick.face_masks[2u * before], brick.face_masks[2u * before + 1u]);
    return index;
}

HEARTH_SHARED_END

#endif
