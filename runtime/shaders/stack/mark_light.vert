// Draws the volume of a light that has a bit: light_volume.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_NAMES_PLACE
#include "runtime/shaders/light/light_volume.glsl"
