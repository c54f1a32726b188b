// Buffer of lights as the passes that list them see it: they read its head and its lights, and write its
// lists. Needs formats/gpu_shared/shading.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/light_cells.h"

#ifndef HEARTH_LIGHTS_SET
#define HEARTH_LIGHTS_SET kSetLights
#endif

// one buffer in three views
layout(set = HEARTH_LIGHTS_SET, binding = kLightsBuffer, std140) readonly buffer LightingBlock
{
    Lighting lighting;
    Light lights[];
};
layout(set = HEARTH_LIGHTS_SET, binding = kLightsBuffer, std430) buffer LightWords { uint light_words[]; };
layout(set = HEARTH_LIGHTS_SET, binding = kLightsBuffer, std430) buffer CellLights { CellLight cell_lights[]; };

uint lightCount(uint which) { return light_words[lighting.first_list_word + which]; }

// Ranged light of the frame.
CellLight lightInView(uint place) { return cell_lights[lighting.first_in_view + place]; }
