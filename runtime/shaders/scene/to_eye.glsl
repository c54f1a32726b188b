// Needs `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_TO_EYE_GLSL
#define HEARTH_TO_EYE_GLSL

#include "formats/gpu_shared/decisions.h"

// Vector from a point, relative to the eye, back to where its ray begins: the eye, or the plane across it.
vec3 toEye(vec3 position)
{
    vec3 along = view.clip_w.xyz * -dot(view.clip_w.xyz, position);
    return mix(-position, along, bvec3(isOrthographic(view))); // selects, as clipPosition
}

#endif
