// Fetches each texel of a texture into a buffer, rows from top to bottom.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1, std430) writeonly buffer Texels { vec4 texels[]; };

void main()
{
    ivec2 size = textureSize(image, 0);
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x < size.x && at.y < size.y)
        texels[at.y * size.x + at.x] = texelFetch(image, at, 0);
}
