// Lists the lights of the slots of the visible list, in scenes with deformed meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/deformation.h"
#include "runtime/shaders/light/slot_lights.glsl"
#define DEFORMATION_SET kSetTables
#define DEFORMATION_BINDING kTableDeformation
#include "runtime/shaders/scene/deformation.glsl"

LightBox slotBox(VisibleCluster slot)
{
    uint row = readPoseRow(slot.instance);
    if (row == 0u)
        return rigidBox(slot);
    Instance instance = instances[slot.instance];
    Pose pose = loadPose(row);
    TransformedBox posed = boxInPose(instance, pose, loadDeformedCluster(pose, slot.cluster));
    return lightBox(lighting.grid, posed.joint_instance, viewFromOrigin(view, instance).eye, posed.box_min, posed.box_max);
}
