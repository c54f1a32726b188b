// Looks up shadow maps: the share of a light that reaches a point. Needs formats/gpu_shared/shading.h,
// formats/gpu_shared/shadow.h, runtime/shaders/scene/surface_point.glsl and `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/record_values.h"
#include "runtime/shaders/scene/shadow_block.glsl"

layout(set = kSetScene, binding = kSceneShadowMaps) uniform sampler2DArray shadow_maps;

// Point in the space of a light, and the densest of the light's shadow maps that contains it.
struct ShadowLookup
{
    uint map; // kNoShadow: no map, the point counts as lit
    vec2 texel;
    ShadowPlane plane;
    bool planar; // a wall, no part of a curved surface
};

// The point is moved by its error along the normal, so that another level of its surface, which is drawn into
// the map, does not shadow it.
ShadowLookup findShadowMap(Light light, SurfacePoint surface)
{
    ShadowLookup found;
    found.map = kNoShadow;
    uint row = light.shadow_row;
    if (row == kNoShadow)
        return found;
    ShadowLight projection = shadows.lights[row];
    vec3 from_light = surface.position + (view.eye - projection.origin) + surface.flat_normal * surface.error;
    if (light.type == kLightPoint)
        projection = shadows.lights[row + pointFace(from_light)];
    ShadowPoint point = shadowPoint(projection, from_light);
    // nothing casts beyond the far end of a sun's scene
    point.depth = max(point.depth, 0.0);
    for (uint i = 0u; i < projection.map_count && found.map == kNoShadow; ++i)
        if (isInShadowMap(shadows.maps[projection.first_map + i], point))
            found.map = projection.first_map + i;
    if (found.map == kNoShadow)
        return found;
    ShadowMap map = shadows.maps[found.map];
    found.texel = shadowTexel(map, point);
    found.plane = shadowReceiver(projection, map, point, from_light, surface.flat_normal);
    found.planar = abs(dot(surface.normal, surface.flat_normal)) > kPlanarCosine;
    return found;
}

float storedDepth(ivec2 texel, uint layer) { return texelFetch(shadow_maps, ivec3(texel, int(layer)), 0).r; }

// Percentage-closer filtering: the lit share of (2 kernel + 1)^2 texels.
float filterShadow(ShadowLookup at)
{
    ShadowMap map = shadows.maps[at.map];
    ivec2 middle = ivec2(floor(at.texel));
    int reach = int(map.kernel);
    float lit = 0.0;
    float shadowed = 0.0;
    float beyond = 0.0;
    float touching = 0.0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
        {
            ivec2 texel = middle + ivec2(x, y);
            vec2 offset = vec2(texel) + 0.5 - at.texel;
            float stored = storedDepth(texel, map.layer);
            uint tap = compareTap(at.plane, offset.x, offset.y, stored);
            if (tap == kTapShadowed)
            {
                ivec2 away = ivec2(offset.x < 0.0 ? -1 : 1, offset.y < 0.0 ? -1 : 1);
                float next_x = storedDepth(texel + ivec2(away.x, 0), map.layer);
                float next_y = storedDepth(texel + ivec2(0, away.y), map.layer);
                tap = continueTap(at.plane, offset.x, offset.y, stored, next_x, next_y);
            }
            lit += tap == kTapLit ? 1.0 : 0.0;
            shadowed += tap == kTapShadowed ? 1.0 : 0.0;
            beyond += tap == kTapBeyond ? 1.0 : 0.0;
            touching += tap == kTapTouching ? 1.0 : 0.0;
        }
    return litShare(lit, shadowed, beyond, touching, at.planar);
}

// Share of the light that reaches the point: 0 in shadow, 1 fully lit.
float lightVisibility(Light light, SurfacePoint surface)
{
    ShadowLookup at = findShadowMap(light, surface);
    return at.map == kNoShadow ? 1.0 : filterShadow(at);
}
