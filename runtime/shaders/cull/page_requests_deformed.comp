// Page requests of deformed instances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/deformation.h"
#include "runtime/shaders/cull/page_requests.glsl"
#define DEFORMATION_SET 0
#define DEFORMATION_BINDING 7
#include "runtime/shaders/scene/deformation.glsl"

Group placedGroup(uint instance, uint group) { return groupInPose(groups[group], loadPose(poseRowOf(instance))); }

bool inFrustum(uint instance, uint cluster)
{
    Pose pose = loadPose(poseRowOf(instance));
    return deformedInFrustum(view, instances[instance],
                             boxInPose(instances[instance], pose, loadDeformedCluster(pose, cluster)));
}
