// Same as visibility.vert, and passes the inputs of the alpha test.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/draw/visibility.glsl"
#include "runtime/shaders/scene/material.glsl"

layout(location = 0) flat out uint out_id;
layout(location = 1) out vec2 out_uv;
layout(location = 2) out float out_alpha;

void main()
{
    VisibleCorner corner = visibleCorner();
    gl_Position = corner.position;
    out_id = corner.id;
    out_uv = vec2(0.0);
    out_alpha = 1.0;
    if (corner.vertex == kVisibilitySky)
        return;
    out_uv = transformUv(kTextureBaseColor, vertexUv(corner.draw, corner.vertex, uvSet(material.uv_sets, kTextureBaseColor)));
    out_alpha = material.base_color.a * vertexColor(corner.draw, corner.vertex).a;
}
