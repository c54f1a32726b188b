// Culling statistics: outcomes of instances, and of the clusters of rigid instances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/decisions.h"
#include "runtime/shaders/cull/cull_statistics.glsl"

layout(set = kSetTables, binding = kTableClusters, std430) readonly buffer Clusters { Cluster clusters[]; };

uint clusterOutcome(WorkItem item, uint number)
{
    Cluster cluster = clusters[number];
    Instance instance = instances[item.instance];
    InstanceState state = states[item.instance];
    bool has_refined = cluster.refined_group != kNoGroup;
    Group own = groups[cluster.group];
    Group refined = groups[has_refined ? cluster.refined_group : cluster.group];
    if (decideCluster(view, instance, state, cluster, own, refined, (item.flags & kItemDoubleSided) != 0u))
        return kOutcomeCandidate;
    if (!clusterInCut(view, instance, own, has_refined, refined))
        return kOutcomeLod;
    return clusterInFrustum(view, instance, state, cluster) ? kOutcomeCone : kOutcomeFrustum;
}

uint clusterTriangles(WorkItem item, uint number) { return clusters[number].counts & 0xFFu; }
