// Computes levels 1 to 5 of the depth pyramid, one workgroup per tile of 32 x 32 pixels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/occlusion.h"
#include "formats/gpu_shared/push_constants.h"

const uint kSide = kPyramidTilePixels / 2u; // of a tile in level 1
// half as many rows: 128 threads, the largest workgroup that every device has
layout(local_size_x = kSide, local_size_y = kSide / 2u) in;

layout(set = kSetPyramid, binding = kOcclusionPyramid, std430) writeonly buffer Pyramid { float pyramid[]; };
layout(set = kSetPyramid, binding = kOcclusionDepth) uniform sampler2D depth_buffer;
layout(push_constant) uniform Push { PyramidPush push; };

shared float tile[kSide][kSide];

// Depth of a pixel. Pixels beyond the edge are clamped to the edge; they lie in the same texel.
float depthAt(uvec2 pixel)
{
    return texelFetch(depth_buffer, ivec2(min(pixel, uvec2(push.width - 1u, push.height - 1u))), 0).x;
}

void write(uint level, uvec2 texel, float farthest)
{
    uvec2 size = uvec2(pyramidSize(push.width, level), pyramidSize(push.height, level));
    if (texel.x < size.x && texel.y < size.y)
        pyramid[pyramidOffset(push.width, push.height, level) + texel.y * size.x + texel.x] = farthest;
}

// Computes a texel of level 1.
void reducePixels(uvec2 local)
{
    uvec2 texel = gl_WorkGroupID.xy * kSide + local;
    uvec2 pixel = texel * 2u;
    float farthest = min(min(depthAt(pixel), depthAt(pixel + uvec2(1u, 0u))),
                         min(depthAt(pixel + uvec2(0u, 1u)), depthAt(pixel + uvec2(1u, 1u))));
    write(1u, texel, farthest);
    tile[local.y][local.x] = farthest;
}

void main()
{
    uvec2 local = gl_LocalInvocationID.xy;
    reducePixels(local);
    reducePixels(local + uvec2(0u, kSide / 2u));
    uint last = min(pyramidLevels(push.width, push.height), kPyramidTileLevels);
    for (uint level = 2u; level <= last; ++level)
    {
        uint side = kPyramidTilePixels >> level;
        bool in_tile = local.x < side && local.y < side;
        float farthest = 0.0;
        barrier();
        if (in_tile)
        {
            uvec2 at = local * 2u;
            farthest = min(min(tile[at.y][at.x], tile[at.y][at.x + 1u]),
                           min(tile[at.y + 1u][at.x], tile[at.y + 1u][at.x + 1u]));
            write(level, gl_WorkGroupID.xy * side + local, farthest);
        }
        barrier();
        if (in_tile)
            tile[local.y][local.x] = farthest;
    }
}
