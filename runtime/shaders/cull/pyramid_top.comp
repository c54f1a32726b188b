// Computes the levels of the depth pyramid above level 5, in one workgroup.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/occlusion.h"
#include "formats/gpu_shared/push_constants.h"

const uint kThreads = 128u; // the largest workgroup that every device has
layout(local_size_x = kThreads) in;

layout(set = kSetPyramid, binding = kOcclusionPyramid, std430) coherent buffer Pyramid { float pyramid[]; };
layout(push_constant) uniform Push { PyramidPush push; };

void main()
{
    uint levels = pyramidLevels(push.width, push.height);
    for (uint level = kPyramidTileLevels + 1u; level <= levels; ++level)
    {
        uint below = pyramidOffset(push.width, push.height, level - 1u);
        uvec2 size_below = uvec2(pyramidSize(push.width, level - 1u), pyramidSize(push.height, level - 1u));
        uint offset = pyramidOffset(push.width, push.height, level);
        uvec2 size = uvec2(pyramidSize(push.width, level), pyramidSize(push.height, level));
        for (uint i = gl_LocalInvocationIndex; i < size.x * size.y; i += kThreads)
        {
            uvec2 low = uvec2(i % size.x, i / size.x) * 2u;
            uvec2 high = min(low + 1u, size_below - 1u);
            uint upper = below + low.y * size_below.x;
            uint lower = below + high.y * size_below.x;
            pyramid[offset + i] = min(min(pyramid[upper + low.x], pyramid[upper + high.x]),
                                      min(pyramid[lower + low.x], pyramid[lower + high.x]));
        }
        memoryBarrierBuffer();
        barrier();
    }
}
