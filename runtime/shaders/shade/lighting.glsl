// Shades a surface point: its material under the lights and the sky. See runtime/gpu/README.md for units and
// exposure. Needs `lightVisibility` (shadowing of a light) from shadow.glsl or unshadowed.glsl, and
// `surroundingLight` (light of the environment) and `reflectedShare` from surrounding_sky.glsl or
// surrounding_bricks.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/specialization.h"

#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/shade/brdf.glsl"
#include "runtime/shaders/shade/layers.glsl"
#include "runtime/shaders/shade/light_irradiance.glsl"
#include "runtime/shaders/shade/light_list.glsl"
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

// Radiance towards the eye from the lights.
vec3 directLight(SurfacePoint point, Shading shading, Layers layers)
{
    vec3 radiance = vec3(0.0);
    LightListing listing = findLights(point.position, gl_FragCoord.xy, point.slot);
    for (uint i = 0u; i < listing.count; ++i)
    {
        uint row = listedLight(listing, i);
        vec3 to_light;
        vec3 irradiance = lightIrradiance(lights[row], point.position, to_light);
        float share = lightVisibility(lights[row], point.position, point.flat_normal, point.error);
        radiance += irradiance * layeredLight(shading, layers, to_light) * share;
    }
    return radiance;
}

vec3 lit(SurfacePoint point, SurfaceUvs uvs, mediump vec3 base)
{
    vec3 normal = shadingNormal(point, uvs);
    vec4 metallic_roughness = sampleSurface(uvs, kTextureMetallicRoughness, metallic_roughness_texture);
    mediump float metallic_factor = material.metallic;
    mediump float metallic = clamp(metallic_factor * metallic_roughness.b, 0.0, 1.0);
    Shading shading;
    shading.roughness = surfaceRoughness(metallic_roughness);
    shading.normal = normal;
    shading.to_eye = normalizeOr(-point.position, normal);
    shading.n_dot_v = clampedCosine(normal, shading.to_eye);
    shading.lobe = lobeTotal(shading.roughness, shading.n_dot_v);
    shading.albedo = surfaceAlbedo(base, metallic, surfaceDielectric(uvs), shading.lobe);
    Layers layers = surfaceLayers(point, uvs, shading);

    vec3 radiance = vec3(0.0);
#ifdef HEARTH_STORES_SURFACES
    // layers do not fit into what is stored
    if (kLayers == 0u)
        out_surface = packSurface(LitSurface(normal, point.flat_normal, base, metallic, shading.roughness, point.error));
    else
#endif
        radiance = directLight(point, shading, layers);

    mediump float occlusion_strength = material.occlusion_strength;
    mediump float occlusion = mix(1.0, sampleSurface(uvs, kTextureOcclusion, occlusion_texture).r, occlusion_strength);
    radiance += surroundingLight(point, shading, layers, occlusion);
    vec3 emission = material.emissive * sampleSurface(uvs, kTextureEmissive, emissive_texture).rgb;
    return radiance + belowCoat(layers) * lighting.exposure * emission;
}

// Colour to write: shaded_color.glsl. Unlit colours are display colours: no light, no tone mapping.
vec3 displayColor(SurfacePoint point, SurfaceUvs uvs)
{
    mediump vec3 factor = material.base_color.rgb;
    mediump vec3 base = factor * point.color * sampleSurface(uvs, kTextureBaseColor, base_color_texture).rgb;
    return kUnlit ? shadedUnlit(base) : shadedColor(lit(point, uvs, base));
}
