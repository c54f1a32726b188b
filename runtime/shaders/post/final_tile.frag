// Same as final.frag, of a frame that has not left the tile.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_ON_TILE
#include "runtime/shaders/post/final.glsl"

void main() { out_color = finished(subpassLoad(radiance).rgb, push.exposure); }
