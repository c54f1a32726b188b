// Shades a material by bits of lights: shading.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_MARKED_LIGHTS
#include "runtime/shaders/shade/shading.glsl"
#include "runtime/shaders/stack/light_bits.glsl"
