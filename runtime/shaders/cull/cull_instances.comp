// Instance culling, one thread per instance: tests the bounding volume of the mesh and computes the eye in
// object space.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/occlusion.h"
#include "runtime/shaders/cull/occlusion.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameView view; };
layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, std430) readonly buffer Inverses { InstanceInverse inverses[]; };
layout(set = 0, binding = 3, std430) readonly buffer Bounds { MeshBounds bounds[]; };
layout(set = 0, binding = 4, std430) buffer States { InstanceState states[]; };
layout(push_constant) uniform Push { uint phase; };

void main()
{
    uint i = gl_GlobalInvocationID.y * (kMaxDispatchX * 64u) + gl_GlobalInvocationID.x;
    if (i >= view.instance_count)
        return;
    Instance instance = instances[i];
    MeshBounds mesh = bounds[instance.mesh];
    if (phase == kPhaseLate)
    {
        if (states[i].visible == kInstanceDeferred)
            states[i].visible =
                isHidden(current_view, instance, mesh.box_min, mesh.box_max) ? kInstanceHidden : kInstanceLate;
        return;
    }
    InstanceState state = decideInstance(view, instance, inverses[i], mesh);
    if (phase == kPhaseEarly && state.visible == kInstanceVisible &&
        isHidden(last_view, instance, mesh.box_min, mesh.box_max))
        state.visible = kInstanceDeferred;
    states[i] = state;
}
