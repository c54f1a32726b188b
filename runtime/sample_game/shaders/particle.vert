// Turns each particle into a square that faces the eye.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450

layout(push_constant) uniform View
{
    mat4 clip_from_world;
    vec4 right, up; // of the camera, unit
};

layout(location = 0) in vec4 center_size; // world, metres
layout(location = 1) in vec4 color;       // linear, premultiplied; alpha 0 adds light, 1 covers

layout(location = 0) out vec2 corner; // -1 to 1
layout(location = 1) out vec4 shade;

void main()
{
    corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
    shade = color;
    vec3 offset = (corner.x * right.xyz + corner.y * up.xyz) * center_size.w;
    gl_Position = clip_from_world * vec4(center_size.xyz + offset, 1.0);
}
