// Adds a light to the stored surfaces in its volume: add_light_volume.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "runtime/shaders/light/add_light_volume.glsl"
