// Stores the surfaces of a material for exact sums of light: normals.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "runtime/shaders/prepass/normals.glsl"
