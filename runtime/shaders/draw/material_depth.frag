// Turns the visibility buffer into a depth buffer of material numbers, so that each material's shading runs exactly
// where it is seen, by the depth test. B. Karis, R. Stubbe, G. Wihlidal, "A deep dive into Nanite", 2021.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "runtime/shaders/scene/scene.glsl"

layout(input_attachment_index = 0, set = 2, binding = 0) uniform usubpassInput visibility;

void main()
{
    uint id = subpassLoad(visibility).x;
    uint material = id == kNothingVisible ? 0u : cluster_draws[visible[id >> kTriangleBits].cluster].material;
    gl_FragDepth = float(material) / 65535.0; // exact in D16
}
