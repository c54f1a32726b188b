// Sparse bricks of voxels for global illumination: the records of files and buffers, and their bit masks. One
// source for C++ and GLSL. FORMAT.md, "Bricks", has the meaning; cook/bricks/README.md describes how they are
// cooked.
//
// A group is 4 x 4 x 4 bricks, a brick 4 x 4 x 4 voxels. In both, cell (x, y, z) is bit x + 4 y + 16 z of a
// 64-bit mask with the lower half in the first word. Children are stored in the order of their bits: child of
// a bit = first child + number of set lower bits. So empty cells take no space, and no offset table is
// needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICKS_H
#define HEARTH_SHARED_BRICKS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

HEARTH_CONSTANT uint kBrickVoxels = 4;      ///< along an edge of a brick
HEARTH_CONSTANT uint kGroupBricks = 4;      ///< along an edge of a group
HEARTH_CONSTANT uint kGroupVoxels = 16;     ///< along an edge of a group
HEARTH_CONSTANT uint kNoFace = 0xFFFFFFFFu; ///< no face there
/// Faces in the order x- x+ y- y+ z- z+: face f looks along axis f / 2, upwards where f is odd.
HEARTH_CONSTANT uint kVoxelFaces = 6;

/// Group of 16 x 16 x 16 voxels, solid or empty.
struct BrickGroup
{
    uint brick_mask_low;
    uint brick_mask_high;
    uint first_brick;
};

/// Brick of 4 x 4 x 4 voxels, at least one of them solid.
struct Brick
{
    uint voxel_mask_low;
    uint voxel_mask_high;
    uint face_masks[12]; ///< two words for each face of kVoxelFaces: mask of the voxels that have that face
    /// Index of its first solid voxel's opacity; solid voxels follow in the order of their bits
    uint first_voxel;
    /// Index of its first face: the faces x- in the order of their bits, then the faces x+, ...
    uint first_face;
};

/// Position and size of the voxel grid.
struct BrickGrid
{
    Float3 origin;    ///< lower corner of voxel (0, 0, 0), world space, metres
    float voxel_size; ///< metres
    uint voxels_x;
    uint voxels_y;
    uint voxels_z;
    uint reserved;
};

/// Distance in voxels within which a surface near a plane between voxels counts as in the plane: it belongs
/// to the voxels behind it.
HEARTH_CONSTANT float kBrickPlaneTolerance = 0.015625f;

/// Return the number of groups along an axis of this many voxels.
HEARTH_FUNCTION uint brickGroupsAlongAxis(uint voxels)
{
    return (voxels + (kGroupVoxels - 1u)) / kGroupVoxels;
}

/// Return the bit of cell (x, y, z) in a group (coordinates in bricks) or in a brick (coordinates in voxels).
/// Uses only the last two bits of each coordinate.
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

/// Return the number of set bits below `bit`.
HEARTH_FUNCTION uint maskCountBelow(uint low, uint high, uint bit)
{
    uint below = (1u << (bit & 31u)) - 1u;
    return bit < 32u ? uint(bitCount(low & below)) : uint(bitCount(low)) + uint(bitCount(high & below));
}

/// Return the index into the opacities of the solid voxel at a bit.
HEARTH_FUNCTION uint brickVoxel(HEARTH_IN(Brick) brick, uint bit)
{
    return brick.first_voxel + maskCountBelow(brick.voxel_mask_low, brick.voxel_mask_high, bit);
}

/// Return the index into the face tables of face `face` (of kVoxelFaces) of the voxel at a bit, or kNoFace.
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
