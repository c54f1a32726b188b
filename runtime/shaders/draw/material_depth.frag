// Turns the depth buffer into one of material numbers, so that the depth test limits the shading
// of each material to its pixels. B. Karis, R. Stubbe, G. Wihlidal, "A deep dive into Nanite", 2021.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"

void main()
{
    uint id = loadVisibility();
    uint material = id == kVisibilitySky ? 0u : cluster_draws[visible[id >> kTriangleBits].cluster].material;
    gl_FragDepth = float(material) * kMaterialDepthStep;
}
