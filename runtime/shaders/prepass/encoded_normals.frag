// Stores the surfaces of a material, with their depth, for joined sums of light: normals.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_JOINED_SUMS
#define HEARTH_ENCODED_DEPTH
#include "runtime/shaders/prepass/normals.glsl"
