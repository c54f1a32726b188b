// Shades the pixels of one material: reconstructs the surface point and shades it with exact UV derivatives.
// Shaders that include it define:
//   HEARTH_SHADOWED         lights cast shadows
//   HEARTH_GI               indirect light from bricks in place of the sky
//   HEARTH_STORES_SURFACES  a step behind shading adds the lights: the surface is stored for it
//   HEARTH_SUMMED_LIGHTS    steps ahead of shading have summed the lights; HEARTH_JOINED_SUMS: in one image
//   HEARTH_MARKED_LIGHTS    a step ahead of shading has marked the lights that may reach a pixel
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/shadow.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"
#include "runtime/shaders/scene/material_test.glsl"

// explicit because lavapipe otherwise shades every pixel before the depth test, which takes five times the
// frame time
layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;
#ifdef HEARTH_STORES_SURFACES
layout(location = 1) out uvec4 out_surface;
#endif

#ifdef HEARTH_SHADOWED
#include "runtime/shaders/shade/shadow.glsl"
#else
#include "runtime/shaders/shade/unshadowed.glsl"
#endif
#include "runtime/shaders/shade/lighting.glsl"
#include "runtime/shaders/scene/receivers.glsl"
#ifdef HEARTH_GI
#include "runtime/shaders/shade/surrounding_bricks.glsl"
#else
#include "runtime/shaders/shade/surrounding_sky.glsl"
#endif

void main()
{
    uint id = loadVisibility();
    if (isForeign(id))
        discard;
#ifdef HEARTH_STORES_SURFACES
    out_surface = kNoSurface;
#endif
    Surface s = resolveSurface(id, gl_FragCoord.xy);
    SurfacePoint point = surfacePoint(s);
    point.received = surfaceReceivedLight(s);
    out_color = vec4(displayColor(point, surfaceUvs(s)), 1.0);
}
