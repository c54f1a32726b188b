// Push constants of the material marks, of shading and of debug views.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHADING_PUSH_GLSL
#define HEARTH_SHADING_PUSH_GLSL

#include "formats/gpu_shared/push_constants.h"

layout(push_constant) uniform Push { ShadingPush push; };

#endif
