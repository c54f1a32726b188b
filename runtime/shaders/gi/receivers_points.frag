// Stores the light of a texel of receivers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450

layout(location = 0) flat in uint word;
layout(location = 0) out uint texel;

void main()
{
    texel = word;
}
