// Adds the lights that every point gets, and those of each pixel's list, to stored surfaces. Shaders that
// include it define HEARTH_SHADOWED if lights cast shadows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/light/lit_scene.glsl"
#include "runtime/shaders/light/surface_lights.glsl"
#include "runtime/shaders/light/stored_surface.glsl"
#include "runtime/shaders/shade/light_list.glsl"

layout(location = 0) out vec4 out_radiance;

void main()
{
    PlacedSurface surface;
    if (!loadSurface(surface))
        discard;
    vec3 radiance = vec3(0.0);
    LightListing listing = findLights(surface.position, gl_FragCoord.xy, 0u);
    for (uint i = 0u; i < listing.count; ++i)
        radiance += lightRadiance(surface, lights[listedLight(listing, i)]);
    out_radiance = vec4(storedRadiance(radiance), 0.0);
}
