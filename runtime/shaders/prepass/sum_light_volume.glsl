// Adds one light to the sums of light of the pixels within its volume. Shaders that include it define
// HEARTH_SHADOWED if lights cast shadows, and what light_sums.glsl says.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/light/lit_scene.glsl"
#include "runtime/shaders/light/surface_lights.glsl"
#include "runtime/shaders/prepass/stored_normal.glsl"
#include "runtime/shaders/prepass/light_sums.glsl"

// marks are taken away from pixels without a surface as well
layout(early_fragment_tests) in;
layout(location = 0) flat in uint light_row;

void main()
{
    PlacedSurface surface;
    if (!loadSurface(surface))
        discard;
    LightSums sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0));
    addLight(sums, surface, lights[light_row]);
    writeSums(sums);
}
