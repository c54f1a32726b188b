// One thread an instance: is its mesh in the frustum, and where is the eye in its object space?
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/decisions.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameView view; };
layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, std430) readonly buffer Inverses { InstanceInverse inverses[]; };
layout(set = 0, binding = 3, std430) readonly buffer Bounds { MeshBounds bounds[]; };
layout(set = 0, binding = 4, std430) writeonly buffer States { InstanceState states[]; };

void main()
{
    uint i = gl_GlobalInvocationID.y * (kDispatchRow * 64u) + gl_GlobalInvocationID.x;
    if (i >= view.instance_count)
        return;
    states[i] = decideInstance(view, instances[i], inverses[i], bounds[instances[i].mesh]);
}
