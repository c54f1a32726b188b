// One triangle that covers the screen at a given depth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450

layout(push_constant) uniform Push { float depth; };

void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, depth, 1.0); }
