// Adds a light to the stored surfaces in its volume, with shadows: add_light_volume.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_SHADOWED
#include "runtime/shaders/light/add_light_volume.glsl"
