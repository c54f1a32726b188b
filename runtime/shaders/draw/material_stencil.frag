// Marks the pixels whose material's number has a bit set: one draw for each bit writes the number into the
// stencil, of which a pipeline can write no value of its own for each pixel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "runtime/shaders/scene/shading_push.glsl"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"


void main()
{
    uint id = loadVisibility();
    uint material = id == kVisibilitySky ? 0u : cluster_draws[visible[id >> kTriangleBits].cluster].material;
    if ((material >> push.material & 1u) == 0u)
        discard;
}
