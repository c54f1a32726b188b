// Stops of automatic exposure: towards those at which the mean logarithm of the last frame's luminance is
// that of the key. One pixel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/shade/tonemap.glsl"

layout(set = kSetPost, binding = kPostRadiance) uniform sampler2D light;
layout(set = kSetPost, binding = kPostExposure) uniform sampler2D last_exposure;
layout(push_constant) uniform Push { ExposurePush push; };
layout(location = 0) out float out_stops;

float meanLogLuminance()
{
    ivec2 size = textureSize(light, 0);
    float sum = 0.0;
    for (int y = 0; y < size.y; ++y)
    {
        float row = 0.0;
        for (int x = 0; x < size.x; ++x)
            row += log2(max(luminance(texelFetch(light, ivec2(x, y), 0).rgb), kMinMeteredLuminance));
        sum += row;
    }
    return sum / float(size.x * size.y);
}

void main()
{
    float stops = push.has_history != 0u ? texelFetch(last_exposure, ivec2(0), 0).r : 0.0;
    if (push.has_light != 0u)
        stops += (log2(push.key) - meanLogLuminance() - stops) * push.share;
    out_stops = stops;
}
