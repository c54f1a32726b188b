// Shades a material, with shadows of the lights: shading.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#include "runtime/shaders/shade/shading.glsl"
