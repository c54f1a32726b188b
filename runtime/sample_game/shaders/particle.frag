// Shades a particle: a disc that fades to its edge.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450

layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 shade;

layout(location = 0) out vec4 color;

void main()
{
    float fade = max(0.0, 1.0 - dot(corner, corner));
    color = shade * fade * fade;
}
