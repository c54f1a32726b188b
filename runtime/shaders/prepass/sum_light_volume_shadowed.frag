// Adds a light to sums of light, with shadows: sum_light_volume.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#include "runtime/shaders/prepass/sum_light_volume.glsl"
