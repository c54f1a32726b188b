// Lists the lights of the slots of the visible list, in scenes without deformed meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "runtime/shaders/light/slot_lights.glsl"

LightBox slotBox(VisibleCluster slot)
{
    return rigidBox(slot);
}
