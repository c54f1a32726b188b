// Shadow maps: where a point lies in the maps of a light, and how deep a caster is drawn so that no surface shadows
// itself. Written once for C++ and GLSL, as decisions.h. Depth is reversed as everywhere: 1 is nearest to the light.
//
// All maps of a light share its projection and its depths; a map is a scale and an offset of it. So the light projects a
// point once, and every map is two multiplications more.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SHADOW_H
#define HEARTH_SHARED_SHADOW_H

#include "formats/gpu_shared/occlusion.h"

HEARTH_SHARED_BEGIN

/// The projection of a sun or a spot light. Points are relative to `origin`, in world axes.
struct ShadowLight
{
    Float3 right; ///< unit, as `down` and `direction`, and across each other
    float depth_scale;
    Float3 down;
    float depth_offset; ///< depth before the division = z * depth_scale + depth_offset, z along `direction`
    Float3 direction;   ///< the way the light shines
    float perspective;  ///< 1 spot: coordinates are tangents; 0 sun: metres
    Float3 origin;      ///< world: where the spot stands; of a sun any place near the scene that stays
    float depth_step;   ///< depth that a metre along the light makes (sun); nearest distance (spot)
    float rounding;     ///< by how much casters are deeper because depths are rounded
    uint first_map;
    uint map_count; ///< sorted by falling density
    float
        eye_shift; ///< how far the eye that its casters' cuts are seen from may lie off the view's, metres (eyeCell)
};

/// One map of a light: texel = coordinate * scale + offset.
struct ShadowMap
{
    float scale_x; ///< texels a unit of the light's coordinates
    float scale_y;
    float offset_x;
    float offset_y;
    float size;    ///< texels each way
    float kernel;  ///< texels that the filter reads on each side of a point's own
    float density; ///< the smaller one of the scales
    uint layer;
};

/// Lights that cast shadows, and their maps: bounds of the uniform block, whose 3.3 KiB every device can bind.
HEARTH_CONSTANT uint kMaxShadowLights = 16;
HEARTH_CONSTANT uint kMaxShadowMaps = 64;

/// `Light::shadow_row` of lights that cast none.
HEARTH_CONSTANT uint kNoShadow = 0xFFFFFFFFu;

/// All that a frame knows of its shadows (std140).
struct ShadowBlock
{
    ShadowLight lights[kMaxShadowLights]; ///< by Light::shadow_row
    ShadowMap maps[kMaxShadowMaps];
    float error_bias; ///< as makeCasterView
    float layer_size; ///< texels of a layer each way; a map fills its first ones
    uint reserved0;
    uint reserved1;
};

/// Cosine of the angle from which on offsets grow no more, 89.5 degrees: what is lit there is too dark to be seen.
HEARTH_CONSTANT float kGrazingCosine = 0.0087f;

/// Metres that a plane passes a spot at the least: what is seen edge-on covers no texel.
HEARTH_CONSTANT float kLeastFacing = 1e-6f;

/// Texels by which a rasteriser may move a vertex, to 1/16 at the coarsest that Vulkan allows, and rasterStep before it:
/// so much farther than its pixel's centre a surface is met.
HEARTH_CONSTANT float kRasterMargin = 0.0625f;

/// What a light makes of a point.
struct ShadowPoint
{
    float x; ///< the light's coordinates
    float y;
    float depth;
    uint known; ///< 0: behind a spot light
};

/// By what the light's coordinates are divided.
HEARTH_FUNCTION float shadowW(HEARTH_IN(ShadowLight) light, float z)
{
    HEARTH_PRECISE float w = z * light.perspective + (1.0f - light.perspective);
    return w;
}

HEARTH_FUNCTION ShadowPoint shadowPoint(HEARTH_IN(ShadowLight) light, Float3 point)
{
    HEARTH_PRECISE float z = dot3(light.direction, point);
    float w = shadowW(light, z);
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

/// In texels: (0, 0) is the map's corner.
HEARTH_FUNCTION Float2 shadowTexel(HEARTH_IN(ShadowMap) map, HEARTH_IN(ShadowPoint) point)
{
    HEARTH_PRECISE float x = point.x * map.scale_x + map.offset_x;
    HEARTH_PRECISE float y = point.y * map.scale_y + map.offset_y;
    return Float2(x, y);
}

/// Texels at the rim of a map where the filter would leave it, one of them for interpolation between texels.
HEARTH_FUNCTION float shadowMargin(HEARTH_IN(ShadowMap) map)
{
    HEARTH_PRECISE float margin = map.kernel + 1.0f;
    return margin;
}

/// Whether a map says what lies between a point and the light. Maps hold the whole way, from the light to the end of the
/// scene, so a shadow is right also where it falls outside of the sphere that the map was fitted to.
HEARTH_FUNCTION bool shadowMapHolds(HEARTH_IN(ShadowMap) map, HEARTH_IN(ShadowPoint) point)
{
    Float2 texel = shadowTexel(map, point);
    HEARTH_PRECISE float low = shadowMargin(map);
    HEARTH_PRECISE float high = map.size - low;
    return point.known != 0u && texel.x >= low && texel.y >= low && texel.x < high && texel.y < high;
}

/// How much the depth of a surface changes from texel to texel, both ways together: |du| + |dv|. By ray differentials: the
/// rays through neighbouring texels meet the tangent plane, of which depth is a linear function also for a spot.
/// H. Igehy, "Tracing ray differentials", 1999; RUNTIME 2.10 (design notes).
///
/// normal   unit, either side
/// nearest  metres from a spot to the nearest part of the surface, or less: at grazing angles the slope is that of
///          89.5 degrees there, the same for all of the surface, since what differs between the vertices of a triangle would
///          tilt it
HEARTH_FUNCTION float shadowSlope(HEARTH_IN(ShadowLight) light, HEARTH_IN(ShadowMap) map, Float3 point,
                                  Float3 normal, float nearest)
{
    HEARTH_PRECISE Float3 ray = light.direction * (1.0f - light.perspective) + point * light.perspective;
    HEARTH_PRECISE float ray_length = (1.0f - light.perspective) + nearest * light.perspective;
    HEARTH_PRECISE float least = max(kGrazingCosine * ray_length, kLeastFacing);
    HEARTH_PRECISE float facing = max(abs(dot3(normal, ray)), least);
    HEARTH_PRECISE float across =
        abs(dot3(normal, light.right)) / map.scale_x + abs(dot3(normal, light.down)) / map.scale_y;
    HEARTH_PRECISE float slope = light.depth_step * across / facing;
    return slope;
}

/// A coordinate in texels, rounded to the 1/256 that rasterisers work with.
HEARTH_FUNCTION float rasterStep(float texel)
{
    HEARTH_PRECISE float steps = floor(texel * 256.0f + 0.5f);
    HEARTH_PRECISE float rounded = steps * 0.00390625f;
    return rounded;
}

/// Clip-space position of a vertex of a caster. It is deeper than the vertex by what its surface rises within the filter:
/// a tap lies at most kernel + 1/2 texels beside the point that is looked up, and what rasterisers round by.
///
/// nearest  as shadowSlope: of the triangle
HEARTH_FUNCTION Float4 shadowCasterClip(HEARTH_IN(ShadowLight) light, HEARTH_IN(ShadowMap) map, Float3 point,
                                        Float3 normal, float nearest)
{
    HEARTH_PRECISE float z = dot3(light.direction, point);
    float w = shadowW(light, z);
    HEARTH_PRECISE float x = dot3(light.right, point) * map.scale_x;
    HEARTH_PRECISE float y = dot3(light.down, point) * map.scale_y;
    HEARTH_PRECISE float offset =
        shadowSlope(light, map, point, normal, nearest) * (map.kernel + 0.5f + kRasterMargin);
    HEARTH_PRECISE float depth = ((z * light.depth_scale + light.depth_offset) - offset * w) - light.rounding;
    if (light.perspective == 0.0f)
    {
        // before the offset, which is whole: the map of a sun that has moved is the same, shifted, to the bit
        x = rasterStep(x);
        y = rasterStep(y);
        // what moves out of the scene towards the sun casts its shadow from where the scene begins
        depth = min(depth, 1.0f);
    }
    HEARTH_PRECISE float ndc_of_texel = 2.0f / map.size;
    HEARTH_PRECISE float clip_x = (x + map.offset_x * w) * ndc_of_texel - w;
    HEARTH_PRECISE float clip_y = (y + map.offset_y * w) * ndc_of_texel - w;
    // what the offset brings behind the end of the scene is clipped, and has nothing behind it: held back there, a vertex
    // would lift all of its triangle
    return Float4(clip_x, clip_y, depth, w);
}

/// How far a surface may lie off the true one at a distance from the eye, metres, where errors count `error_bias` times less.
HEARTH_FUNCTION float cutError(HEARTH_IN(FrameView) view, float distance, float error_bias)
{
    HEARTH_PRECISE float pixels = max(view.threshold, 0.0f) * error_bias;
    HEARTH_PRECISE float error =
        pixels * max(distance, view.z_near) / (view.lod_scale * lodFactor(view, distance));
    return error;
}

/// How far a point that is seen is moved along its normal before it is looked up, metres: the surface in the picture may
/// lie off the true one by what the threshold allows there, that of the casters by `error_bias` times as much
/// (makeCasterView), seen from an eye that may stand `eye_shift` metres farther away. Else the coarser one would shadow the
/// finer one.
///
/// distance   from the eye to the point
HEARTH_FUNCTION float shadowCutOffset(HEARTH_IN(FrameView) view, float distance, float error_bias,
                                      float eye_shift)
{
    HEARTH_PRECISE float offset =
        cutError(view, distance, 1.0f) + cutError(view, distance + eye_shift, error_bias);
    return offset;
}

HEARTH_SHARED_END

#ifdef __cplusplus
// sizes as std430 and std140 lay them out
static_assert(sizeof(hearth::shared::ShadowLight) == 80);
static_assert(sizeof(hearth::shared::ShadowMap) == 32);
static_assert(sizeof(hearth::shared::ShadowBlock) == 16 * 80 + 64 * 32 + 16);
#endif

#endif
