// Decides which mips of textures a view wants: the most pixels that a UV unit can cover on a cluster. One
// source for the shaders and their CPU reference, equal to the bit: see decisions.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_TEXEL_REQUESTS_H
#define HEARTH_SHARED_TEXEL_REQUESTS_H

#include "formats/gpu_shared/decisions.h"

HEARTH_SHARED_BEGIN

/// Unit of texelRequest: 2^-kTexelRequestBits octaves.
HEARTH_CONSTANT int kTexelRequestBits = 20;

/// Octaves that texelRequest adds, so that it is positive.
HEARTH_CONSTANT int kTexelRequestOctaves = 64;

/// Octaves that texelRequest may be too small by: six logarithms, each off by at most 0.0081.
HEARTH_CONSTANT float kTexelRequestError = 0.05f;

/// Return log2(x) of a float >= 0 in units of 2^-kTexelRequestBits, off by at most 0.0081 octaves. The bits
/// of a float are its logarithm drawn as straight lines between powers of two; a parabola bends them.
/// Integers alone, because the last bits of log2 differ between devices. 0 is as 2^-127.
HEARTH_FUNCTION int fixedLog2(float x)
{
    uint bits = floatBits(x);
    uint along = bits >> 8 & 32767u; // from one power of two to the next
    uint bend = (along * (32768u - along) >> 15) * 11272u >> 15;
    return int((bits >> 3) + (bend << 5)) - (127 << kTexelRequestBits);
}

/// Place of a cluster as its textures are asked for, in metres.
struct TexelReach
{
    float distance; ///< lower bound of the distance from the eye to all points of the cluster
    float farthest; ///< upper bound of it
    float depth;    ///< lower bound of the distance along the view's axis, of the points that the view sees
};

/// Return 1 / x of a float > 0, within a few units in the last place where neither is nearly 0: a guess from
/// the bits, then Newton's steps. A division has other bits on other devices.
HEARTH_FUNCTION float nearInverse(float x)
{
    HEARTH_PRECISE float first = floatFromBits(0x7EF311C7u - floatBits(x));
    HEARTH_PRECISE float second = first * (2.0f - x * first);
    HEARTH_PRECISE float third = second * (2.0f - x * second);
    HEARTH_PRECISE float result = third * (2.0f - x * third);
    return result;
}

/// Slopes, or products of two, below this count as 0: some devices have no smaller numbers.
HEARTH_CONSTANT float kMinSlopes = 1e-20f;

/// Linear function over a box, no greater than the depth of any point that the view sees.
struct DepthBound
{
    float middle; ///< its value at the middle of the box
    Float3 slope; ///< along the axes of the object
    float size;   ///< of the terms that rounding errors are relative to, for a box one metre away
};

/// Return the least value of a bound over a box.
/// slack  bound of the rounding errors of a bound of size 1
HEARTH_FUNCTION float leastDepth(HEARTH_IN(DepthBound) bound, Float3 half_size, float slack)
{
    HEARTH_PRECISE float depth = (bound.middle - dot3(abs3(bound.slope), half_size)) - bound.size * slack;
    return depth;
}

/// Make the bound that a direction of the world has.
/// center  of the box, relative to the eye
HEARTH_FUNCTION DepthBound makeDepthBound(HEARTH_IN(Instance) instance, Float3 center, Float3 direction)
{
    HEARTH_PRECISE Float3 slope = (row3(instance.world_from_object_x) * direction.x +
                                   row3(instance.world_from_object_y) * direction.y) +
                                  row3(instance.world_from_object_z) * direction.z;
    DepthBound bound;
    bound.middle = dot3(direction, center);
    bound.slope = slope;
    bound.size = sum3(abs3(direction));
    return bound;
}

/// Lower a bound by what a plane of the frustum has, so many times. Of points inside of the plane this is
/// not negative, so the bound stays one.
/// times  0 or more
HEARTH_FUNCTION DepthBound lowerBound(HEARTH_IN(DepthBound) bound, HEARTH_IN(DepthBound) plane, float times)
{
    HEARTH_PRECISE float middle = bound.middle - plane.middle * times;
    HEARTH_PRECISE Float3 slope = bound.slope - plane.slope * times;
    HEARTH_PRECISE float size = bound.size + plane.size * times;
    DepthBound lowered;
    lowered.middle = middle;
    lowered.slope = slope;
    lowered.size = size;
    return lowered;
}

/// Return part / whole, or 0 if that is negative, or the whole is nearly 0.
HEARTH_FUNCTION float positiveRatio(float part, float whole)
{
    HEARTH_PRECISE float size = abs(whole);
    HEARTH_PRECISE float ratio = abs(part) * nearInverse(max(size, kMinSlopes));
    return size > kMinSlopes && (part > 0.0f) == (whole > 0.0f) ? ratio : 0.0f;
}

/// Return a lower bound of the depth of the points of a box that lie within the frustum. It is the optimum of
/// a linear program, by its dual, of which any solution is a bound, whatever is rounded (S. Boyd and L.
/// Vandenberghe, "Convex optimization", 2004, section 5.2): the view's axis is lowered by one plane or by two
/// that meet in a corner of the image, until the slope along one or two axes of the box is 0. A third plane
/// leads to the eye. So a floor below the eye begins where the view first sees it.
HEARTH_FUNCTION float frustumDepth(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance, Float3 center,
                                   Float3 half_size, float slack)
{
    DepthBound axis = makeDepthBound(instance, center, row3(view.clip_w));
    float depth = leastDepth(axis, half_size, slack);
    DepthBound sides[4];
    for (int i = 0; i < 4; ++i)
    {
        sides[i] = makeDepthBound(instance, center, row3(view.planes[i]));
        for (int u = 0; u < 3; ++u)
        {
            float times = positiveRatio(axis.slope[u], sides[i].slope[u]);
            depth = max(depth, leastDepth(lowerBound(axis, sides[i], times), half_size, slack));
        }
    }
    for (int i = 0; i < 4; ++i)
    {
        DepthBound a = sides[i & 1];
        DepthBound b = sides[2 + (i >> 1)];
        for (int u = 0; u < 3; ++u)
        {
            int v = u == 2 ? 0 : u + 1;
            HEARTH_PRECISE float whole = a.slope[u] * b.slope[v] - a.slope[v] * b.slope[u];
            HEARTH_PRECISE float of_a = axis.slope[u] * b.slope[v] - axis.slope[v] * b.slope[u];
            HEARTH_PRECISE float of_b = a.slope[u] * axis.slope[v] - a.slope[v] * axis.slope[u];
            DepthBound lowered =
                lowerBound(lowerBound(axis, a, positiveRatio(of_a, whole)), b, positiveRatio(of_b, whole));
            depth = max(depth, leastDepth(lowered, half_size, slack));
        }
    }
    return depth;
}

/// Find the reach of a box of an instance, for any affine matrix. See TexelReach.
HEARTH_FUNCTION TexelReach boxReach(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance, Float3 box_min,
                                    Float3 box_max)
{
    EyeBox box = toEyeBox(view, instance, box_min, box_max);
    HEARTH_PRECISE Float3 half_size = (box_max - box_min) * 0.5f;
    Float3 corner = abs3(box.center) + box.half_size;
    HEARTH_PRECISE float slack = sum3(corner) * (4.0f * kRoundingSlack);
    HEARTH_PRECISE float farthest = sqrt(dot3(corner, corner)) + slack;
    TexelReach reach;
    // the axes of the object, so that a turned box is as deep as it is
    reach.depth = frustumDepth(view, instance, box.center, half_size, slack);
    reach.farthest = farthest;
    reach.distance = eyeBoxDistance(box);
    return reach;
}

/// Return a lower bound of the distance from the eye to a cluster's box in object space, so that a long wall
/// that is turned against the axes of the world is as far away as it looks.
///
/// With the columns a, b, c of the matrix, and w from the eye to a point of the box in object space,
///     |A w|^2 >= (a.a - |a.b| - |a.c|) w_x^2 + (b.b - |a.b| - |b.c|) w_y^2 + (c.c - |a.c| - |b.c|) w_z^2,
/// since 2 |w_x w_y| <= w_x^2 + w_y^2. If no factor is negative, the right side is the least for the point
/// nearest in object space. It is exact for rotations, scales along the axes of the object and reflections;
/// 0 for matrices that are sheared too much.
HEARTH_FUNCTION float objectBoxDistance(HEARTH_IN(Instance) instance, HEARTH_IN(InstanceState) state,
                                        Float3 box_min, Float3 box_max)
{
    Float4 x = instance.world_from_object_x;
    Float4 y = instance.world_from_object_y;
    Float4 z = instance.world_from_object_z;
    Float3 a = Float3(x.x, y.x, z.x);
    Float3 b = Float3(x.y, y.y, z.y);
    Float3 c = Float3(x.z, y.z, z.z);
    float ab = abs(dot3(a, b));
    float ac = abs(dot3(a, c));
    float bc = abs(dot3(b, c));
    HEARTH_PRECISE Float3 factor =
        Float3((dot3(a, a) - ab) - ac, (dot3(b, b) - ab) - bc, (dot3(c, c) - ac) - bc);
    if (state.cone_valid == 0u || min(min(factor.x, factor.y), factor.z) < 0.0f)
        return 0.0f;
    HEARTH_PRECISE Float3 center = (box_min + box_max) * 0.5f;
    HEARTH_PRECISE Float3 half_size = (box_max - box_min) * 0.5f;
    // the box grows by the roundings of both its corners and the eye
    HEARTH_PRECISE float slack = state.eye_slack + sum3(abs3(center) + half_size) * kRoundingSlack;
    HEARTH_PRECISE Float3 beyond = abs3(center - state.eye_object) - half_size;
    Float3 gap =
        Float3(max(beyond.x - slack, 0.0f), max(beyond.y - slack, 0.0f), max(beyond.z - slack, 0.0f));
    HEARTH_PRECISE Float3 squares = gap * gap;
    HEARTH_PRECISE float distance = sqrt(dot3(factor, squares)) * (1.0f - 8.0f * kRoundingSlack);
    return distance;
}

/// Find the reach of a cluster of a rigid instance.
HEARTH_FUNCTION TexelReach clusterReach(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                        HEARTH_IN(InstanceState) state, HEARTH_IN(Cluster) cluster)
{
    Float3 box_min = clusterBoxMin(cluster, state.grid_step);
    Float3 box_max = clusterBoxMax(cluster, state.grid_step);
    TexelReach reach = boxReach(view, instance, box_min, box_max);
    reach.distance = max(reach.distance, objectBoxDistance(instance, state, box_min, box_max));
    return reach;
}

/// Return the fineness that a view wants of the textures of a cluster: log2 of the pixels that a UV unit
/// covers at most, in units of 2^-kTexelRequestBits, with kTexelRequestOctaves added. It may be too small by
/// kTexelRequestError.
///
/// A metre that faces the eye at distance d, at an angle a off the view's axis, covers
/// lod_scale / (d cos^2 a) pixels away from the axis, or lod_scale / (depth cos a). The cosine is at least
/// depth / d, and at least that of the image's corners.
///
/// density_code  ClusterRecord::uv_density
/// returns       0: the cluster has no UVs, or no material reads them
HEARTH_FUNCTION uint texelRequest(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance, uint density_code,
                                  HEARTH_IN(TexelReach) reach)
{
    if (density_code == 0u)
        return 0u;
    HEARTH_PRECISE float pixels_m = instance.scale_max * view.lod_scale;
    int distance = fixedLog2(max(reach.distance, view.z_near));
    int depth = fixedLog2(max(reach.depth, view.z_near));
    int own_cosine = depth - fixedLog2(max(reach.farthest, view.z_near));
    int corner_cosine = fixedLog2(view.corner_cosine);
    int cosine = own_cosine > corner_cosine ? own_cosine : corner_cosine;
    int by_depth = depth + cosine;
    int by_distance = distance + 2 * cosine;
    int nearness = by_depth > by_distance ? by_depth : by_distance;
    int density = (int(density_code) - 128) << (kTexelRequestBits - 3);
    int request = fixedLog2(pixels_m) - nearness - density + (kTexelRequestOctaves << kTexelRequestBits);
    return request > 0 ? uint(request) : 1u;
}

HEARTH_FUNCTION uint uvDensityCode(HEARTH_IN(Cluster) cluster)
{
    return cluster.counts >> 8 & 255u;
}

HEARTH_SHARED_END

#endif
