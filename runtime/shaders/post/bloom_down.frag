// Level of bloom from the one above it, or the first from the frame: 13 taps, as five overlapping squares of
// four. J. Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/shade/stored_radiance.glsl"
#include "runtime/shaders/shade/tonemap.glsl"

layout(set = kSetPost, binding = kPostRadiance) uniform sampler2D source;
layout(push_constant) uniform Push { BloomDownPush push; };
layout(location = 0) out vec4 out_color;

// Middle of the texel in the source, and the size of the source's texels.
vec2 center, texel;

vec3 tap(float x, float y) { return textureLod(source, center + vec2(x, y) * texel, 0.0).rgb; }

vec3 sum = vec3(0.0);
float weights = 0.0;

void addSquare(float weight, vec3 a, vec3 b, vec3 c, vec3 d)
{
    vec3 mean = 0.25 * (a + b + c + d);
    // B. Karis, "Tone mapping", 2013: a pixel far brighter than its neighbours flickers as the camera moves
    if (push.dims_fireflies != 0u)
        weight /= 1.0 + luminance(mean);
    sum += weight * mean;
    weights += weight;
}

void main()
{
    ivec2 size = textureSize(source, 0);
    texel = 1.0 / vec2(size);
    center = gl_FragCoord.xy / vec2(bloomSize(uint(size.x), 1u), bloomSize(uint(size.y), 1u));
    vec3 a = tap(-2.0, -2.0), b = tap(0.0, -2.0), c = tap(2.0, -2.0);
    vec3 d = tap(-2.0, 0.0), e = tap(0.0, 0.0), f = tap(2.0, 0.0);
    vec3 g = tap(-2.0, 2.0), h = tap(0.0, 2.0), i = tap(2.0, 2.0);
    addSquare(0.5, tap(-1.0, -1.0), tap(1.0, -1.0), tap(-1.0, 1.0), tap(1.0, 1.0));
    addSquare(0.125, a, b, d, e);
    addSquare(0.125, b, c, e, f);
    addSquare(0.125, d, e, g, h);
    addSquare(0.125, e, f, h, i);
    out_color = vec4(storedRadiance(sum / weights), 1.0);
}
