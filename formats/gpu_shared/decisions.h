// Decides which clusters are drawn: frustum culling, normal-cone (backface) culling and level of detail; and
// which mips their textures need. One source for the shaders, their CPU reference and the reference culling;
// on IEEE hardware all bits agree. The code uses only + - * and sqrt, in a fixed order, without contraction.
// See runtime/gpu/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_DECISIONS_H
#define HEARTH_SHARED_DECISIONS_H

#include "formats/gpu_shared/records.h"

HEARTH_SHARED_BEGIN

/// 2^-20, eight units in the last place: more than the sum of the few roundings between a stored bound and
/// the vertex that it bounds. So a test that is right in real numbers stays right in floats.
HEARTH_CONSTANT float kRoundingSlack = 9.5367431640625e-7f;

/// Margin of normal cones, as the sine of an angle. Rasterisers snap vertices to 1/256 pixel, which can turn
/// a sliver that barely faces away to the front. The checker allows a cone an error of a tenth of this
/// (formats::kConeSlack).
HEARTH_CONSTANT float kConeMargin = 1e-3f;

/// Distance that the checker lets a cone's apex stand in front of a triangle's plane: formats::kApexSlack.
HEARTH_CONSTANT float kApexMargin = 1e-4f;

/// Lower bound of the threshold in pixels for page requests: a threshold may be 0 or negative.
HEARTH_CONSTANT float kMinRequestThreshold = 0.015625f;

/// Largest finite error. Errors above are infinite: the group is a root, without a coarser version.
HEARTH_CONSTANT float kMaxFiniteError = 1e38f;

HEARTH_FUNCTION float dot3(Float3 a, Float3 b)
{
    HEARTH_PRECISE float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return sum;
}

HEARTH_FUNCTION float sum3(Float3 a)
{
    HEARTH_PRECISE float sum = (a.x + a.y) + a.z;
    return sum;
}

HEARTH_FUNCTION Float3 abs3(Float3 a)
{
    return Float3(abs(a.x), abs(a.y), abs(a.z));
}

HEARTH_FUNCTION Float3 row3(Float4 row)
{
    return Float3(row.x, row.y, row.z);
}

/// Return a point in object space relative to the eye, in world axes.
HEARTH_FUNCTION Float3 toEyeRelative(HEARTH_IN(Instance) instance, Float3 eye, Float3 point)
{
    HEARTH_PRECISE float x =
        dot3(row3(instance.world_from_object_x), point) + (instance.world_from_object_x.w - eye.x);
    HEARTH_PRECISE float y =
        dot3(row3(instance.world_from_object_y), point) + (instance.world_from_object_y.w - eye.y);
    HEARTH_PRECISE float z =
        dot3(row3(instance.world_from_object_z), point) + (instance.world_from_object_z.w - eye.z);
    return Float3(x, y, z);
}

/// True if a view has parallel rays.
HEARTH_FUNCTION bool isOrthographic(HEARTH_IN(FrameView) view)
{
    return view.depth_scale > 0.0f;
}

/// Return the clip-space position of a point relative to the eye. Selects and does not branch, like all that
/// drawing does by isOrthographic: lavapipe compiles a shader anew for each draw if a branch of it depends on
/// a uniform block alone.
HEARTH_FUNCTION Float4 clipPosition(HEARTH_IN(FrameView) view, Float3 relative)
{
    HEARTH_PRECISE float x = dot3(row3(view.clip_x), relative);
    HEARTH_PRECISE float y = dot3(row3(view.clip_y), relative);
    HEARTH_PRECISE float w = dot3(row3(view.clip_w), relative);
    HEARTH_PRECISE float shifted_x = x + view.clip_x.w;
    HEARTH_PRECISE float shifted_y = y + view.clip_y.w;
    HEARTH_PRECISE float depth = (view.clip_w.w - w) * view.depth_scale;
    bool parallel = isOrthographic(view);
    float z_near = view.z_near;
    float one = 1.0f;
    float clip_x = parallel ? shifted_x : x;
    float clip_y = parallel ? shifted_y : y;
    float clip_z = parallel ? depth : z_near;
    float clip_w = parallel ? one : w;
    return Float4(clip_x, clip_y, clip_z, clip_w);
}

/// Box along the world axes, relative to the eye.
struct EyeBox
{
    Float3 center;
    Float3 half_size; ///< with a margin for rounding
};

/// Return the box along the world axes around a box of an instance. Exact for any affine matrix: the half
/// extents become |A| h.
HEARTH_FUNCTION EyeBox toEyeBox(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance, Float3 box_min,
                                Float3 box_max)
{
    HEARTH_PRECISE Float3 center = (box_min + box_max) * 0.5f;
    HEARTH_PRECISE Float3 half_size = (box_max - box_min) * 0.5f;
    Float3 row_x = abs3(row3(instance.world_from_object_x));
    Float3 row_y = abs3(row3(instance.world_from_object_y));
    Float3 row_z = abs3(row3(instance.world_from_object_z));
    HEARTH_PRECISE Float3 extent =
        Float3(dot3(row_x, half_size), dot3(row_y, half_size), dot3(row_z, half_size));
    // magnitude of the terms that rounding errors are relative to
    HEARTH_PRECISE Float3 reach = abs3(center) + half_size;
    HEARTH_PRECISE Float3 magnitude =
        Float3(dot3(row_x, reach) + abs(instance.world_from_object_x.w - view.eye.x),
               dot3(row_y, reach) + abs(instance.world_from_object_y.w - view.eye.y),
               dot3(row_z, reach) + abs(instance.world_from_object_z.w - view.eye.z));
    HEARTH_PRECISE Float3 bound = extent + magnitude * kRoundingSlack;
    EyeBox box;
    box.center = toEyeRelative(instance, view.eye, center);
    box.half_size = bound;
    return box;
}

/// Return the distance from the eye to the nearest point of a box along the world axes, or less.
HEARTH_FUNCTION float eyeBoxDistance(HEARTH_IN(EyeBox) box)
{
    HEARTH_PRECISE Float3 gap =
        Float3(max(abs(box.center.x) - box.half_size.x, 0.0f), max(abs(box.center.y) - box.half_size.y, 0.0f),
               max(abs(box.center.z) - box.half_size.z, 0.0f));
    HEARTH_PRECISE float distance = sqrt(dot3(gap, gap));
    return distance;
}

/// True if the box, transformed by the instance, lies wholly outside one plane of the frustum.
HEARTH_FUNCTION bool boxOutsideFrustum(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                       Float3 box_min, Float3 box_max)
{
    EyeBox box = toEyeBox(view, instance, box_min, box_max);
    for (int i = 0; i < 5; ++i)
    {
        Float3 normal = row3(view.planes[i]);
        HEARTH_PRECISE float reach_inside =
            (dot3(normal, box.center) + dot3(abs3(normal), box.half_size)) + view.planes[i].w;
        if (reach_inside < 0.0f)
            return true;
    }
    return false;
}

/// Return the factor of the LOD curve at a distance. All terms of the sum are positive, so only the last bits
/// are inexact.
HEARTH_FUNCTION float lodFactor(HEARTH_IN(FrameView) view, float distance)
{
    Float4 segment = view.lod_curve[0];
    for (uint i = 1u; i < kLodKnots; ++i)
        if (distance >= view.lod_curve[i].x)
            segment = view.lod_curve[i];
    HEARTH_PRECISE float along = min(max((distance - segment.x) * segment.w, 0.0f), 1.0f);
    HEARTH_PRECISE float factor = segment.y * (1.0f - along) + segment.z * along;
    return factor;
}

/// Error on the screen, E = pixels_m / distance, without the division.
struct ScreenError
{
    float pixels_m; ///< pixels times metres
    float distance; ///< metres
};

/// Project the error of a group to the screen:
///     E = scale * error * lod_scale * lodFactor(d) / d,  d = max(|center - eye| - scale * radius, z_near)
/// Orthographic views have E = scale * error * lod_scale, and no curve.
HEARTH_FUNCTION ScreenError screenError(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                        Float3 sphere_center, float sphere_radius, float error)
{
    HEARTH_PRECISE Float3 relative = toEyeRelative(instance, view.eye, sphere_center);
    HEARTH_PRECISE float distance =
        max(sqrt(dot3(relative, relative)) - instance.scale_max * sphere_radius, view.z_near);
    if (isOrthographic(view))
        distance = 1.0f;
    HEARTH_PRECISE float pixels_m =
        ((instance.scale_max * error) * view.lod_scale) * lodFactor(view, distance);
    ScreenError result;
    result.pixels_m = pixels_m;
    result.distance = distance;
    return result;
}

/// True if the screen error of a group is above the threshold. Both sides of every seam call this with the
/// same bits, so a group is replaced as a whole or not at all.
HEARTH_FUNCTION bool errorExceeds(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                  Float3 sphere_center, float sphere_radius, float error)
{
    if (error > kMaxFiniteError)
        return true;
    ScreenError on_screen = screenError(view, instance, sphere_center, sphere_radius, error);
    HEARTH_PRECISE float allowed_pixels_m = view.threshold * on_screen.distance;
    return on_screen.pixels_m > allowed_pixels_m;
}

/// True if the simplified version of a group is too coarse, and the group is resident. An absent group counts
/// as one without error: errors still never decrease towards the root as long as the resident pages are
/// closed (pack::PageGraph), so the cut draws each surface once.
HEARTH_FUNCTION bool groupRefines(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                  HEARTH_IN(Group) group)
{
    return group.absent == 0u &&
           errorExceeds(view, instance, group.sphere_center, group.sphere_radius, group.error);
}

/// True if the cluster is in the cut, by the cut rule of formats::GroupRecord. `refined` is ignored unless
/// `has_refined`.
HEARTH_FUNCTION bool clusterInCut(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                  HEARTH_IN(Group) own, bool has_refined, HEARTH_IN(Group) refined)
{
    if (has_refined && groupRefines(view, instance, refined))
        return false;
    return groupRefines(view, instance, own);
}

HEARTH_FUNCTION Float3 clusterBoxMin(HEARTH_IN(Cluster) cluster, float grid_step)
{
    HEARTH_PRECISE Float3 corner =
        Float3(float(cluster.base_x) * grid_step, float(cluster.base_y) * grid_step,
               float(cluster.base_z) * grid_step);
    return corner;
}

HEARTH_FUNCTION uint extentShift(HEARTH_IN(Cluster) cluster)
{
    return cluster.extent_z >> 16 & 255u;
}

HEARTH_FUNCTION Float3 clusterBoxMax(HEARTH_IN(Cluster) cluster, float grid_step)
{
    uint shift = extentShift(cluster);
    int x = cluster.base_x + int((cluster.extent_xy & 65535u) << shift);
    int y = cluster.base_y + int((cluster.extent_xy >> 16) << shift);
    int z = cluster.base_z + int((cluster.extent_z & 65535u) << shift);
    HEARTH_PRECISE Float3 corner = Float3(float(x) * grid_step, float(y) * grid_step, float(z) * grid_step);
    return corner;
}

/// Return the axis of a normal cone, scaled by 127 from its octahedral point: whole numbers.
/// axis  two signed bytes, in the low half
HEARTH_FUNCTION Float3 coneRay(uint axis)
{
    // the arithmetic shift extends the sign of each byte
    float x = float(int(axis << 24) >> 24);
    float y = float(int(axis << 16) >> 24);
    HEARTH_PRECISE float z = 127.0f - abs(x) - abs(y);
    if (z >= 0.0f)
        return Float3(x, y, z);
    HEARTH_PRECISE float folded_x = (127.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f);
    HEARTH_PRECISE float folded_y = (127.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f);
    return Float3(folded_x, folded_y, z);
}

/// Eye in the space that a matrix maps from; of an orthographic view the direction in which it looks, of any
/// length.
struct ObjectEye
{
    Float3 position;
    float slack; ///< bound of its rounding error
};

/// Transform the eye to object space.
/// offset  eye minus the matrix's translation, world axes
HEARTH_FUNCTION ObjectEye objectEye(HEARTH_IN(InstanceInverse) inverse, Float3 offset)
{
    Float3 row_x = row3(inverse.object_from_world_x);
    Float3 row_y = row3(inverse.object_from_world_y);
    Float3 row_z = row3(inverse.object_from_world_z);
    Float3 size = abs3(offset);
    HEARTH_PRECISE float magnitude =
        sum3(Float3(dot3(abs3(row_x), size), dot3(abs3(row_y), size), dot3(abs3(row_z), size)));
    ObjectEye eye;
    eye.position = Float3(dot3(row_x, offset), dot3(row_y, offset), dot3(row_z, offset));
    eye.slack = magnitude * kRoundingSlack;
    return eye;
}

/// Return the eye of a view in the space of a matrix.
/// offset  eye minus the matrix's translation, world axes
HEARTH_FUNCTION ObjectEye viewEye(HEARTH_IN(FrameView) view, HEARTH_IN(InstanceInverse) inverse,
                                  Float3 offset)
{
    if (isOrthographic(view))
        return objectEye(inverse, row3(view.clip_w));
    return objectEye(inverse, offset);
}

/// True if all triangles whose normals are in a cone face away from an orthographic view, as boxFacesAway.
HEARTH_FUNCTION bool coneFacesAlong(HEARTH_IN(ObjectEye) direction, uint cone)
{
    Float3 ray = coneRay(cone);
    HEARTH_PRECISE float ray_length = sqrt(dot3(ray, ray));
    HEARTH_PRECISE float sine = float(cone >> 16) * 1.52587890625e-5f + kConeMargin;
    HEARTH_PRECISE float needed =
        (sine * sqrt(dot3(direction.position, direction.position)) + 2.0f * direction.slack) * ray_length;
    return dot3(direction.position, ray) >= needed;
}

/// True if every triangle in the box faces away from the eye. The test runs in object space, where any affine
/// matrix, mirrored or sheared, leaves the facing unchanged. Not for double-sided materials.
/// cone  axis code in the low half, above it the sine of the half-angle in 1/65536; 65535: no cone
/// back  distance from the middle of the box to the apex, against the axis
/// eye   viewEye
HEARTH_FUNCTION bool boxFacesAway(HEARTH_IN(FrameView) view, HEARTH_IN(ObjectEye) eye, uint cone, float back,
                                  Float3 box_min, Float3 box_max)
{
    uint cutoff_code = cone >> 16;
    if (cutoff_code == 65535u)
        return false;
    if (isOrthographic(view))
        return coneFacesAlong(eye, cone);
    HEARTH_PRECISE Float3 center = (box_min + box_max) * 0.5f;
    HEARTH_PRECISE Float3 half_size = (box_max - box_min) * 0.5f;

    // all terms times the length of the ray: no division, because its last bits differ between devices
    Float3 ray = coneRay(cone);
    HEARTH_PRECISE float ray2 = dot3(ray, ray);
    HEARTH_PRECISE float ray_length = sqrt(ray2);
    HEARTH_PRECISE Float3 to_center = center - eye.position;
    HEARTH_PRECISE Float3 to_apex = to_center * ray_length - ray * back;
    HEARTH_PRECISE float reach = sqrt(dot3(half_size, half_size)) + back;
    HEARTH_PRECISE float position_slack =
        (2.0f * eye.slack + (sum3(abs3(center)) + 2.0f * back) * kRoundingSlack) + reach * kApexMargin;
    HEARTH_PRECISE float sine = float(cutoff_code) * 1.52587890625e-5f + kConeMargin;
    HEARTH_PRECISE float needed = (sine * sqrt(dot3(to_apex, to_apex))) * ray_length + position_slack * ray2;
    return dot3(to_apex, ray) >= needed;
}

/// True if every triangle of a cluster of a rigid instance faces away.
HEARTH_FUNCTION bool coneFacesAway(HEARTH_IN(FrameView) view, HEARTH_IN(InstanceState) state,
                                   HEARTH_IN(Cluster) cluster)
{
    ObjectEye eye;
    eye.position = state.eye_object;
    eye.slack = state.eye_slack;
    HEARTH_PRECISE float back =
        float((cluster.cone_back & 65535u) << extentShift(cluster)) * 16.0f * state.grid_step;
    return boxFacesAway(view, eye, cluster.cone, back, clusterBoxMin(cluster, state.grid_step),
                        clusterBoxMax(cluster, state.grid_step));
}

/// True if a shadow caster view leaves out the instance.
HEARTH_FUNCTION bool isExcludedCaster(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance)
{
    uint left_out = (instance.flags & kInstanceMoved) != 0u ? kCullMoving : kCullStatic;
    return (view.flags & left_out) != 0u;
}

/// Cull an instance: compute the eye in object space, and test the bounds of the whole mesh.
HEARTH_FUNCTION InstanceState decideInstance(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                             HEARTH_IN(InstanceInverse) inverse, HEARTH_IN(MeshBounds) bounds)
{
    HEARTH_PRECISE Float3 offset =
        Float3(view.eye.x - instance.world_from_object_x.w, view.eye.y - instance.world_from_object_y.w,
               view.eye.z - instance.world_from_object_z.w);
    ObjectEye eye = viewEye(view, inverse, offset);

    InstanceState state;
    state.eye_object = eye.position;
    state.eye_slack = eye.slack;
    state.visible = kInstanceVisible;
    if ((view.flags & kCullInstances) != 0u &&
        boxOutsideFrustum(view, instance, bounds.box_min, bounds.box_max))
        state.visible = kInstanceHidden;
    if (isExcludedCaster(view, instance))
        state.visible = kInstanceHidden;
    // an empty mesh has an empty box
    if (bounds.box_min.x > bounds.box_max.x)
        state.visible = kInstanceHidden;
    state.cone_valid = inverse.object_from_world_x.w != 0.0f ? 1u : 0u;
    state.grid_step = bounds.grid_step;
    state.reserved = 0u;
    return state;
}

/// Return the priority of a group's page, resident or not. 0 if the group's simplified version is good
/// enough, else higher for a larger ratio of error to threshold: the bits of both as floats are subtracted,
/// about 2^23 log2(E / threshold), without a division. Roots are always resident and not requested.
HEARTH_FUNCTION uint groupPriority(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                   HEARTH_IN(Group) group)
{
    if (group.error > kMaxFiniteError)
        return 0u;
    ScreenError on_screen =
        screenError(view, instance, group.sphere_center, group.sphere_radius, group.error);
    HEARTH_PRECISE float allowed_pixels_m = view.threshold * on_screen.distance;
    if (!(on_screen.pixels_m > allowed_pixels_m))
        return 0u;
    HEARTH_PRECISE float least_pixels_m = max(view.threshold, kMinRequestThreshold) * on_screen.distance;
    uint error_bits = floatBits(on_screen.pixels_m);
    uint least_bits = floatBits(least_pixels_m);
    return error_bits > least_bits ? error_bits - least_bits : 1u;
}

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
/// depth / d, and at least that of the image's corners. Orthographic it covers lod_scale pixels.
///
/// density_code  ClusterRecord::uv_density
/// returns       0: the cluster has no UVs, or no material reads them
HEARTH_FUNCTION uint texelRequest(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance, uint density_code,
                                  HEARTH_IN(TexelReach) reach)
{
    if (density_code == 0u)
        return 0u;
    HEARTH_PRECISE float pixels_m = instance.scale_max * view.lod_scale;
    int density = (int(density_code) - 128) << (kTexelRequestBits - 3);
    int fineness = fixedLog2(pixels_m) - density + (kTexelRequestOctaves << kTexelRequestBits);
    if (isOrthographic(view))
        return fineness > 0 ? uint(fineness) : 1u;
    int distance = fixedLog2(max(reach.distance, view.z_near));
    int depth = fixedLog2(max(reach.depth, view.z_near));
    int own_cosine = depth - fixedLog2(max(reach.farthest, view.z_near));
    int corner_cosine = fixedLog2(view.corner_cosine);
    int cosine = own_cosine > corner_cosine ? own_cosine : corner_cosine;
    int by_depth = depth + cosine;
    int by_distance = distance + 2 * cosine;
    int nearness = by_depth > by_distance ? by_depth : by_distance;
    int request = fineness - nearness;
    return request > 0 ? uint(request) : 1u;
}

HEARTH_FUNCTION uint uvDensityCode(HEARTH_IN(Cluster) cluster)
{
    return cluster.counts >> 8 & 255u;
}

/// True if the cluster passes the frustum test.
HEARTH_FUNCTION bool clusterInFrustum(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                      HEARTH_IN(InstanceState) state, HEARTH_IN(Cluster) cluster)
{
    return (view.flags & kCullFrustum) == 0u ||
           !boxOutsideFrustum(view, instance, clusterBoxMin(cluster, state.grid_step),
                              clusterBoxMax(cluster, state.grid_step));
}

/// Cull a cluster of a visible instance. True if it is drawn unless occluded.
HEARTH_FUNCTION bool decideCluster(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                   HEARTH_IN(InstanceState) state, HEARTH_IN(Cluster) cluster,
                                   HEARTH_IN(Group) own, HEARTH_IN(Group) refined, bool double_sided)
{
    if (state.visible == kInstanceHidden)
        return false;
    if (!clusterInCut(view, instance, own, cluster.refined_group != kNoGroup, refined))
        return false;
    if (!clusterInFrustum(view, instance, state, cluster))
        return false;
    bool test_cone = (view.flags & kCullCone) != 0u && !double_sided && state.cone_valid != 0u;
    return !(test_cone && coneFacesAway(view, state, cluster));
}

HEARTH_SHARED_END

#endif
