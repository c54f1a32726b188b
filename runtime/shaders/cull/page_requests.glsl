// Page requests, shared by the passes over rigid and over deformed instances. One workgroup per work item,
// one thread per group. Finds the pages that the frame needs, resident or not, with a priority for each.
// Requests depend on the view alone, not on the pages loaded or the clusters drawn so far.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameView view; };
layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, std430) readonly buffer States { InstanceState states[]; };
layout(set = 0, binding = 3, std430) readonly buffer Items { GroupItem items[]; };
layout(set = 0, binding = 4, std430) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 5, std430) readonly buffer Groups { Group groups[]; };
layout(set = 0, binding = 6, std430) buffer Requests { uint requests[]; };
layout(push_constant) uniform Push
{
    uint first_item;
    uint item_count;
};

// transformedGroup: the group with the bounds that the cut test uses. inFrustum: true if the cluster passes
// the frustum test.
Group transformedGroup(uint instance, uint group);
bool inFrustum(uint instance, uint cluster);

// Request the set of pages of a group. The first page of a set represents the whole set.
void requestPage(uint group, uint request)
{
    if (request != 0u)
        atomicMax(requests[groups[group - groups[group].set_offset].page], request);
}

void main()
{
    uint item_index = gl_WorkGroupID.y * kMaxDispatchX + gl_WorkGroupID.x;
    if (item_index >= item_count)
        return;
    GroupItem item = items[first_item + item_index];
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
        if (refined != kNoGroup)
            requestPage(refined, groupPriority(view, instances[item.instance], transformedGroup(item.instance, refined)));
    }
    if (seen)
        requestPage(own, request);
}
