// Which pages of deformed instances the frame wants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/deformation.h"
#include "page_requests.glsl"
#define DEFORMATION_SET 0
#define DEFORMATION_BINDING 7
#include "deformation.glsl"

Group placedGroup(uint instance, uint group) { return groupInPose(groups[group], loadPose(poseRowOf(instance))); }

bool inFrustum(uint instance, uint cluster)
{
    Pose pose = loadPose(poseRowOf(instance));
    return deformedInFrustum(view, instances[instance],
                             boxInPose(instances[instance], pose, loadDeformedCluster(pose, cluster)));
}
