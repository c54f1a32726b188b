// Shades a material but for the lights, and stores its surfaces, with shadows of the lights: shading.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#define HEARTH_STORES_SURFACES
#include "runtime/shaders/shade/shading.glsl"
