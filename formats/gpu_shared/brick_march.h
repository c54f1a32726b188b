// Marches rays through a grid of bricks, voxel by voxel where there is something, brick by brick and group by group where
// there is nothing. Written once for C++ and GLSL, to the same bits. J. Amanatides, A. Woo, "A fast voxel traversal
// algorithm for ray tracing", 1987; README.md of cook/bricks has what was measured.
//
//     BrickRay ray = brickMarch(bricks, brickRay(grid, origin, direction, far));
//     while (ray.inside)             // in a solid voxel: ray.brick, ray.bit, entered by ray.face after brickDistance(...)
//         ray = brickMarch(bricks, brickPass(bricks, ray));
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICK_MARCH_H
#define HEARTH_SHARED_BRICK_MARCH_H

#include "formats/gpu_shared/bricks.h"

#ifdef __cplusplus
#include <span>
#endif

// A ray is a voxel and the place along the ray where it enters it. It moves on by leaving a cell of 1, 4 or 16 voxels across
// the nearest of the three planes that it heads for: that coordinate of the voxel becomes the plane's other side. The other
// two wait until something smaller is looked at; then they are found from the place along the ray and kept between where they
// were and the cell's far side. So each step moves one coordinate on, none ever moves back, and no two voxels with a common
// edge let a ray through between them: there are at most as many steps as voxels that the ray crosses, whatever the rounding.
//
// A ray along a face belongs to the voxel above it, in x, y or z; one that starts on a face and heads into the voxel enters
// it by that face, one that heads away does not meet it.

HEARTH_SHARED_BEGIN

#ifdef __cplusplus
/// What a march reads; both tables as the checker accepts them.
struct BrickMasks
{
    BrickGrid grid;
    std::span<const BrickGroup> groups;
    std::span<const Brick> bricks;
};
inline const BrickGrid& brickGridOf(const BrickMasks& masks)
{
    return masks.grid;
}
inline const BrickGroup& brickGroupAt(const BrickMasks& masks, uint group)
{
    return masks.groups[group];
}
inline const Brick& brickAt(const BrickMasks& masks, uint brick)
{
    return masks.bricks[brick];
}
#else
// A shader has one grid, and defines these two over its buffers, in front of this header or behind it.
#define BrickMasks BrickGrid
BrickGroup brickGroupAt(BrickGrid grid, uint group);
Brick brickAt(BrickGrid grid, uint brick);
BrickGrid brickGridOf(BrickGrid grid)
{
    return grid;
}
#endif

/// Slower than this along an axis is not moving along it: no voxel is left so within any distance that a float holds.
HEARTH_CONSTANT float kBrickParallel = 1e-30f;

/// Far enough for rays without an end.
HEARTH_CONSTANT float kBrickFar = 3e38f;

/// A ray and the voxel that it is in. Lengths in voxels, from the grid's origin.
struct BrickRay
{
    Float3 start;     ///< in the grid's box: its origin, or where it enters the box
    float start_t;    ///< how far that is from its origin
    Float3 direction; ///< of length 1, 0 along axes that it does not move along
    float end;        ///< how far it goes from `start`: to the end of the grid at most
    Float3 inverse;   ///< 1 / direction
    float t;          ///< where it enters the voxel, from `start`
    int x;            ///< the voxel
    int y;
    int z;
    uint face;  ///< of kVoxelFaces, by which it enters the voxel; kNoFace where it starts inside
    uint brick; ///< of the solid voxel that brickMarch found, and its bit there
    uint bit;
    uint inside; ///< 0: it left the grid, or ended
    uint steps;  ///< cells left so far
};

HEARTH_FUNCTION float brickInverse(float along)
{
    return along == 0.0f ? 1.0f / kBrickParallel : 1.0f / along;
}

/// The voxel of a place on an axis, from which the ray heads on: on a plane, that behind it.
HEARTH_FUNCTION int brickVoxelAt(float place, float inverse, uint voxels)
{
    int voxel = int(place);
    voxel = inverse < 0.0f && float(voxel) == place ? voxel - 1 : voxel;
    voxel = voxel < 0 ? 0 : voxel;
    return voxel < int(voxels) ? voxel : int(voxels) - 1;
}

/// Whether the ray enters its voxel across the plane of an axis; never of one that it does not move along, where no place
/// lies on the voxel's far side.
HEARTH_FUNCTION bool brickEnters(float place, float along, int voxel)
{
    return place == float(along > 0.0f ? voxel : voxel + 1);
}

/// A ray in voxels from the grid's origin.
///
/// origin     finite; where it lies outside the grid, the ray begins where it enters the box
/// direction  of length 1, within rounding: what is measured along the ray is so many times too short else
/// far        how far it goes, > 0; kBrickFar: to the end of the grid
/// returns    the ray in its first voxel, solid or not; `inside` is 0 where it misses the grid
HEARTH_FUNCTION BrickRay brickRayInVoxels(HEARTH_IN(BrickGrid) grid, Float3 origin, Float3 direction,
                                          float far)
{
    BrickRay ray;
    ray.direction = Float3(abs(direction.x) < kBrickParallel ? 0.0f : direction.x,
                           abs(direction.y) < kBrickParallel ? 0.0f : direction.y,
                           abs(direction.z) < kBrickParallel ? 0.0f : direction.z);
    ray.inverse =
        Float3(brickInverse(ray.direction.x), brickInverse(ray.direction.y), brickInverse(ray.direction.z));
    Float3 most = Float3(float(grid.voxels_x), float(grid.voxels_y), float(grid.voxels_z));
    bool up_x = ray.inverse.x > 0.0f;
    bool up_y = ray.inverse.y > 0.0f;
    bool up_z = ray.inverse.z > 0.0f;
    HEARTH_PRECISE float in_x = ((up_x ? 0.0f : most.x) - origin.x) * ray.inverse.x;
    HEARTH_PRECISE float in_y = ((up_y ? 0.0f : most.y) - origin.y) * ray.inverse.y;
    HEARTH_PRECISE float in_z = ((up_z ? 0.0f : most.z) - origin.z) * ray.inverse.z;
    float enter = max(max(in_x, in_y), max(in_z, 0.0f));
    float start_x = origin.x;
    float start_y = origin.y;
    float start_z = origin.z;
    if (enter > 0.0f)
    {
        HEARTH_PRECISE float at_x = origin.x + enter * ray.direction.x;
        HEARTH_PRECISE float at_y = origin.y + enter * ray.direction.y;
        HEARTH_PRECISE float at_z = origin.z + enter * ray.direction.z;
        // on the planes of the box that it enters through exactly
        start_x = in_x < enter ? at_x : up_x ? 0.0f : most.x;
        start_y = in_y < enter ? at_y : up_y ? 0.0f : most.y;
        start_z = in_z < enter ? at_z : up_z ? 0.0f : most.z;
    }
    start_x = min(max(start_x, 0.0f), most.x);
    start_y = min(max(start_y, 0.0f), most.y);
    start_z = min(max(start_z, 0.0f), most.z);
    ray.start = Float3(start_x, start_y, start_z);
    ray.start_t = enter;
    // by the same arithmetic as the planes of voxels: who is nearer than this has left the box nowhere. A ray that misses it
    // stands now on a plane that it leaves through
    HEARTH_PRECISE float end_x = ((up_x ? most.x : 0.0f) - start_x) * ray.inverse.x;
    HEARTH_PRECISE float end_y = ((up_y ? most.y : 0.0f) - start_y) * ray.inverse.y;
    HEARTH_PRECISE float end_z = ((up_z ? most.z : 0.0f) - start_z) * ray.inverse.z;
    HEARTH_PRECISE float rest = far - enter;
    ray.end = min(min(end_x, end_y), min(end_z, rest));
    ray.t = 0.0f;
    ray.inside = ray.end > 0.0f ? 1u : 0u;
    ray.x = brickVoxelAt(start_x, ray.inverse.x, grid.voxels_x);
    ray.y = brickVoxelAt(start_y, ray.inverse.y, grid.voxels_y);
    ray.z = brickVoxelAt(start_z, ray.inverse.z, grid.voxels_z);
    ray.face = kNoFace;
    // from outside, the box's plane alone: that another is met as well may be rounding
    if ((enter == 0.0f || in_z == enter) && brickEnters(start_z, ray.direction.z, ray.z))
        ray.face = up_z ? 4u : 5u;
    if ((enter == 0.0f || in_y == enter) && brickEnters(start_y, ray.direction.y, ray.y))
        ray.face = up_y ? 2u : 3u;
    if ((enter == 0.0f || in_x == enter) && brickEnters(start_x, ray.direction.x, ray.x))
        ray.face = up_x ? 0u : 1u;
    ray.brick = 0u;
    ray.bit = 0u;
    ray.steps = 0u;
    return ray;
}

/// The same for a ray in world space. far  metres
HEARTH_FUNCTION BrickRay brickRay(HEARTH_IN(BrickGrid) grid, Float3 origin, Float3 direction, float far)
{
    HEARTH_PRECISE float x = (origin.x - grid.origin.x) / grid.voxel_size;
    HEARTH_PRECISE float y = (origin.y - grid.origin.y) / grid.voxel_size;
    HEARTH_PRECISE float z = (origin.z - grid.origin.z) / grid.voxel_size;
    HEARTH_PRECISE float far_voxels = far / grid.voxel_size;
    return brickRayInVoxels(grid, Float3(x, y, z), direction, far_voxels);
}

/// Metres from the ray's origin to where it enters its voxel.
HEARTH_FUNCTION float brickDistance(HEARTH_IN(BrickGrid) grid, HEARTH_IN(BrickRay) ray)
{
    HEARTH_PRECISE float t = (ray.start_t + ray.t) * grid.voxel_size;
    return t;
}

/// Leave the cell of `edge` voxels each way (1, 4 or 16) that the voxel lies in. Only the coordinate that is crossed is set;
/// the others stay where they were in the cell: brickCatchUp moves them.
HEARTH_FUNCTION BrickRay brickLeave(BrickRay ray, int edge)
{
    int up_x = ray.inverse.x > 0.0f ? -1 : 0;
    int up_y = ray.inverse.y > 0.0f ? -1 : 0;
    int up_z = ray.inverse.z > 0.0f ? -1 : 0;
    int plane_x = (ray.x & -edge) + (edge & up_x);
    int plane_y = (ray.y & -edge) + (edge & up_y);
    int plane_z = (ray.z & -edge) + (edge & up_z);
    HEARTH_PRECISE float t_x = (float(plane_x) - ray.start.x) * ray.inverse.x;
    HEARTH_PRECISE float t_y = (float(plane_y) - ray.start.y) * ray.inverse.y;
    HEARTH_PRECISE float t_z = (float(plane_z) - ray.start.z) * ray.inverse.z;
    float t = min(t_x, min(t_y, t_z));
    bool over_x = t_x <= t;
    bool over_y = !over_x && t_y <= t;
    bool over_z = !(over_x || over_y);
    ray.x = over_x ? plane_x + ~up_x : ray.x;
    ray.y = over_y ? plane_y + ~up_y : ray.y;
    ray.z = over_z ? plane_z + ~up_z : ray.z;
    ray.face = over_x ? uint(1 + up_x) : over_y ? uint(3 + up_y) : uint(5 + up_z);
    // rounding may put a plane a little before where the ray is
    ray.t = max(ray.t, t);
    ++ray.steps;
    ray.inside = ray.t < ray.end ? 1u : 0u;
    return ray;
}

/// A coordinate that may have moved on inside its cell of `edge` voxels, to `place`.
HEARTH_FUNCTION int brickReached(int voxel, int edge, float place, float inverse)
{
    int base = voxel & -edge;
    int least = inverse > 0.0f ? voxel : base;
    int most = inverse > 0.0f ? base + edge - 1 : voxel;
    int reached = int(place);
    return reached < least ? least : reached > most ? most : reached;
}

/// The ray in the voxel where it enters its cell of `edge` voxels each way.
HEARTH_FUNCTION BrickRay brickCatchUp(BrickRay ray, int edge)
{
    HEARTH_PRECISE float place_x = ray.start.x + ray.t * ray.direction.x;
    HEARTH_PRECISE float place_y = ray.start.y + ray.t * ray.direction.y;
    HEARTH_PRECISE float place_z = ray.start.z + ray.t * ray.direction.z;
    // not along the axis that was crossed: there the voxel is known
    if (ray.face > 1u)
        ray.x = brickReached(ray.x, edge, place_x, ray.inverse.x);
    if (ray.face < 2u || ray.face > 3u)
        ray.y = brickReached(ray.y, edge, place_y, ray.inverse.y);
    if (ray.face < 4u)
        ray.z = brickReached(ray.z, edge, place_z, ray.inverse.z);
    return ray;
}

/// The ray in the first solid voxel from where it is, its own voxel included; `inside` is 0 where there is none.
/// A voxel counts as solid whatever its opacity.
HEARTH_FUNCTION BrickRay brickMarch(HEARTH_IN(BrickMasks) masks, BrickRay ray)
{
    BrickGrid grid = brickGridOf(masks);
    uint groups_x = brickGroups(grid.voxels_x);
    uint groups_xy = groups_x * brickGroups(grid.voxels_y);
    int known =
        1; // edge of the cell that the ray's voxel is known to lie in: its place there may be an old one
    while (ray.inside != 0u)
    {
        BrickGroup group = brickGroupAt(masks, uint(ray.x >> 4) + groups_x * uint(ray.y >> 4) +
                                                   groups_xy * uint(ray.z >> 4));
        if ((group.brick_mask_low | group.brick_mask_high) == 0u)
        {
            known = 16;
            ray = brickLeave(ray, 16);
            continue;
        }
        if (known == 16)
        {
            known = 1;
            ray = brickCatchUp(ray, 16);
        }
        uint brick_bit = brickBit(uint(ray.x >> 2), uint(ray.y >> 2), uint(ray.z >> 2));
        if (!maskHas(group.brick_mask_low, group.brick_mask_high, brick_bit))
        {
            known = 4;
            ray = brickLeave(ray, 4);
            continue;
        }
        if (known == 4)
        {
            known = 1;
            ray = brickCatchUp(ray, 4);
        }
        ray.brick =
            group.first_brick + maskCountBelow(group.brick_mask_low, group.brick_mask_high, brick_bit);
        Brick brick = brickAt(masks, ray.brick);
        uint low = brick.voxel_mask_low;
        uint high = brick.voxel_mask_high;
        uint x = uint(ray.x);
        uint y = uint(ray.y);
        uint z = uint(ray.z);
        while (ray.inside != 0u && ((uint(ray.x) ^ x) | (uint(ray.y) ^ y) | (uint(ray.z) ^ z)) < 4u)
        {
            ray.bit = brickBit(uint(ray.x), uint(ray.y), uint(ray.z));
            if (maskHas(low, high, ray.bit))
                return ray;
            ray = brickLeave(ray, 1);
        }
    }
    return ray;
}

/// The ray in the voxel after its own: how light goes on through one that is not opaque.
HEARTH_FUNCTION BrickRay brickPass(HEARTH_IN(BrickMasks), BrickRay ray)
{
    return brickLeave(ray, 1);
}

HEARTH_SHARED_END

#endif
