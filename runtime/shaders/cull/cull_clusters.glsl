// Cluster culling, shared by the passes over rigid and over deformed instances. One workgroup per work item,
// one thread per cluster. Writes a bit mask of the drawn clusters of the item and, in the early phase, a mask
// of the clusters that the late phase tests again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/cull/occlusion.glsl"

layout(local_size_x = kWorkItemClusters) in;

layout(set = kSetTables, binding = kTableFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableStates, std430) readonly buffer States { InstanceState states[]; };
layout(set = kSetTables, binding = kTableItems, std430) readonly buffer Items { WorkItem items[]; };
layout(set = kSetTables, binding = kTableOrder, std430) readonly buffer Order { uint order[]; };
layout(set = kSetTables, binding = kTableGroups, std430) readonly buffer Groups { Group groups[]; };
layout(set = kSetTables, binding = kTableResults, std430) buffer Results { WorkResult results[]; };
layout(push_constant) uniform Push { CullPush push; };

// subgroups are not required of the device, so shared memory gathers the masks
shared uint drawn[2];
shared uint retest[2];

// passesTests: true if the cluster is drawn unless it is occluded. isOccluded: true if the depth seen from
// that view occludes it.
bool passesTests(WorkItem item, uint cluster);
bool isOccluded(OcclusionView seen_from, WorkItem item, uint cluster);

void main()
{
    uint group = gl_WorkGroupID.y * kMaxDispatchX + gl_WorkGroupID.x;
    if (group >= push.item_count)
        return;
    uint item_index = push.first_item + group;
    uint lane = gl_LocalInvocationIndex;
    if (lane < 2u)
    {
        drawn[lane] = 0u;
        retest[lane] = 0u;
    }
    barrier();

    WorkItem item = items[item_index];
    uint seen = states[item.instance].visible;
    uint word = lane >> 5;
    uint bit = 1u << (lane & 31u);
    if (lane < item.count && (seen == kInstanceVisible || seen == kInstanceLate))
    {
        uint cluster = order[item.first + lane];
        bool candidate;
        if (push.phase == kPhaseLate && seen == kInstanceVisible)
            candidate = ((word == 0u ? results[item_index].later_low : results[item_index].later_high) & bit) != 0u;
        else
            candidate = passesTests(item, cluster);
        bool hidden = false;
        if (candidate && push.phase == kPhaseLate)
            hidden = isOccluded(current_view, item, cluster);
        else if (candidate && push.phase == kPhaseEarly)
            hidden = isOccluded(last_view, item, cluster);
        if (candidate && !hidden)
            atomicOr(drawn[word], bit);
        if (hidden && push.phase == kPhaseEarly)
            atomicOr(retest[word], bit);
    }
    barrier();

    if (lane == 0u)
        results[item_index] = WorkResult(drawn[0], drawn[1], 0u, retest[0], retest[1]);
}
