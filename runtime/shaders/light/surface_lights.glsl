// Light of lamps and suns that stored surfaces reflect towards the eye. Include behind shadow.glsl or
// unshadowed.glsl, with stored_surface.glsl or prepass/stored_normal.glsl, which load the surface of a pixel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/reflector.h"
#include "formats/gpu_shared/specialization.h"
#include "runtime/shaders/scene/directions.glsl"
#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/scene/to_eye.glsl"
#include "runtime/shaders/shade/brdf.glsl"
#include "runtime/shaders/shade/light_irradiance.glsl"
#include "runtime/shaders/shade/stored_radiance.glsl"
#include "runtime/shaders/shade/lit_surface.glsl"

layout(constant_id = kConstantReflects) const bool kReflects = false;

vec3 reflectedShare(Light light, vec3 from_lamp) { return kReflects ? reflectorShare(light, from_lamp) : vec3(0.0); }

// Surface of a pixel with its place, ready to be lit.
struct PlacedSurface
{
    Shading shading;
    vec3 position; // relative to the eye
    vec3 flat_normal;
    float error;
    bool receives; // as LitSurface
};

PlacedSurface placedSurface(LitSurface surface, vec3 position)
{
    PlacedSurface placed;
    placed.position = position;
    placed.flat_normal = surface.flat_normal;
    placed.error = surface.error;
    placed.receives = surface.receives;
    placed.shading.roughness = surface.roughness;
    placed.shading.normal = surface.normal;
    placed.shading.to_eye = normalizeOr(toEye(placed.position), surface.normal);
    placed.shading.n_dot_v = clampedCosine(surface.normal, placed.shading.to_eye);
    placed.shading.lobe = lobeTotal(surface.roughness, placed.shading.n_dot_v);
    placed.shading.albedo = surfaceAlbedo(surface.base, surface.metallic, defaultDielectric(), placed.shading.lobe);
    return placed;
}

vec3 lightRadiance(PlacedSurface surface, Light light)
{
    if (surface.receives && isBaked(light))
        return vec3(0.0);
    vec3 to_light;
    vec3 irradiance = lightIrradiance(light, surface.position, to_light);
    float share = lightVisibility(light, surface.position, surface.flat_normal, surface.error);
    return irradiance * reflected(surface.shading, to_light) * share;
}
