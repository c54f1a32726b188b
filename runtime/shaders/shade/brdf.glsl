// The metallic-roughness BRDF of glTF 2.0, appendix B, with energy compensation: the lobe of several
// scatterings, and a diffuse part that gets the light the specular part leaves
// (formats/gpu_shared/reflectance.h). GGX: B. Walter et al., 2007; height-correlated Smith: E. Heitz, 2014;
// Fresnel: C. Schlick, 1994.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/reflectance.h"
#include "runtime/shaders/shade/shading_tables.glsl"

const float kPi = 3.14159265358979;

struct Shading
{
    SurfaceAlbedo albedo;
    LobeTotal lobe;
    float roughness; // perceptual
    vec3 normal;
    vec3 to_eye;
    float n_dot_v;
};

// Texel (cosine, roughness) of a table: the values of LobeTotal or SheenTotal.
// first  column of the first node of the table, plus one half
mediump vec4 reflectanceTexel(mediump vec2 coordinates, float first)
{
    const mediump vec2 nodes = vec2(kReflectanceColumns, kReflectanceRows);
    vec2 at = (coordinates * (nodes - 1.0) + vec2(first, 0.5)) / kShadingTablesSize;
    return textureLod(shading_tables, at, 0.0); // one mip
}

LobeTotal lobeTotal(mediump float roughness, mediump float n_dot_v)
{
    mediump vec4 texel = reflectanceTexel(reflectanceCoordinates(roughness, n_dot_v), 0.5);
    return LobeTotal(texel.r, texel.g, texel.b, texel.a);
}

// Share of the reflectance at grazing angles in Schlick's term.
mediump float schlickShare(mediump float v_dot_h)
{
    mediump float x = 1.0 - v_dot_h;
    mediump float x2 = x * x;
    return x2 * x2 * x;
}

mediump vec3 fresnelSchlick(mediump vec3 f0, mediump float f90, mediump float v_dot_h)
{
    return f0 + (f90 - f0) * schlickShare(v_dot_h);
}

// GGX lobe without the Fresnel term: distribution times visibility.
float ggxLobe(float roughness, float n_dot_h, float n_dot_l, float n_dot_v)
{
    float alpha = roughness * roughness;
    float alpha2 = alpha * alpha;
    float d = (n_dot_h * alpha2 - n_dot_h) * n_dot_h + 1.0;
    float distribution = alpha2 / (kPi * d * d);
    float visibility = 0.5 / (n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - alpha2) + alpha2) +
                              n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2));
    return distribution * visibility;
}

// Radiance towards the eye per irradiance from `to_light`, cosine included.
vec3 reflected(Shading s, vec3 to_light)
{
    float n_dot_l = dot(s.normal, to_light);
    if (n_dot_l <= 0.0)
        return vec3(0.0);
    vec3 half_vector = normalize(to_light + s.to_eye);
    float n_dot_h = clamp(dot(s.normal, half_vector), 0.0, 1.0);
    float v_dot_h = clamp(dot(s.to_eye, half_vector), 0.0, 1.0);
    mediump vec3 fresnel = fresnelSchlick(s.albedo.f0, s.albedo.f90, v_dot_h);
    float lobe = ggxLobe(s.roughness, n_dot_h, n_dot_l, s.n_dot_v);
    return (s.albedo.diffuse / kPi + s.albedo.scattering * fresnel * lobe) * n_dot_l;
}
