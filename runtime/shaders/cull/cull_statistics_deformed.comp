// Culling statistics: outcomes of the clusters of deformed instances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/deformation.h"
#include "runtime/shaders/cull/cull_statistics.glsl"
#define DEFORMATION_SET kSetTables
#define DEFORMATION_BINDING kTableDeformation
#include "runtime/shaders/scene/deformation.glsl"

uint clusterOutcome(WorkItem item, uint number)
{
    Instance instance = instances[item.instance];
    Pose pose = loadPose(readPoseRow(item.instance));
    DeformedCluster cluster = loadDeformedCluster(pose, number);
    uint refined = cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group;
    if (!deformedInCut(view, instance, pose, cluster, groups[cluster.group], groups[refined]))
        return kOutcomeLod;
    if (!deformedInFrustum(view, instance, boxInPose(instance, pose, cluster)))
        return kOutcomeFrustum;
    if ((item.flags & kItemDoubleSided) == 0u &&
        deformedFacesAway(view, instance, pose, loadJoint(pose, cluster.joint), cluster))
        return kOutcomeCone;
    return kOutcomeCandidate;
}

uint clusterTriangles(WorkItem item, uint number)
{
    return loadDeformedCluster(loadPose(readPoseRow(item.instance)), number).triangle_count;
}
