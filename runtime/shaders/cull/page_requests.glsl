// Page requests, shared by the passes over rigid and over deformed instances. One workgroup per work item,
// one thread per group. Finds the pages that the frame needs, resident or not, with a priority for each. The
// textures of the clusters that the cut draws are requested as well, for each material with the finest mips.
// Requests depend on the view alone, not on the pages loaded or the clusters drawn so far. SPDX-License-
// Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"

layout(local_size_x = kWorkItemClusters) in;

layout(set = kSetTables, binding = kTableFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableStates, std430) readonly buffer States { InstanceState states[]; };
layout(set = kSetTables, binding = kTableGroupItems, std430) readonly buffer Items { GroupItem items[]; };
layout(set = kSetTables, binding = kTableClusters, std430) readonly buffer Clusters { Cluster clusters[]; };
layout(set = kSetTables, binding = kTableGroups, std430) readonly buffer Groups { Group groups[]; };
layout(set = kSetTables, binding = kTablePageRequests, std430) buffer Requests { uint requests[]; };
layout(push_constant) uniform Push { PageRequestPush push; };

// transformedGroup: the group with the bounds that the cut test uses. inFrustum: true if the cluster passes
// the frustum test. findReach: of the cluster.
Group transformedGroup(uint instance, uint group);
bool inFrustum(uint instance, uint cluster);
TexelReach findReach(uint instance, uint cluster);

// Request the set of pages of a group. The first page of a set represents the whole set.
void requestPage(uint group, uint request)
{
    if (request != 0u)
        atomicMax(requests[groups[group - groups[group].set_offset].page], request);
}

// Request the mips of the cluster's material.
void requestTexels(uint instance, uint cluster)
{
    uint code = uvDensityCode(clusters[cluster]);
    uint material = clusters[cluster].material;
    uint row = material == kNoGroup ? push.default_material : material;
    if (code != 0u)
        atomicMax(requests[push.first_material + row],
                  texelRequest(view, instances[instance], code, findReach(instance, cluster)));
}

void main()
{
    uint item_index = gl_WorkGroupID.y * kMaxDispatchX + gl_WorkGroupID.x;
    if (item_index >= push.item_count)
        return;
    GroupItem item = items[push.first_item + item_index];
    // clusters occluded in the last frame are still in the frustum, so they are requested as well
    if (gl_LocalInvocationIndex >= item.count || states[item.instance].visible == kInstanceHidden)
        return;
    uint own = item.first + gl_LocalInvocationIndex;
    Group group = transformedGroup(item.instance, own);
    uint request = groupPriority(view, instances[item.instance], group);
    // errors do not grow towards the source, so nothing finer is needed either
    if (request == 0u && group.error <= kMaxFiniteError)
        return;
    bool seen = false;
    for (uint c = group.first_cluster; c < group.first_cluster + group.cluster_count; ++c)
    {
        if (!inFrustum(item.instance, c))
            continue;
        seen = true;
        // the finer group is requested even outside of the frustum, or else the coarser cluster would stay
        uint refined = clusters[c].refined_group;
        uint refined_request = 0u;
        if (refined != kNoGroup)
            refined_request = groupPriority(view, instances[item.instance], transformedGroup(item.instance, refined));
        if (refined_request != 0u)
            requestPage(refined, refined_request);
        else // the cut draws it, once all is there
            requestTexels(item.instance, c);
    }
    if (seen)
        requestPage(own, request);
}
