// Writes the derivatives of UV set 0 as the renderer's shading uses them: by x in the first two channels, by
// y in the others.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"

layout(location = 0) out vec4 out_derivatives;

void main()
{
    uint id = loadVisibility();
    out_derivatives = vec4(0.0);
    if (id == kVisibilitySky)
        return;
    SurfaceUv at = surfaceUv(resolveSurface(id, gl_FragCoord.xy), 0u);
    out_derivatives = vec4(at.dx, at.dy);
}
