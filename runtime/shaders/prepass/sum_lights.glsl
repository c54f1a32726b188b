// Adds the lights that every point gets, and those of each pixel's list, to the sums of its light. Shaders
// that include it define HEARTH_SHADOWED if lights cast shadows, and what light_sums.glsl says.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/light/lit_scene.glsl"
#include "runtime/shaders/light/surface_lights.glsl"
#include "runtime/shaders/prepass/stored_normal.glsl"
#include "runtime/shaders/shade/light_list.glsl"
#include "runtime/shaders/prepass/light_sums.glsl"

void main()
{
    PlacedSurface surface;
    if (!loadSurface(surface))
        discard;
    LightSums sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0));
    LightListing listing = findLights(surface.position, gl_FragCoord.xy, 0u);
    for (uint i = 0u; i < listing.count; ++i)
        addLight(sums, surface, lights[listedLight(listing, i)]);
    writeSums(sums);
}
