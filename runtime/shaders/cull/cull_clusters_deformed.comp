// Cluster culling of deformed instances: LOD cut, frustum and occlusion.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/deformation.h"
#include "runtime/shaders/cull/cull_clusters.glsl"
#define DEFORMATION_SET kSetTables
#define DEFORMATION_BINDING kTableDeformation
#include "runtime/shaders/scene/deformation.glsl"

bool passesTests(WorkItem item, uint number)
{
    Instance instance = instances[item.instance];
    Pose pose = loadPose(readPoseRow(item.instance));
    DeformedCluster cluster = loadDeformedCluster(pose, number);
    uint refined = cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group;
    if (!deformedInCut(view, instance, pose, cluster, groups[cluster.group], groups[refined]))
        return false;
    if (!deformedInFrustum(view, instance, boxInPose(instance, pose, cluster)))
        return false;
    return (item.flags & kItemDoubleSided) != 0u ||
           !deformedFacesAway(view, instance, pose, loadJoint(pose, cluster.joint), cluster);
}

bool isOccluded(OcclusionView seen_from, WorkItem item, uint number)
{
    Instance instance = instances[item.instance];
    Pose pose = loadPose(readPoseRow(item.instance));
    TransformedBox box = boxInPose(instance, pose, loadDeformedCluster(pose, number));
    return isHidden(occlusionFromOrigin(seen_from, instance), box.joint_instance, box.box_min, box.box_max);
}
