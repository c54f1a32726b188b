// Adds up every fragment that the visibility pass rasterises, hidden ones as well.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"

layout(location = 0) flat in uint in_id;
layout(location = 0) out vec4 out_color;

// The id goes where it does no harm, the alpha is 1 already: that nobody reads what a vertex shader writes is a warning.
void main() { out_color = vec4(kOverdrawStep, float(in_id)); }
