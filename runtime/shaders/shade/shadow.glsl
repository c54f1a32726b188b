// Looks up shadow maps: the share of a light that reaches a point. Needs formats/gpu_shared/shading.h,
// formats/gpu_shared/shadow.h and `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/specialization.h"
#include "runtime/shaders/scene/shadow_block.glsl"

// compares: 1 where the point is no deeper than the texel; one mip, so derivatives do not matter
layout(set = kSetScene, binding = kSceneShadowMaps) uniform sampler2DArrayShadow shadow_maps;

layout(constant_id = kConstantFiltersShadows) const bool kFiltersShadows = false;

// Point in the space of a light, and the densest of the light's shadow maps that contains it.
struct ShadowLookup
{
    ShadowPoint point;
    vec3 from_light;
    uint row; // of the projection
    uint map; // kNoShadow: no map, the point counts as lit
};

// position     relative to the eye
// flat_normal  unit, of the triangle, towards the visible side
// error        metres, bounds the distance of the triangle to the source. The point is moved by it along the
//              normal, so that another level of its surface, which is drawn into the map, does not shadow it
ShadowLookup findShadowMap(Light light, vec3 position, vec3 flat_normal, float error)
{
    ShadowLookup found;
    found.map = kNoShadow;
    uint row = light.shadow_row;
    if (row == kNoShadow)
        return found;
    ShadowLight projection = shadows.lights[row];
    found.from_light = position + (view.eye - projection.origin) + flat_normal * error;
    found.row = light.type == kLightPoint ? row + pointFace(found.from_light) : row;
    projection = shadows.lights[found.row];
    found.point = shadowPoint(projection, found.from_light);
    for (uint i = 0u; i < projection.map_count && found.map == kNoShadow; ++i)
        if (isInShadowMap(shadows.maps[projection.first_map + i], found.point))
            found.map = projection.first_map + i;
    return found;
}

// 1 where a depth is no deeper than a texel, at its centre. Between centres, and with kFiltersShadows, the
// mean of the texels around, by their distances.
float isLit(ShadowMap map, vec2 texel, float depth)
{
    return texture(shadow_maps, vec4(texel * shadows.texel_size, float(map.layer), depth));
}

// Number of the (2 kernel + 1)^2 texels in which a depth is lit. With kFiltersShadows (kernel + 1)^2 compares
// find it: along each axis one in the middle of each pair of texels, whose mean counts twice, and one for the
// last texel.
float countLit(ShadowMap map, vec2 middle, float depth)
{
    int reach = int(map.kernel);
    int pace = kFiltersShadows ? 2 : 1;
    float lit = 0.0;
    for (int y = -reach; y <= reach; y += pace)
        for (int x = -reach; x <= reach; x += pace)
        {
            vec2 tap = vec2(x, y);
            vec2 paired = kFiltersShadows ? vec2(lessThan(tap, vec2(map.kernel))) : vec2(0.0);
            lit += (1.0 + paired.x) * (1.0 + paired.y) * isLit(map, middle + tap + 0.5 * paired, depth);
        }
    // devices may return means of few bits
    return floor(lit + 0.5);
}

// Texels by which rasterisers with the usual 1/256 of a texel move an edge, and some more.
const float kSnapMargin = 1.0 / 64.0;

// Depth of a point's surface at a texel, for a comparison in which the surface itself is lit.
struct SurfaceDepth
{
    vec2 texel; // of the point
    float depth;
    vec2 gradient;
    float rounding; // of the depth of a surface through the point, as it is drawn
};

// The wall of a room and the floor have one depth along their common line. The wall faces away from a light
// outside, so that it casts without an offset: the depth returned here is deeper, whatever rounding did. The
// surface itself casts with one and stays lit.
float depthAt(SurfaceDepth surface, vec2 texel)
{
    float depth = surface.depth + dot(surface.gradient, texel - surface.texel);
    return max(min(depth, surface.depth) - surface.rounding, 0.0);
}

// Filter along the edge of a surface or of a shadow. Each texel is compared with the depth that the surface
// has there, so that a wall shadows the floor up to their common line. Texels that show what lies beyond the
// surface, such as the world outside of a room's corner, do not count.
float filterEdge(ShadowMap map, SurfaceDepth surface, vec2 middle, float beyond_depth)
{
    int reach = int(map.kernel);
    float lit = 0.0;
    float count = 0.0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
        {
            vec2 tap = middle + vec2(x, y);
            float beyond = isLit(map, tap, beyond_depth);
            lit += isLit(map, tap, depthAt(surface, tap)) * (1.0 - beyond);
            count += 1.0 - beyond;
        }
    return count > 0.0 ? lit / count : 1.0;
}

// Percentage-closer filtering: the lit share of (2 kernel + 1)^2 texels, of fewer at the edges of surfaces.
float filterShadow(ShadowLookup at, vec3 flat_normal, float error)
{
    ShadowMap map = shadows.maps[at.map];
    vec2 middle = floor(shadowTexel(map, at.point)) + 0.5;
    // nothing casts beyond the far end of a sun's scene
    float depth = max(at.point.depth, 0.0);
    float side = 2.0 * map.kernel + 1.0;
    float share = countLit(map, middle, depth) / (side * side);
    if (share == 0.0 || share == 1.0)
        return share;
    // does the point's own texel show the surface in the light?
    ShadowLight light = shadows.lights[at.row];
    vec2 gradient = shadowDepthGradient(light, map, at.from_light, flat_normal);
    float rounding = kSnapMargin * (abs(gradient.x) + abs(gradient.y)) + light.rounding + light.depth_quantum +
                     shadowSnapDepth(light, map, at.from_light);
    SurfaceDepth surface = SurfaceDepth(shadowTexel(map, at.point), depth, gradient, rounding);
    float beyond_depth = shadowDepthBeyond(light, map, at.from_light, depth, flat_normal, error);
    if (isLit(map, middle, depthAt(surface, middle)) > isLit(map, middle, beyond_depth))
        return share;
    return filterEdge(map, surface, middle, beyond_depth);
}

// Share of the light that reaches the point: 0 in shadow, 1 fully lit.
float lightVisibility(Light light, vec3 position, vec3 flat_normal, float error)
{
    ShadowLookup at = findShadowMap(light, position, flat_normal, error);
    return at.map == kNoShadow ? 1.0 : filterShadow(at, flat_normal, error);
}
