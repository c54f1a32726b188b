// Forward shading with the renderer's shading code, from attributes that the rasteriser interpolates and
// differentiates.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/shade/unshadowed.glsl"
#include "runtime/shaders/shade/lighting.glsl"
#include "runtime/shaders/shade/surrounding_sky.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_tangent;
layout(location = 3) in vec3 in_color;
layout(location = 4) in vec4 in_uvs;
layout(location = 5) flat in float in_side;
layout(location = 6) flat in uint in_mirrored;
layout(location = 0) out vec4 out_color;

void main()
{
    SurfacePoint point;
    point.position = in_position;
    point.normal = normalizeOr(in_normal, vec3(0.0, 1.0, 0.0));
    point.flat_normal = point.normal; // not read without shadows
    completeFrame(point.normal, in_tangent, in_side, point.tangent, point.bitangent);
    point.sky = openSky(point.normal);
    point.instance = 0u; // not read without occlusion
    point.slot = 0u;     // nor this one by the default light method
    point.color = in_color;
    point.received = kNoReceivedLight;
    // two-sided materials: mirrored instances are drawn without reversing the front face
    bool turned = (material.flags & kMaterialDoubleSided) != 0u && in_mirrored != 0u;
    point.front = gl_FrontFacing != turned;

    SurfaceUvs uvs;
    for (uint set = 0u; set < kUvSetCount; ++set)
    {
        vec2 uv = set == 0u ? in_uvs.xy : in_uvs.zw;
        uvs.sets[set] = SurfaceUv(uv, dFdx(uv), dFdy(uv));
    }
    out_color = vec4(displayColor(point, uvs), 1.0);
}
