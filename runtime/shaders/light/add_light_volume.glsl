// Adds one light to the stored surfaces within its volume. Shaders that include it define HEARTH_SHADOWED if
// lights cast shadows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/light/lit_scene.glsl"
#include "runtime/shaders/light/surface_lights.glsl"
#include "runtime/shaders/light/stored_surface.glsl"

// marks are taken away from pixels without a surface as well
layout(early_fragment_tests) in;
layout(location = 0) flat in uint light_row;
layout(location = 0) out vec4 out_radiance;

void main()
{
    PlacedSurface surface;
    if (!loadSurface(surface))
        discard;
    out_radiance = vec4(storedRadiance(lightRadiance(surface, lights[light_row])), 0.0);
}
