// Shades a material but for the lights, and stores its surfaces, with shadows of the lights and light from
// bricks (GI): shading.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#define HEARTH_GI
#define HEARTH_STORES_SURFACES
#include "runtime/shaders/shade/shading.glsl"
