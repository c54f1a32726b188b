// Culling statistics, shared by the passes over rigid and over deformed instances. Runs after a frame and
// counts the reasons why each instance and each cluster was drawn or culled. One workgroup per work item, one
// thread per cluster, as in cull_clusters.glsl; thread i also counts instance i.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/cull_statistics.h"
#include "formats/gpu_shared/push_constants.h"

layout(local_size_x = kWorkItemClusters) in;

layout(set = kSetTables, binding = kTableFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableStates, std430) readonly buffer States { InstanceState states[]; };
layout(set = kSetTables, binding = kTableBounds, std430) readonly buffer Bounds { MeshBounds bounds[]; };
layout(set = kSetTables, binding = kTableItems, std430) readonly buffer Items { WorkItem items[]; };
layout(set = kSetTables, binding = kTableOrder, std430) readonly buffer Order { uint order[]; };
layout(set = kSetTables, binding = kTableGroups, std430) readonly buffer Groups { Group groups[]; };
layout(set = kSetTables, binding = kTableStatistics, std430) buffer Statistics { CullStatistics statistics; };
layout(push_constant) uniform Push { CullStatisticsPush push; };

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

// Return kOutcomeCandidate, or the test that culled a cluster. The instance of the cluster has passed
// instance culling.
uint clusterOutcome(WorkItem item, uint cluster);
uint clusterTriangles(WorkItem item, uint cluster);

uint instanceOutcome(WorkItem item, uint cluster)
{
    uint seen = states[item.instance].visible;
    if (seen == kInstanceHidden)
        return kOutcomeInstance;
    uint outcome = clusterOutcome(item, cluster);
    return outcome == kOutcomeCandidate && seen == kInstanceLate ? kOutcomeLateCandidate : outcome;
}

void main()
{
    uint lane = gl_LocalInvocationIndex;
    uint group = gl_WorkGroupID.y * kMaxDispatchX + gl_WorkGroupID.x;
    if (lane < kOutcomeCount)
        cluster_counts[lane] = triangle_counts[lane] = 0u;
    barrier();
    if (group * kWorkItemClusters + lane < push.instance_count)
        countInstance(group * kWorkItemClusters + lane);
    if (group < push.item_count && lane < items[push.first_item + group].count)
    {
        WorkItem item = items[push.first_item + group];
        uint cluster = order[item.first + lane];
        uint outcome = instanceOutcome(item, cluster);
        atomicAdd(cluster_counts[outcome], 1u);
        atomicAdd(triangle_counts[outcome], clusterTriangles(item, cluster));
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
