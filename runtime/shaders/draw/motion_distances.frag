// Motion vectors and distances, for the temporal filter. One triangle over the image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#define HEARTH_DISTANCES
#include "runtime/shaders/draw/motion.glsl"
