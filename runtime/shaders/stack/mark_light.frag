// Adds a light to the bits of the pixels that it may reach.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/light_bits.h"
#include "formats/gpu_shared/shading.h"

layout(set = kSetScene, binding = kSceneFrame, std140) uniform Frame { FrameView view; };
#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/light/pixel_position.glsl"

layout(location = 0) flat in uint light_row;
layout(location = 1) flat in uint light_place;
layout(location = 0) out vec4 out_low;
layout(location = 1) out vec4 out_high;

// Pixels by which the plane of a triangle may be off in the depth buffer, since rasterizers round vertices.
const float kRoundedPixels = 1.0 / 64.0;

void main()
{
    float depth = loadDepth();
    float slope = fwidth(depth);
    if (depth == 0.0) // the sky
        discard;
    vec3 position = pixelPosition(gl_FragCoord.xy, depth);
    vec3 place = vec3(dot(lighting.grid.right, position), dot(lighting.grid.down, position),
                      dot(lighting.grid.forward, position));
    CellLight light = makeCellLight(lighting.grid, lights[light_row]);
    // shading finds the point by its triangle: at grazing angles the depth is off by more than the slack
    light.slack += mix(length(position) * slope / depth, slope / view.depth_scale, isOrthographic(view)) * kRoundedPixels;
    if (!mayReachPoint(light, place))
        discard;
    vec4 bit = unpackUnorm4x8(1u << (light_place & 31u));
    out_low = light_place < 32u ? bit : vec4(0.0);
    out_high = light_place < 32u ? vec4(0.0) : bit;
}
