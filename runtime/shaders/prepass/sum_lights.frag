// Adds lists of lights to sums of light: sum_lights.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "runtime/shaders/prepass/sum_lights.glsl"
