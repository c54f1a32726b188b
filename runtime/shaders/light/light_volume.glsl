// Draws the volume of a ranged light of the frame. The draw's instance is the light's place in the list of
// the frame; places behind the list draw nothing. Shaders that include it define HEARTH_NAMES_PLACE if the
// fragments need that place.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/light_volume.h"

layout(set = kSetScene, binding = kSceneFrame, std140) uniform Frame { FrameView view; };
#include "runtime/shaders/scene/light_block.glsl"

layout(location = 0) flat out uint light_row;
#ifdef HEARTH_NAMES_PLACE
layout(location = 1) flat out uint light_place;
#endif

void main()
{
    uint unranged = light_words[lighting.first_list_word + kCountUnranged];
    uint ranged = light_words[lighting.first_list_word + kCountRanged];
    light_row = 0u;
#ifdef HEARTH_NAMES_PLACE
    light_place = uint(gl_InstanceIndex);
#endif
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
    if (uint(gl_InstanceIndex) >= ranged)
        return;
    light_row = light_words[lighting.first_list_word + kLightCountWords + unranged + uint(gl_InstanceIndex)];
    vec3 corner = lightVolumeCorner(makeCellLight(lighting.grid, lights[light_row]), uint(gl_VertexIndex));
    vec3 position = lighting.grid.right * corner.x + lighting.grid.down * corner.y + lighting.grid.forward * corner.z;
    gl_Position = clipPosition(view, position);
}
