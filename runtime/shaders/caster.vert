// Draws the casters of a shadow map: depth alone.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/shadow.h"
#include "scene.glsl"
#include "caster.glsl"

void main() { gl_Position = casterCorner().position; }
