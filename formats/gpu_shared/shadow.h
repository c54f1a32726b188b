// Shadow maps: texel and depth of a point in the maps of a light, and the depth bias of casters against
// self-shadowing. One source for C++ and GLSL, as decisions.h. Depth is reversed as everywhere: 1 is nearest
// to the light.
//
// All maps of a light share its projection and its depths; a map is a scale and an offset of the projection.
// So a point is projected once for each light, and each map costs two more multiplications.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SHADOW_H
#define HEARTH_SHARED_SHADOW_H

#include "formats/gpu_shared/occlusion.h"

HEARTH_SHARED_BEGIN

/// Projection of a sun, of a spot, or of one of the faces of a point light. Points are relative to `origin`,
/// in world axes.
struct ShadowLight
{
    Float3 right; ///< right, down and direction are unit and orthogonal
    float depth_scale;
    Float3 down;
    float depth_offset; ///< depth before the division = z * depth_scale + depth_offset, z along `direction`
    Float3 direction;   ///< direction of the light's rays
    float perspective;  ///< 1 spot, face: coordinates are tangents; 0 sun: metres
    Float3 origin;      ///< world: position of the light; for a sun a fixed position near the scene
    float depth_step;   ///< sun: depth that one metre along the light makes; else: nearest distance
    float rounding;     ///< depth by which casters are moved back, because depths are rounded
    uint first_map;
    uint map_count;      ///< sorted by descending density
    float depth_quantum; ///< step of the depths that maps store; 0: floats, whose steps `rounding` covers
};

/// One map of a light: texel = coordinate * scale + offset.
struct ShadowMap
{
    float scale_x; ///< texels for one unit of the light's coordinates
    float scale_y;
    float offset_x;
    float offset_y;
    float size;    ///< texels each way
    float kernel;  ///< texels that the filter reads on each side of a point's own texel
    float density; ///< the smaller of the two scales
    uint layer;
};

/// Maximum number of projections, and of their maps: bounds of the uniform block, whose 7.1 KiB every device
/// can bind. Suns and spots take one projection each, point lights kPointFaces.
HEARTH_CONSTANT uint kMaxShadowProjections = 64;
HEARTH_CONSTANT uint kMaxShadowMaps = 64;

/// Faces of the cube around a point light. Face 2 i looks along axis i, face 2 i + 1 against it.
HEARTH_CONSTANT uint kPointFaces = 6;

/// `Light::shadow_row` of a light without shadows.
HEARTH_CONSTANT uint kNoShadow = 0xFFFFFFFFu;

/// Shadow data of a frame (std140).
struct ShadowBlock
{
    /// index: Light::shadow_row; for a point light plus the face
    ShadowLight lights[kMaxShadowProjections];
    ShadowMap maps[kMaxShadowMaps];
    float error_bias; ///< as for makeCasterView
    /// 1 / texels of a layer each way, a power of two: products with it are exact. A map fills the first
    /// texels.
    float texel_size;
    uint reserved0;
    uint reserved1;
};

/// Cosine of 89.5 degrees, the angle above which offsets stop growing: a surface lit at such an angle is too
/// dark to see.
HEARTH_CONSTANT float kGrazingCosine = 0.0087f;

/// Lower bound in metres of the distance from a light to a plane: a surface seen edge-on covers no texel.
HEARTH_CONSTANT float kMinPlaneDistance = 1e-6f;

/// Texels by which a rasteriser may move a vertex: 1/16 at the coarsest that Vulkan allows, after
/// snapToRaster. A surface is hit at up to this distance beyond the pixel's centre.
HEARTH_CONSTANT float kRasterMargin = 0.0625f;

/// Point in the coordinates of a light.
struct ShadowPoint
{
    float x; ///< the light's coordinates
    float y;
    float depth;
    uint known; ///< 0: behind the light, which is no sun
};

/// Return the face of a point light that covers a point: the axis of its largest coordinate. Both other
/// coordinates divided by that one lie in [-1, 1], so the map of the face covers the point.
HEARTH_FUNCTION uint pointFace(Float3 from_light)
{
    Float3 reach = abs3(from_light);
    uint axis = reach.y > reach.x ? 1u : 0u;
    axis = reach.z > max(reach.x, reach.y) ? 2u : axis;
    float along = axis == 0u ? from_light.x : (axis == 1u ? from_light.y : from_light.z);
    return axis * 2u + (along < 0.0f ? 1u : 0u);
}

/// Return the divisor of the light's coordinates.
HEARTH_FUNCTION float shadowDivisor(HEARTH_IN(ShadowLight) light, float z)
{
    HEARTH_PRECISE float w = z * light.perspective + (1.0f - light.perspective);
    return w;
}

HEARTH_FUNCTION ShadowPoint shadowPoint(HEARTH_IN(ShadowLight) light, Float3 point)
{
    HEARTH_PRECISE float z = dot3(light.direction, point);
    float w = shadowDivisor(light, z);
    ShadowPoint result;
    result.known = w > 0.0f ? 1u : 0u;
    HEARTH_PRECISE float divisor = result.known != 0u ? w : 1.0f;
    HEARTH_PRECISE float x = dot3(light.right, point) / divisor;
    HEARTH_PRECISE float y = dot3(light.down, point) / divisor;
    HEARTH_PRECISE float depth = (z * light.depth_scale + light.depth_offset) / divisor;
    result.x = x;
    result.y = y;
    result.depth = depth;
    return result;
}

/// Return the position in texels: (0, 0) is the map's corner.
HEARTH_FUNCTION Float2 shadowTexel(HEARTH_IN(ShadowMap) map, HEARTH_IN(ShadowPoint) point)
{
    HEARTH_PRECISE float x = point.x * map.scale_x + map.offset_x;
    HEARTH_PRECISE float y = point.y * map.scale_y + map.offset_y;
    return Float2(x, y);
}

/// Return the width in texels of the map's rim where the filter would leave the map, one of them for
/// interpolation between texels.
HEARTH_FUNCTION float shadowMargin(HEARTH_IN(ShadowMap) map)
{
    HEARTH_PRECISE float margin = map.kernel + 1.0f;
    return margin;
}

/// True if a map covers a point. Maps contain the whole path from the light to the end of the scene, so a
/// shadow is correct even where it falls outside the sphere that the map was fitted to.
HEARTH_FUNCTION bool isInShadowMap(HEARTH_IN(ShadowMap) map, HEARTH_IN(ShadowPoint) point)
{
    Float2 texel = shadowTexel(map, point);
    HEARTH_PRECISE float low = shadowMargin(map);
    HEARTH_PRECISE float high = map.size - low;
    return point.known != 0u && texel.x >= low && texel.y >= low && texel.x < high && texel.y < high;
}

/// Return the distance in metres from a light to the plane of a surface, for a sun the cosine between its
/// rays and the normal.
///
/// normal   unit, either side
/// nearest  metres from the light to the nearest part of the surface, or less. At grazing angles the result
///          is that of 89.5 degrees at this distance, the same for all of the surface, since a difference
///          between the vertices of a triangle would tilt it
HEARTH_FUNCTION float shadowFacing(HEARTH_IN(ShadowLight) light, Float3 point, Float3 normal, float nearest)
{
    HEARTH_PRECISE Float3 ray = light.direction * (1.0f - light.perspective) + point * light.perspective;
    HEARTH_PRECISE float ray_length = (1.0f - light.perspective) + nearest * light.perspective;
    HEARTH_PRECISE float least = max(kGrazingCosine * ray_length, kMinPlaneDistance);
    return max(abs(dot3(normal, ray)), least);
}

/// Return the change of a surface's depth from texel to texel, both axes together: |du| + |dv|. Computed by
/// ray differentials: the rays through neighbouring texels meet the tangent plane, where depth is a linear
/// function also in perspective. H. Igehy, "Tracing ray differentials", 1999.
///
/// normal   unit, either side
/// facing   shadowFacing
HEARTH_FUNCTION float shadowSlope(HEARTH_IN(ShadowLight) light, HEARTH_IN(ShadowMap) map, Float3 normal,
                                  float facing)
{
    HEARTH_PRECISE float across =
        abs(dot3(normal, light.right)) / map.scale_x + abs(dot3(normal, light.down)) / map.scale_y;
    HEARTH_PRECISE float slope = light.depth_step * across / facing;
    return slope;
}

/// Return the change of the depth of a surface from texel to texel, along both axes of the map. On the
/// tangent plane depth is linear, also in perspective.
///
/// normal  unit, either side
HEARTH_FUNCTION Float2 shadowDepthGradient(HEARTH_IN(ShadowLight) light, HEARTH_IN(ShadowMap) map,
                                           Float3 point, Float3 normal)
{
    Float3 ray = light.direction * (1.0f - light.perspective) + point * light.perspective;
    float facing = dot3(normal, ray);
    float least = max(kGrazingCosine * sqrt(dot3(ray, ray)), kMinPlaneDistance);
    facing = facing < 0.0f ? min(facing, -least) : max(facing, least);
    return Float2(light.depth_step * dot3(normal, light.right) / (map.scale_x * facing),
                  light.depth_step * dot3(normal, light.down) / (map.scale_y * facing));
}

/// Return a depth beyond the surface of a point in all texels of the filter, as casters are drawn there: by
/// the offset of a caster (shadowCasterClip), by the rise of its surface within the filter, and by as much
/// again for curvature and for other levels of the surface; by a step of depth for the offset, and by one for
/// its rounding. A deeper texel shows what lies beyond its edge.
///
/// depth   of the point
/// normal  unit, either side
/// error   metres, bounds the distance of the point's triangle to the source
HEARTH_FUNCTION float shadowDepthBeyond(HEARTH_IN(ShadowLight) light, HEARTH_IN(ShadowMap) map, Float3 point,
                                        float depth, Float3 normal, float error)
{
    float facing = shadowFacing(light, point, normal, sqrt(dot3(point, point)));
    float rise = shadowSlope(light, map, normal, facing) * (map.kernel + 0.5f + kRasterMargin);
    float by_error =
        light.perspective != 0.0f ? depth * error / (facing + error) : light.depth_step * error / facing;
    return max(depth - 3.0f * rise - 2.0f * by_error - light.rounding - 2.0f * light.depth_quantum, 0.0f);
}

/// Round a texel coordinate to the 1/256 that rasterisers work with.
HEARTH_FUNCTION float snapToRaster(float texel)
{
    HEARTH_PRECISE float steps = floor(texel * 256.0f + 0.5f);
    HEARTH_PRECISE float rounded = steps * 0.00390625f;
    return rounded;
}

/// Return how much the depth of a caster changes that snapToRaster moves by half a step: of one seen at 89.5
/// degrees, of which all others stay below.
HEARTH_FUNCTION float shadowSnapDepth(HEARTH_IN(ShadowLight) light, HEARTH_IN(ShadowMap) map, Float3 point)
{
    float ray_length = light.perspective != 0.0f ? sqrt(dot3(point, point)) : 1.0f;
    float facing = max(kGrazingCosine * ray_length, kMinPlaneDistance);
    return light.depth_step / (min(abs(map.scale_x), abs(map.scale_y)) * facing * 512.0f);
}

/// Return the share [0, 1] of the offset within the filter that a caster needs. The offset keeps lit surfaces
/// from shadowing themselves, and opens a gap where others touch them. Surfaces that face away are not lit:
/// without an offset, walls are tight where they meet the floor of a room. The share grows from triangles
/// seen edge-on to those at 89.5 degrees, where light is too weak to see.
///
/// front  normal of the front, unit
HEARTH_FUNCTION float shadowOffsetShare(HEARTH_IN(ShadowLight) light, Float3 point, Float3 front)
{
    HEARTH_PRECISE Float3 ray = light.direction * (1.0f - light.perspective) + point * light.perspective;
    HEARTH_PRECISE float away = dot3(front, ray) / sqrt(max(dot3(ray, ray), kMinPlaneDistance));
    return min(max(-away / kGrazingCosine, 0.0f), 1.0f);
}

/// Return the clip-space position of a vertex of a caster. It is deeper than the vertex by the rise of its
/// surface within the filter (a tap lies at most kernel + 1/2 texels beside the point that is looked up), by
/// a step of the map's depths (either neighbour of a depth may be stored), by its error and by the rounding
/// of rasterisers. Moving it by the error along the normal instead would open cracks.
///
/// nearest       as for shadowFacing, of the triangle
/// error         metres, bounds the distance of the triangle to the source
/// offset_share  shadowOffsetShare; 1 for a surface with two fronts
HEARTH_FUNCTION Float4 shadowCasterClip(HEARTH_IN(ShadowLight) light, HEARTH_IN(ShadowMap) map, Float3 point,
                                        Float3 normal, float nearest, float error, float offset_share)
{
    HEARTH_PRECISE float z = dot3(light.direction, point);
    float w = shadowDivisor(light, z);
    HEARTH_PRECISE float x = dot3(light.right, point) * map.scale_x;
    HEARTH_PRECISE float y = dot3(light.down, point) * map.scale_y;
    float facing = shadowFacing(light, point, normal, nearest);
    HEARTH_PRECISE float offset =
        (shadowSlope(light, map, normal, facing) * (map.kernel + 0.5f + kRasterMargin) +
         light.depth_quantum) *
        offset_share;
    // depth on the plane that is farther by the error: in perspective all depths shrink by one factor
    HEARTH_PRECISE float farther = facing / (facing + error);
    HEARTH_PRECISE float moved =
        z * light.depth_scale - light.depth_step * error / facing + light.depth_offset;
    HEARTH_PRECISE float surface = light.perspective != 0.0f ? light.depth_offset * farther : moved;
    HEARTH_PRECISE float depth = (surface - offset * w) - light.rounding;
    if (light.perspective == 0.0f)
    {
        // before the offset, which is whole: the map of a sun that has moved is the same, shifted, bit for
        // bit
        x = snapToRaster(x);
        y = snapToRaster(y);
        // a caster that leaves the scene towards the sun casts its shadow from the scene's boundary
        depth = min(depth, 1.0f);
    }
    HEARTH_PRECISE float ndc_of_texel = 2.0f / map.size;
    HEARTH_PRECISE float clip_x = (x + map.offset_x * w) * ndc_of_texel - w;
    HEARTH_PRECISE float clip_y = (y + map.offset_y * w) * ndc_of_texel - w;
    // a vertex that the offset moves behind the end of the scene is clipped, and has nothing behind it;
    // clamping its depth would lift its whole triangle
    return Float4(clip_x, clip_y, depth, w);
}

HEARTH_SHARED_END

#ifdef __cplusplus
// sizes in std430 and std140 layout
static_assert(sizeof(hearth::shared::ShadowLight) == 80);
static_assert(sizeof(hearth::shared::ShadowMap) == 32);
static_assert(sizeof(hearth::shared::ShadowBlock) == 64 * 80 + 64 * 32 + 16);
#endif

#endif
