// Marches rays through a sparse grid of bricks: voxel by voxel in solid regions, brick by brick and group by
// group in empty ones. One source for C++ and GLSL, to the same bits. J. Amanatides, A. Woo, "A fast voxel
// traversal algorithm for ray tracing", 1987. cook/bricks/README.md has the measurements.
//
//     BrickRay ray = brickMarch(bricks, brickRay(grid, origin, direction, max_distance));
//     while (ray.inside) // in a solid voxel: ray.brick, ray.bit, entered by ray.face at brickDistance(...)
//         ray = brickMarch(bricks, brickSkipVoxel(bricks, ray));
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICK_MARCH_H
#define HEARTH_SHARED_BRICK_MARCH_H

#include "formats/gpu_shared/bricks.h"

#ifdef __cplusplus
#include <span>
#endif

// A ray is a voxel and the distance along the ray at which it enters that voxel. A step leaves a cell of 1, 4
// or 16 voxels across the nearest of the three planes that the ray approaches: that coordinate of the voxel
// becomes the other side of the plane. The other two coordinates stay old until a smaller cell is looked at.
// They are then computed from the distance along the ray and clamped between their old values and the other
// side of the cell. So each step advances one coordinate, no coordinate ever moves back, and no ray slips
// between two voxels with a common edge. The number of steps is at most the number of voxels that the ray
// crosses, whatever the rounding.
//
// A ray along a face belongs to the voxel above the face, in x, y or z. A ray that starts on a face and
// points into the voxel enters the voxel by that face; a ray that points away does not meet the voxel.

HEARTH_SHARED_BEGIN

#ifdef __cplusplus
/// Tables that a march reads, valid as the pack checker accepts them.
struct BrickMasks
{
    BrickGrid grid;
    std::span<const BrickGroup> groups;
    std::span<const Brick> bricks;
};
inline const BrickGrid& brickMasksGrid(const BrickMasks& masks)
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
// A shader has one grid, and defines these two functions over its buffers, before or after this header.
#define BrickMasks BrickGrid
BrickGroup brickGroupAt(BrickGrid grid, uint group);
Brick brickAt(BrickGrid grid, uint brick);
BrickGrid brickMasksGrid(BrickGrid grid)
{
    return grid;
}
#endif

/// A direction component below this counts as 0: the ray leaves no voxel along that axis within any distance
/// that a float holds.
HEARTH_CONSTANT float kBrickParallel = 1e-30f;

/// Length of rays without an end.
HEARTH_CONSTANT float kBrickInfinity = 3e38f;

/// Ray and its current voxel. Lengths in voxels, positions from the grid's origin.
struct BrickRay
{
    Float3 start;     ///< position in the grid's box: the ray's origin, or its entry into the box
    float start_t;    ///< distance from the ray's origin to `start`
    Float3 direction; ///< unit length; 0 along axes that the ray does not move along
    float end;        ///< length from `start`, at most to the end of the grid
    Float3 inverse;   ///< 1 / direction
    float t;          ///< distance from `start` to the entry into the voxel
    int x;            ///< voxel coordinates
    int y;
    int z;
    uint face;  ///< face of kVoxelFaces by which the ray enters the voxel; kNoFace where it starts inside
    uint brick; ///< brick of the solid voxel that brickMarch found, and the voxel's bit there
    uint bit;
    uint inside; ///< 0: the ray has left the grid, or ended
    uint steps;  ///< number of cells left
};

HEARTH_FUNCTION float brickInverse(float along)
{
    return along == 0.0f ? 1.0f / kBrickParallel : 1.0f / along;
}

/// Return the voxel coordinate of a position on an axis in the ray's direction: on a plane, the voxel that
/// the ray enters.
HEARTH_FUNCTION int brickVoxelAt(float position, float inverse, uint voxels)
{
    int voxel = int(position);
    voxel = inverse < 0.0f && float(voxel) == position ? voxel - 1 : voxel;
    voxel = voxel < 0 ? 0 : voxel;
    return voxel < int(voxels) ? voxel : int(voxels) - 1;
}

/// True if the ray enters its voxel across the plane of an axis. False for an axis that it does not move
/// along, because no position lies on the other side of the voxel there.
HEARTH_FUNCTION bool brickEnters(float position, float along, int voxel)
{
    return position == float(along > 0.0f ? voxel : voxel + 1);
}

/// Return a ray in voxels from the grid's origin.
///
/// origin     finite; outside the grid, the ray begins at its entry into the box
/// direction  unit length within rounding; a longer direction makes distances too short by the same factor
/// max_distance        length of the ray, > 0; kBrickInfinity: to the end of the grid
/// returns    the ray in its first voxel, solid or not; `inside` is 0 where it misses the grid
HEARTH_FUNCTION BrickRay brickRayInVoxels(HEARTH_IN(BrickGrid) grid, Float3 origin, Float3 direction,
                                          float max_distance)
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
        // exactly on the planes of the box through which the ray enters
        start_x = in_x < enter ? at_x : up_x ? 0.0f : most.x;
        start_y = in_y < enter ? at_y : up_y ? 0.0f : most.y;
        start_z = in_z < enter ? at_z : up_z ? 0.0f : most.z;
    }
    start_x = min(max(start_x, 0.0f), most.x);
    start_y = min(max(start_y, 0.0f), most.y);
    start_z = min(max(start_z, 0.0f), most.z);
    ray.start = Float3(start_x, start_y, start_z);
    ray.start_t = enter;
    // the same arithmetic as for the planes of voxels: at a smaller distance the ray has not left the box. A
    // ray that misses the box is now on a plane that it leaves through
    HEARTH_PRECISE float end_x = ((up_x ? most.x : 0.0f) - start_x) * ray.inverse.x;
    HEARTH_PRECISE float end_y = ((up_y ? most.y : 0.0f) - start_y) * ray.inverse.y;
    HEARTH_PRECISE float end_z = ((up_z ? most.z : 0.0f) - start_z) * ray.inverse.z;
    HEARTH_PRECISE float rest = max_distance - enter;
    ray.end = min(min(end_x, end_y), min(end_z, rest));
    ray.t = 0.0f;
    ray.inside = ray.end > 0.0f ? 1u : 0u;
    ray.x = brickVoxelAt(start_x, ray.inverse.x, grid.voxels_x);
    ray.y = brickVoxelAt(start_y, ray.inverse.y, grid.voxels_y);
    ray.z = brickVoxelAt(start_z, ray.inverse.z, grid.voxels_z);
    ray.face = kNoFace;
    // from outside, only the entered plane of the box: a hit of another plane may be rounding
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

/// Return a ray in world space.
/// max_distance  length in metres
HEARTH_FUNCTION BrickRay brickRay(HEARTH_IN(BrickGrid) grid, Float3 origin, Float3 direction,
                                  float max_distance)
{
    HEARTH_PRECISE float x = (origin.x - grid.origin.x) / grid.voxel_size;
    HEARTH_PRECISE float y = (origin.y - grid.origin.y) / grid.voxel_size;
    HEARTH_PRECISE float z = (origin.z - grid.origin.z) / grid.voxel_size;
    HEARTH_PRECISE float max_voxels = max_distance / grid.voxel_size;
    return brickRayInVoxels(grid, Float3(x, y, z), direction, max_voxels);
}

/// Return the distance in metres from the ray's origin to its entry into the current voxel.
HEARTH_FUNCTION float brickDistance(HEARTH_IN(BrickGrid) grid, HEARTH_IN(BrickRay) ray)
{
    HEARTH_PRECISE float t = (ray.start_t + ray.t) * grid.voxel_size;
    return t;
}

/// Leave the cell of `edge` voxels each way (1, 4 or 16) that the voxel lies in. Sets only the crossed
/// coordinate; updateBrickVoxel moves the others, which keep their old values inside the cell.
HEARTH_FUNCTION BrickRay brickLeaveCell(BrickRay ray, int edge)
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
    // rounding may put a plane a little before the current distance
    ray.t = max(ray.t, t);
    ++ray.steps;
    ray.inside = ray.t < ray.end ? 1u : 0u;
    return ray;
}

/// Return a coordinate that may have advanced inside its cell of `edge` voxels, to `position`.
HEARTH_FUNCTION int advanceBrickVoxel(int voxel, int edge, float position, float inverse)
{
    int base = voxel & -edge;
    int least = inverse > 0.0f ? voxel : base;
    int most = inverse > 0.0f ? base + edge - 1 : voxel;
    int reached = int(position);
    return reached < least ? least : reached > most ? most : reached;
}

/// Return the ray with its voxel advanced to the entry into its cell of `edge` voxels each way.
HEARTH_FUNCTION BrickRay updateBrickVoxel(BrickRay ray, int edge)
{
    HEARTH_PRECISE float place_x = ray.start.x + ray.t * ray.direction.x;
    HEARTH_PRECISE float place_y = ray.start.y + ray.t * ray.direction.y;
    HEARTH_PRECISE float place_z = ray.start.z + ray.t * ray.direction.z;
    // not along the crossed axis: that coordinate is exact
    if (ray.face > 1u)
        ray.x = advanceBrickVoxel(ray.x, edge, place_x, ray.inverse.x);
    if (ray.face < 2u || ray.face > 3u)
        ray.y = advanceBrickVoxel(ray.y, edge, place_y, ray.inverse.y);
    if (ray.face < 4u)
        ray.z = advanceBrickVoxel(ray.z, edge, place_z, ray.inverse.z);
    return ray;
}

/// Return the ray in the first solid voxel from its current voxel on, the current one included; `inside` is 0
/// if there is none. A voxel counts as solid whatever its opacity.
HEARTH_FUNCTION BrickRay brickMarch(HEARTH_IN(BrickMasks) masks, BrickRay ray)
{
    BrickGrid grid = brickMasksGrid(masks);
    uint groups_x = brickGroupsAlongAxis(grid.voxels_x);
    uint groups_xy = groups_x * brickGroupsAlongAxis(grid.voxels_y);
    // edge of the cell that is known to contain the voxel: the coordinates inside the cell may be old
    int known = 1;
    while (ray.inside != 0u)
    {
        BrickGroup group = brickGroupAt(masks, uint(ray.x >> 4) + groups_x * uint(ray.y >> 4) +
                                                   groups_xy * uint(ray.z >> 4));
        if ((group.brick_mask_low | group.brick_mask_high) == 0u)
        {
            known = 16;
            ray = brickLeaveCell(ray, 16);
            continue;
        }
        if (known == 16)
        {
            known = 1;
            ray = updateBrickVoxel(ray, 16);
        }
        uint brick_bit = brickBit(uint(ray.x >> 2), uint(ray.y >> 2), uint(ray.z >> 2));
        if (!maskHas(group.brick_mask_low, group.brick_mask_high, brick_bit))
        {
            known = 4;
            ray = brickLeaveCell(ray, 4);
            continue;
        }
        if (known == 4)
        {
            known = 1;
            ray = updateBrickVoxel(ray, 4);
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
            ray = brickLeaveCell(ray, 1);
        }
    }
    return ray;
}

/// Return the ray in the next voxel, to continue behind a voxel that is not opaque.
HEARTH_FUNCTION BrickRay brickSkipVoxel(HEARTH_IN(BrickMasks), BrickRay ray)
{
    return brickLeaveCell(ray, 1);
}

HEARTH_SHARED_END

#endif
