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
#include "runtime/shaders/shade/sky.glsl"
#include "runtime/shaders/shade/tonemap.glsl"
#include "runtime/shaders/shade/sky_occlusion.glsl"

layout(constant_id = kConstantUnlit) const bool kUnlit = false;

// Intensity that what surrounds a lamp adds to the lamp's, as a share. from_lamp: unit.
vec3 reflectedShare(Light light, vec3 from_lamp);

// Irradiance of a light on a surface that faces it, and the direction to the light. KHR_lights_punctual.
vec3 lightIrradiance(Light light, vec3 position, out vec3 to_light)
{
    if (light.type == kLightDirectional)
    {
        to_light = -light.direction;
        return light.intensity;
    }
    vec3 offset = (light.position - view.eye) - position;
    float distance2 = max(dot(offset, offset), 1e-8);
    to_light = offset * inversesqrt(distance2);
    float attenuation = 1.0 / distance2;
    if (light.range > 0.0)
    {
        float ratio2 = distance2 / (light.range * light.range);
        attenuation *= clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
    }
    vec3 share = vec3(1.0);
    if (light.type == kLightSpot)
    {
        mediump float cone = clamp(dot(light.direction, -to_light) * light.cone_scale + light.cone_offset, 0.0, 1.0);
        share = vec3(cone * cone);
    }
    share += reflectedShare(light, -to_light);
    return light.intensity * share * attenuation;
}

// Radiance towards the eye from everything except the lights. occlusion: value of the material's occlusion
// texture.
vec3 surroundingLight(SurfacePoint point, Shading shading, Layers layers, mediump float occlusion);

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
    for (uint i = 0u; i < lighting.light_count; ++i)
    {
        vec3 to_light;
        vec3 irradiance = lightIrradiance(lighting.lights[i], point.position, to_light);
        float share = lightVisibility(lighting.lights[i], point.position, point.flat_normal, point.error);
        radiance += irradiance * layeredLight(shading, layers, to_light) * share;
    }

    mediump float occlusion_strength = material.occlusion_strength;
    mediump float occlusion = mix(1.0, sampleSurface(uvs, kTextureOcclusion, occlusion_texture).r, occlusion_strength);
    radiance += surroundingLight(point, shading, layers, occlusion);
    vec3 emission = material.emissive * sampleSurface(uvs, kTextureEmissive, emissive_texture).rgb;
    return radiance + belowCoat(layers) * lighting.exposure * emission;
}

// Display-linear colour. Unlit colours are display colours: no light, no tone mapping.
vec3 displayColor(SurfacePoint point, SurfaceUvs uvs)
{
    mediump vec3 factor = material.base_color.rgb;
    mediump vec3 base = factor * point.color * sampleSurface(uvs, kTextureBaseColor, base_color_texture).rgb;
    return kUnlit ? base : toneMap(lit(point, uvs, base));
}
