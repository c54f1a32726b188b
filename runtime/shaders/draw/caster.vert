// Draws the casters of a shadow map, depth only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shadow.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/draw/caster.glsl"

void main() { gl_Position = casterCorner().position; }
