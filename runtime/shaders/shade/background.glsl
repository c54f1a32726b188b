// Draws the background: pixels in which no surface is visible. Shaders that include it define
// HEARTH_STORES_SURFACES if a step behind shading adds the lights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "runtime/shaders/scene/shading_push.glsl"
#include "formats/gpu_shared/records.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/specialization.h"
#include "runtime/shaders/scene/visibility_input.glsl"
#include "runtime/shaders/shade/shaded_color.glsl"

layout(set = kSetScene, binding = kSceneFrame, std140) uniform Frame { FrameView view; };
#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/scene/pixel_ray.glsl"
#include "runtime/shaders/shade/sky.glsl"

layout(constant_id = kConstantComparesMaterial) const bool kComparesMaterial = false;
layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;
#ifdef HEARTH_STORES_SURFACES
layout(location = 1) out uvec4 out_surface;
#include "runtime/shaders/shade/surface_words.glsl"
#endif

void main()
{
    if (kComparesMaterial && loadVisibility() != kVisibilitySky)
        discard;
    vec3 direction = normalize(pixelRay(gl_FragCoord.xy).along);
    vec3 color = push.debug_view == kViewFinal ? shadedColor(skyBackground(direction)) : imageColor(linearFromSrgb(vec3(0.08)));
    out_color = vec4(color, 1.0);
#ifdef HEARTH_STORES_SURFACES
    out_surface = kNoSurface;
#endif
}
