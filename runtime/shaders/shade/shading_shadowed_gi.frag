// Shades a material, with shadows of the lights and indirect light from bricks (GI): shading.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#define HEARTH_GI
#include "runtime/shaders/shade/shading.glsl"
