// Adds lists of lights to stored surfaces: add_lights.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "runtime/shaders/light/add_lights.glsl"
