// One workgroup a work item, one thread a cluster: writes which clusters of the item are drawn as a bit mask, and in
// the early phase which ones the late phase looks at again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/occlusion.h"
#include "occlusion.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameView view; };
layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, std430) readonly buffer States { InstanceState states[]; };
layout(set = 0, binding = 3, std430) readonly buffer Items { WorkItem items[]; };
layout(set = 0, binding = 4, std430) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 5, std430) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 6, std430) readonly buffer Groups { Group groups[]; };
layout(set = 0, binding = 7, std430) buffer Results { WorkResult results[]; };
layout(push_constant) uniform Push
{
    uint item_count;
    uint phase;
};

// subgroups are not required of the device: the masks are gathered in shared memory
shared uint drawn[2];
shared uint later[2];

bool inFrame(WorkItem item, Cluster cluster)
{
    uint refined = cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group;
    return decideCluster(view, instances[item.instance], states[item.instance], cluster, groups[cluster.group],
                         groups[refined], (item.flags & kItemDoubleSided) != 0u);
}

void main()
{
    uint item_index = gl_WorkGroupID.y * kDispatchRow + gl_WorkGroupID.x;
    if (item_index >= item_count)
        return;
    uint lane = gl_LocalInvocationIndex;
    if (lane < 2u)
    {
        drawn[lane] = 0u;
        later[lane] = 0u;
    }
    barrier();

    WorkItem item = items[item_index];
    uint seen = states[item.instance].visible;
    uint word = lane >> 5;
    uint bit = 1u << (lane & 31u);
    if (lane < item.count && (seen == kInstanceVisible || seen == kInstanceLate))
    {
        Cluster cluster = clusters[order[item.first + lane]];
        float grid_step = states[item.instance].grid_step;
        bool candidate;
        if (phase == kPhaseLate && seen == kInstanceVisible)
            candidate = ((word == 0u ? results[item_index].later_low : results[item_index].later_high) & bit) != 0u;
        else
            candidate = inFrame(item, cluster);
        bool hidden = false;
        if (candidate && phase != kPhaseWhole)
        {
            vec3 box_min = clusterBoxMin(cluster, grid_step);
            vec3 box_max = clusterBoxMax(cluster, grid_step);
            if (phase == kPhaseLate)
                hidden = isHidden(current_view, instances[item.instance], box_min, box_max);
            else
                hidden = isHidden(last_view, instances[item.instance], box_min, box_max);
        }
        if (candidate && !hidden)
            atomicOr(drawn[word], bit);
        if (hidden && phase == kPhaseEarly)
            atomicOr(later[word], bit);
    }
    barrier();

    if (lane == 0u)
        results[item_index] = WorkResult(drawn[0], drawn[1], 0u, later[0], later[1]);
}
