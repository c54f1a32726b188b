// Adds up every fragment that the visibility pass rasterises, occluded ones as well (overdraw view).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"

layout(location = 0) flat in uint in_id;
layout(location = 0) out vec4 out_color;

// The alpha is 1 already, so writing the id there does no harm. An output of the vertex shader that nothing
// reads is a warning.
void main() { out_color = vec4(kOverdrawStep, float(in_id)); }
