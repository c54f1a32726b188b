// Shades a material by sums of light and bricks: shading.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_GI
#define HEARTH_SUMMED_LIGHTS
#include "runtime/shaders/shade/shading.glsl"
#include "runtime/shaders/prepass/summed_lights.glsl"
