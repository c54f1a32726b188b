// Lights and sky of the frame. Needs formats/gpu_shared/shading.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"

layout(set = kSetScene, binding = kSceneLighting, std140) readonly buffer LightingBlock { Lighting lighting; };
