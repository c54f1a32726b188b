// Buffer of lights as the passes that list them see it: they read its head and its lights, and write its
// lists. Needs formats/gpu_shared/shading.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/light_cells.h"

layout(set = kSetLights, binding = kLightsBuffer, std140) readonly buffer LightingBlock
{
    Lighting lighting;
    Light lights[];
};
layout(set = kSetLights, binding = kLightsBuffer, std430) buffer LightWords { uint light_words[]; };
layout(set = kSetLights, binding = kLightsInView, std430) buffer LightsInView { CellLight lights_in_view[]; };

uint lightCount(uint which) { return light_words[lighting.first_list_word + which]; }
