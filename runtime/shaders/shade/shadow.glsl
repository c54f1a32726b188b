// Looks up shadow maps: the share of a light that reaches a point. Needs formats/gpu_shared/shading.h,
// formats/gpu_shared/shadow.h and `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/record_values.h"
#include "runtime/shaders/scene/shadow_block.glsl"

// compares: 1 where the point is no deeper than the texel; one mip, so derivatives do not matter
layout(set = kSetScene, binding = kSceneShadowMaps) uniform sampler2DArrayShadow shadow_maps;

// Point in the space of a light, and the densest of the light's shadow maps that contains it.
struct ShadowLookup
{
    ShadowPoint point;
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
    vec3 from_light = position + (view.eye - projection.origin) + flat_normal * error;
    if (light.type == kLightPoint)
        projection = shadows.lights[row + pointFace(from_light)];
    found.point = shadowPoint(projection, from_light);
    for (uint i = 0u; i < projection.map_count && found.map == kNoShadow; ++i)
        if (isInShadowMap(shadows.maps[projection.first_map + i], found.point))
            found.map = projection.first_map + i;
    return found;
}

// Percentage-closer filtering: the lit share of (2 kernel + 1)^2 texels.
float filterShadow(ShadowLookup at)
{
    ShadowMap map = shadows.maps[at.map];
    vec2 middle = floor(shadowTexel(map, at.point)) + 0.5;
    // nothing casts beyond the far end of a sun's scene
    float depth = max(at.point.depth, 0.0);
    int reach = int(map.kernel);
    float lit = 0.0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            lit += texture(shadow_maps, vec4((middle + vec2(x, y)) / shadows.layer_size, float(map.layer), depth));
    float side = 2.0 * map.kernel + 1.0;
    return lit / (side * side);
}

// Share of the light that reaches the point: 0 in shadow, 1 fully lit.
float lightVisibility(Light light, vec3 position, vec3 flat_normal, float error)
{
    ShadowLookup at = findShadowMap(light, position, flat_normal, error);
    return at.map == kNoShadow ? 1.0 : filterShadow(at);
}
