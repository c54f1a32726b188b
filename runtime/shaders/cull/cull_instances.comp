// Instance culling, one thread per instance: tests the bounding volume of the mesh and computes the eye in
// object space.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/occlusion.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/cull/occlusion.glsl"

layout(local_size_x = kGroupInstances) in;

layout(set = kSetTables, binding = kTableFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableInverses, std430) readonly buffer Inverses { InstanceInverse inverses[]; };
layout(set = kSetTables, binding = kTableBounds, std430) readonly buffer Bounds { MeshBounds bounds[]; };
layout(set = kSetTables, binding = kTableStates, std430) buffer States { InstanceState states[]; };
layout(push_constant) uniform Push { PhasePush push; };

void main()
{
    uint i = gl_GlobalInvocationID.y * (kMaxDispatchX * kGroupInstances) + gl_GlobalInvocationID.x;
    if (i >= view.instance_count)
        return;
    Instance instance = instances[i];
    MeshBounds mesh = bounds[instance.mesh];
    if (push.phase == kPhaseLate)
    {
        if (states[i].visible == kInstanceDeferred)
            states[i].visible =
                isHidden(current_view, instance, mesh.box_min, mesh.box_max) ? kInstanceHidden : kInstanceLate;
        return;
    }
    InstanceState state = decideInstance(view, instance, inverses[i], mesh);
    if (push.phase == kPhaseEarly && state.visible == kInstanceVisible &&
        isHidden(last_view, instance, mesh.box_min, mesh.box_max))
        state.visible = kInstanceDeferred;
    states[i] = state;
}
