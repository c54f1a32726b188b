// Adds a light to joined sums of light, of surfaces stored with their depth: sum_light_volume.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_JOINED_SUMS
#define HEARTH_ENCODED_DEPTH
#include "runtime/shaders/prepass/sum_light_volume.glsl"
