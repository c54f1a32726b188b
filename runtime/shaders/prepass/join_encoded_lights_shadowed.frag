// Adds lists of lights with shadows to joined sums, of surfaces stored with their depth: sum_lights.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#define HEARTH_JOINED_SUMS
#define HEARTH_ENCODED_DEPTH
#include "runtime/shaders/prepass/sum_lights.glsl"
