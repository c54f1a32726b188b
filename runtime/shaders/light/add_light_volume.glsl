// Adds one light to the stored surfaces within its volume. Shaders that include it define HEARTH_SHADOWED if
// lights cast shadows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/light/lit_scene.glsl"
#include "runtime/shaders/light/surface_lights.glsl"

// marks are taken away from pixels without a surface as well
layout(early_fragment_tests) in;
layout(location = 0) flat in uint light_row;
layout(location = 0) out vec4 out_radiance;

void main()
{
    uvec4 words = loadSurface();
    if (words == kNoSurface)
        discard;
    out_radiance = vec4(storedRadiance(lightRadiance(placedSurface(words), lights[light_row])), 0.0);
}
