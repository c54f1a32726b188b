// Page requests of deformed instances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/deformation.h"
#include "runtime/shaders/cull/page_requests.glsl"
#define DEFORMATION_SET kSetTables
#define DEFORMATION_BINDING kTableDeformation
#include "runtime/shaders/scene/deformation.glsl"

Group transformedGroup(uint instance, uint group) { return groupInPose(groups[group], loadPose(readPoseRow(instance))); }

bool inFrustum(uint instance, uint cluster)
{
    Pose pose = loadPose(readPoseRow(instance));
    return deformedInFrustum(view, instances[instance],
                             boxInPose(instances[instance], pose, loadDeformedCluster(pose, cluster)));
}

TexelReach findReach(uint instance, uint cluster)
{
    Pose pose = loadPose(readPoseRow(instance));
    return deformedReach(view, instances[instance],
                         boxInPose(instances[instance], pose, loadDeformedCluster(pose, cluster)));
}
