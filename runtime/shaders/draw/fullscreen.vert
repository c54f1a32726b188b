// One triangle that covers the screen at a given depth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/push_constants.h"

layout(push_constant) uniform Push { ShadingPush push; };

void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, push.depth, 1.0); }
