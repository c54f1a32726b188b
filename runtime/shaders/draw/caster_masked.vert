// Same as caster.vert, and passes the inputs of the alpha test.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/shadow.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/draw/caster.glsl"
#include "runtime/shaders/scene/material.glsl"

layout(location = 0) out vec2 out_uv;
layout(location = 1) out float out_alpha;

void main()
{
    CasterCorner corner = casterCorner();
    gl_Position = corner.position;
    out_uv = vec2(0.0);
    out_alpha = 1.0;
    if (corner.vertex == kVisibilitySky)
        return;
    out_uv = transformUv(kTextureBaseColor, vertexUv(corner.draw, corner.vertex, uvSet(material.uv_sets, kTextureBaseColor)));
    out_alpha = material.base_color.a * vertexColor(corner.draw, corner.vertex).a;
}
