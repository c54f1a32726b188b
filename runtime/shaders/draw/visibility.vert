// Draws every cluster of a bin: one instance per cluster, three vertices per triangle, pulled from the
// geometry pool.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/draw/visibility.glsl"

layout(location = 0) flat out uint out_id;

void main()
{
    VisibleCorner corner = visibleCorner();
    gl_Position = corner.position;
    out_id = corner.id;
}
