// Draws the background of frames that light stored surfaces: background.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_STORES_SURFACES
#include "runtime/shaders/shade/background.glsl"
