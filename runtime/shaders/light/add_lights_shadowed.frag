// Adds lists of lights to stored surfaces, with shadows: add_lights.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#include "runtime/shaders/light/add_lights.glsl"
