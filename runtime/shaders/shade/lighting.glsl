// Shades a surface point: its material under the lights and the sky. See runtime/gpu/README.md for units and
// exposure. Needs `lightVisibility` (shadowing of a light) from shadow.glsl or unshadowed.glsl, and
// `surroundingLight` (light of the environment) and `reflectedShare` from surrounding_sky.glsl or
// surrounding_bricks.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/specialization.h"

#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/scene/to_eye.glsl"
#include "runtime/shaders/shade/brdf.glsl"
#include "runtime/shaders/shade/layers.glsl"
#include "runtime/shaders/shade/light_irradiance.glsl"
#include "runtime/shaders/shade/light_list.glsl"
#include "runtime/shaders/shade/material_values.glsl"
#ifdef HEARTH_STORES_SURFACES
#include "runtime/shaders/shade/surface_words.glsl"
#endif
#include "runtime/shaders/shade/sky.glsl"
#include "runtime/shaders/shade/shaded_color.glsl"
#include "runtime/shaders/shade/sky_occlusion.glsl"

layout(constant_id = kConstantUnlit) const bool kUnlit = false;

// Radiance towards the eye from everything except the lights. occlusion: value of the material's occlusion
// texture.
vec3 surroundingLight(SurfacePoint point, Shading shading, Layers layers, mediump float occlusion);

#ifdef HEARTH_SUMMED_LIGHTS
// Radiance towards the eye from the lights, but for layers: prepass/summed_lights.glsl.
vec3 summedLight(Shading s);
#endif

#ifdef HEARTH_MARKED_LIGHTS
// Bits of the lights that may reach the pixel: stack/light_bits.glsl.
uvec2 loadLightBits();
#endif

// Radiance towards the eye from a light.
vec3 lightRadiance(uint row, SurfacePoint point, Shading shading, Layers layers)
{
    if (point.received.is_known && isBaked(lights[row]))
        return vec3(0.0);
    vec3 to_light;
    vec3 irradiance = lightIrradiance(lights[row], point.position, to_light);
    float share = lightVisibility(lights[row], point.position, point.flat_normal, point.error);
    return irradiance * layeredLight(shading, layers, to_light) * share;
}

// Radiance towards the eye from the lights.
vec3 directLight(SurfacePoint point, Shading shading, Layers layers)
{
    vec3 radiance = vec3(0.0);
    LightListing listing = findLights(point.position, gl_FragCoord.xy, point.slot);
#ifdef HEARTH_MARKED_LIGHTS
    // in the order of the frame: lights of every point, those of the bits, and those that have no bit
    for (uint i = 0u; i < listing.unranged_count; ++i)
        radiance += lightRadiance(frameLight(i), point, shading, layers);
    uvec2 marked = loadLightBits();
    for (uint word = 0u; word < 2u; ++word)
        for (uint bits = marked[word]; bits != 0u; bits &= bits - 1u)
        {
            uint place = listing.unranged_count + word * 32u + uint(findLSB(bits));
            radiance += lightRadiance(frameLight(place), point, shading, layers);
        }
    for (uint i = listing.unranged_count; i < listing.count; ++i)
    {
        uint place = listedPlace(listing, i);
        if (place >= listing.unranged_count + kMarkedLights)
            radiance += lightRadiance(frameLight(place), point, shading, layers);
    }
#else
    for (uint i = 0u; i < listing.count; ++i)
        radiance += lightRadiance(listedLight(listing, i), point, shading, layers);
#endif
    return radiance;
}

vec3 lit(SurfacePoint point, SurfaceUvs uvs, MaterialValues values)
{
    Shading shading;
    shading.roughness = values.roughness;
    shading.normal = values.normal;
    shading.to_eye = normalizeOr(toEye(point.position), values.normal);
    shading.n_dot_v = clampedCosine(values.normal, shading.to_eye);
    shading.lobe = lobeTotal(shading.roughness, shading.n_dot_v);
    shading.albedo = surfaceAlbedo(values.base_color, values.metallic, surfaceDielectric(uvs), shading.lobe);
    Layers layers = surfaceLayers(point, uvs, shading);

    vec3 radiance = vec3(0.0);
    // layers fit neither into what is stored nor into sums
#ifdef HEARTH_STORES_SURFACES
    if (kLayers == 0u)
        out_surface = packSurface(LitSurface(values.normal, point.flat_normal, values.base_color, values.metallic,
                                             shading.roughness, point.error, point.received.is_known));
    else
#endif
#ifdef HEARTH_SUMMED_LIGHTS
    if (kLayers == 0u)
        radiance = summedLight(shading);
    else
#endif
        radiance = directLight(point, shading, layers);

    radiance += surroundingLight(point, shading, layers, values.occlusion);
    vec3 emission = values.emission * point.received.emission_weight;
    return radiance + belowCoat(layers) * lighting.exposure * emission;
}

// Colour to write: shaded_color.glsl. Unlit colours are display colours: no light, no tone mapping.
vec3 displayColor(SurfacePoint point, SurfaceUvs uvs)
{
    mediump vec3 factor = material.base_color.rgb;
    MaterialValues values = materialValues(point, uvs, factor * point.color);
    return kUnlit ? shadedUnlit(values.base_color) : shadedColor(lit(point, uvs, values));
}
