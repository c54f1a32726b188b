// After a frame: why each instance and each cluster was drawn or not. One workgroup a work item, one thread a cluster, as
// cull_clusters.comp; and thread i looks at instance i.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/cull_statistics.h"
#include "formats/shared/decisions.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameView view; };
layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, std430) readonly buffer States { InstanceState states[]; };
layout(set = 0, binding = 3, std430) readonly buffer Bounds { MeshBounds bounds[]; };
layout(set = 0, binding = 4, std430) readonly buffer Items { WorkItem items[]; };
layout(set = 0, binding = 5, std430) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 6, std430) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 7, std430) readonly buffer Groups { Group groups[]; };
layout(set = 0, binding = 8, std430) buffer Statistics { CullStatistics statistics; };
layout(push_constant) uniform Push { uint item_count; };

shared uint cluster_counts[kOutcomeCount];
shared uint triangle_counts[kOutcomeCount];

void countInstance(uint i)
{
    MeshBounds mesh = bounds[instances[i].mesh];
    uint seen = states[i].visible;
    if (seen == kInstanceVisible)
        atomicAdd(statistics.visible_instances, 1u);
    else if (seen == kInstanceLate)
        atomicAdd(statistics.late_instances, 1u);
    else if (mesh.box_min.x > mesh.box_max.x)
        atomicAdd(statistics.empty_instances, 1u);
    else if ((view.flags & kCullInstances) != 0u && boxOutsideFrustum(view, instances[i], mesh.box_min, mesh.box_max))
        atomicAdd(statistics.outside_instances, 1u);
    else
        atomicAdd(statistics.occluded_instances, 1u);
}

uint outcomeOf(WorkItem item, Cluster cluster)
{
    Instance instance = instances[item.instance];
    InstanceState state = states[item.instance];
    if (state.visible == kInstanceHidden)
        return kOutcomeInstance;
    bool has_refined = cluster.refined_group != kNoGroup;
    Group own = groups[cluster.group];
    Group refined = groups[has_refined ? cluster.refined_group : cluster.group];
    if (decideCluster(view, instance, state, cluster, own, refined, (item.flags & kItemDoubleSided) != 0u))
        return state.visible == kInstanceLate ? kOutcomeLateCandidate : kOutcomeCandidate;
    if (!clusterInCut(view, instance, own, has_refined, refined))
        return kOutcomeLod;
    if ((view.flags & kCullFrustum) != 0u &&
        boxOutsideFrustum(view, instance, clusterBoxMin(cluster, state.grid_step), clusterBoxMax(cluster, state.grid_step)))
        return kOutcomeFrustum;
    return kOutcomeCone;
}

void main()
{
    uint lane = gl_LocalInvocationIndex;
    uint group = gl_WorkGroupID.y * kDispatchRow + gl_WorkGroupID.x;
    if (lane < kOutcomeCount)
        cluster_counts[lane] = triangle_counts[lane] = 0u;
    barrier();
    if (group * 64u + lane < view.instance_count)
        countInstance(group * 64u + lane);
    if (group < item_count && lane < items[group].count)
    {
        Cluster cluster = clusters[order[items[group].first + lane]];
        uint outcome = outcomeOf(items[group], cluster);
        atomicAdd(cluster_counts[outcome], 1u);
        atomicAdd(triangle_counts[outcome], cluster.counts & 0xFFFFu);
    }
    barrier();
    if (lane < kOutcomeCount)
    {
        atomicAdd(statistics.clusters[lane], cluster_counts[lane]);
        uint before = atomicAdd(statistics.triangles_low[lane], triangle_counts[lane]);
        if (before + triangle_counts[lane] < before)
            atomicAdd(statistics.triangles_high[lane], 1u);
    }
}
