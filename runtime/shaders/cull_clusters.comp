// One workgroup a work item, one thread a cluster: writes which clusters of the item are drawn as a bit mask.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/decisions.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameView view; };
layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, std430) readonly buffer States { InstanceState states[]; };
layout(set = 0, binding = 3, std430) readonly buffer Items { WorkItem items[]; };
layout(set = 0, binding = 4, std430) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 5, std430) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 6, std430) readonly buffer Groups { Group groups[]; };
layout(set = 0, binding = 7, std430) writeonly buffer Results { WorkResult results[]; };
layout(push_constant) uniform Push { uint item_count; };

// subgroups are not required of the device: the mask is gathered in shared memory
shared uint mask[2];

void main()
{
    uint item_index = gl_WorkGroupID.y * kDispatchRow + gl_WorkGroupID.x;
    if (item_index >= item_count)
        return;
    uint lane = gl_LocalInvocationIndex;
    if (lane < 2u)
        mask[lane] = 0u;
    barrier();

    WorkItem item = items[item_index];
    if (lane < item.count && states[item.instance].visible != 0u)
    {
        Cluster cluster = clusters[order[item.first + lane]];
        uint refined = cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group;
        if (decideCluster(view, instances[item.instance], states[item.instance], cluster, groups[cluster.group],
                          groups[refined], (item.flags & kItemDoubleSided) != 0u))
            atomicOr(mask[lane >> 5], 1u << (lane & 31u));
    }
    barrier();

    if (lane == 0u)
        results[item_index] = WorkResult(mask[0], mask[1], 0u, 0u);
}
