// Debug view of the shadow map that each pixel reads, for the first light that has a map there. One colour
// per map, dark in its shadow. Grey: none. One triangle for all materials.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/shadow.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"
#include "runtime/shaders/scene/material_test.glsl"
#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/scene/to_eye.glsl"
#include "runtime/shaders/shade/image_color.glsl"
#include "runtime/shaders/shade/shadow.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;

// Eight distinct colours, then as many darker ones.
vec3 mapColor(uint map)
{
    float hue = float(map & 7u) / 8.0;
    vec3 color = clamp(abs(fract(hue + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return color / (1.0 + float(map >> 3u));
}

void main()
{
    uint id = loadVisibility();
    if (isForeign(id))
        discard;
    Surface s = resolveSurface(id, gl_FragCoord.xy);
    vec3 normal = geometricNormal(s);
    normal = s.front ? normal : -normal;
    vec3 color = vec3(0.3);
    for (uint i = lighting.light_count; i-- > 0u;)
    {
        ShadowLookup at = findShadowMap(lights[i], s.position, normal, surfaceError(s));
        if (at.map != kNoShadow)
            color = mapColor(at.map) * (0.2 + 0.8 * filterShadow(at, normal, surfaceError(s)));
    }
    // dimmed by the angle to the eye, so that the shape is visible
    float facing = 0.35 + 0.65 * abs(dot(normal, normalizeOr(toEye(s.position), vec3(0.0))));
    out_color = vec4(imageColor(color * facing), 1.0);
}
