// Sums of light at a pixel, which materials weigh: Schlick's Fresnel term is linear in the reflectance of a
// surface, so that two sums of specular light carry all of it. Include behind surface_lights.glsl. Shaders
// that include it define HEARTH_JOINED_SUMS for the luminance of specular light alone, in the same image as
// the diffuse light: W. Engel, "Light pre-pass", 2009.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/prepass/specular_luminance.glsl"

struct LightSums
{
    vec3 diffuse; // irradiance
    vec3 specular; // irradiance times the lobe, without the share of the next one
    vec3 grazing; // its share by Schlick's term
};

layout(location = 0) out vec4 out_diffuse;
#ifndef HEARTH_JOINED_SUMS
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec4 out_grazing;
#endif

void addLight(inout LightSums sums, PlacedSurface surface, Light light)
{
    if (surface.receives && isBaked(light))
        return;
    Shading s = surface.shading;
    vec3 to_light;
    vec3 irradiance = lightIrradiance(light, surface.position, to_light);
    float n_dot_l = dot(s.normal, to_light);
    if (n_dot_l <= 0.0)
        return;
    irradiance *= n_dot_l * lightVisibility(light, surface.position, surface.flat_normal, surface.error);
    vec3 half_vector = normalize(to_light + s.to_eye);
    float n_dot_h = clamp(dot(s.normal, half_vector), 0.0, 1.0);
    float v_dot_h = clamp(dot(s.to_eye, half_vector), 0.0, 1.0);
    float lobe = ggxLobe(s.roughness, n_dot_h, n_dot_l, s.n_dot_v);
    float share = schlickShare(v_dot_h);
    sums.diffuse += irradiance;
    sums.specular += irradiance * (lobe * (1.0 - share));
    sums.grazing += irradiance * (lobe * share);
}

void writeSums(LightSums sums)
{
#ifdef HEARTH_JOINED_SUMS
    vec3 specular = storedRadiance(sums.specular + sums.grazing);
    out_diffuse = vec4(storedRadiance(sums.diffuse), specularLuminance(specular));
#else
    out_diffuse = vec4(storedRadiance(sums.diffuse), 0.0);
    out_specular = vec4(storedRadiance(sums.specular), 0.0);
    out_grazing = vec4(storedRadiance(sums.grazing), 0.0);
#endif
}
