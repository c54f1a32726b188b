// Cluster culling of rigid instances: LOD cut, frustum, normal cone and occlusion.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/occlusion.h"
#include "runtime/shaders/cull/cull_clusters.glsl"

layout(set = kSetTables, binding = kTableClusters, std430) readonly buffer Clusters { Cluster clusters[]; };

bool passesTests(WorkItem item, uint number)
{
    Cluster cluster = clusters[number];
    uint refined = cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group;
    return decideCluster(view, instances[item.instance], states[item.instance], cluster, groups[cluster.group],
                         groups[refined], (item.flags & kItemDoubleSided) != 0u);
}

bool isOccluded(OcclusionView seen_from, WorkItem item, uint number)
{
    Cluster cluster = clusters[number];
    float grid_step = states[item.instance].grid_step;
    return isHidden(seen_from, instances[item.instance], clusterBoxMin(cluster, grid_step),
                    clusterBoxMax(cluster, grid_step));
}
