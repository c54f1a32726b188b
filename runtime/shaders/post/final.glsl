// Final pass: finishes the linear colours of a frame, at any size. Shaders that include it define
// HEARTH_ON_TILE if they finish the pixel's own colour.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/shade/image_color.glsl"
#include "runtime/shaders/shade/stored_radiance.glsl"
#include "runtime/shaders/shade/tonemap.glsl"

#ifdef HEARTH_ON_TILE
layout(input_attachment_index = kInputRadiance, set = kSetPost, binding = kPostRadiance) uniform subpassInput radiance;
#else
layout(set = kSetPost, binding = kPostRadiance) uniform sampler2D radiance;
#endif
layout(push_constant) uniform Push { FinalPush push; };
layout(location = 0) out vec4 out_color;

vec2 imagePosition() { return gl_FragCoord.xy / vec2(push.width, push.height); }

vec3 withBloom(vec3 color, vec3 bloom)
{
    return push.adds_bloom != 0u ? color + push.bloom_strength * bloom : mix(color, bloom, push.bloom_strength);
}

vec4 finished(vec3 color, float exposure)
{
    if (push.shows_data != 0u)
        return vec4(imageColor(color), 1.0);
    if (kStoresExposed)
        return vec4(storedRadiance(exposure * color), 1.0);
    vec3 filter_color = vec3(push.filter_red, push.filter_green, push.filter_blue);
    return vec4(imageColor(photoFilter(toneMap(exposure * color), filter_color, push.filter_density)), 1.0);
}
