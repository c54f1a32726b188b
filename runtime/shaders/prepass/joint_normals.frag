// Stores the surfaces of a material for joined sums of light: normals.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_JOINED_SUMS
#include "runtime/shaders/prepass/normals.glsl"
