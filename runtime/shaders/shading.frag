// Shades the pixels of one material: rebuilds the surface, samples the textures with exact derivatives, adds the
// lights and the sky. See runtime/gpu/README.md for units and exposure.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/shared/decisions.h"
#include "formats/shared/shading.h"
#include "scene.glsl"
#include "material.glsl"
#include "resolve.glsl"
#include "brdf.glsl"
#include "tonemap.glsl"

layout(input_attachment_index = 0, set = 2, binding = 0) uniform usubpassInput visibility;
layout(set = 0, binding = 9, std140) uniform LightingBlock { Lighting lighting; };
#include "sky.glsl"

layout(push_constant) uniform Push
{
    float depth;
    uint shown_view;
    float depth_scale; // metres that the depth view shows as half
};
layout(location = 0) out vec4 out_color;

// formats::LightType
const uint kLightDirectional = 0u;
const uint kLightSpot = 2u;

// A texture of the material at the surface, (1, 1, 1, 1) where there is none.
#define SAMPLE(slot, image) (hasTexture(slot) ? sampleSurface(s, slot, image) : vec4(1.0))

vec4 sampleSurface(Surface s, uint slot, sampler2D image)
{
    SurfaceUv at = surfaceUv(s, uvSetOf(slot));
    return textureGrad(image, transformUv(slot, at.uv), transformUvVector(slot, at.dx), transformUvVector(slot, at.dy));
}

vec3 shadingNormal(Surface s)
{
    vec3 normal = smoothNormal(s);
    if (hasTexture(kTextureNormal))
    {
        vec3 mapped = sampleSurface(s, kTextureNormal, normal_texture).xyz * 2.0 - 1.0;
        mapped.xy *= material.normal_scale;
        vec3 tangent, bitangent;
        tangentFrame(s, normal, uvSetOf(kTextureNormal), tangent, bitangent);
        normal = normalizeOr(tangent * mapped.x + bitangent * mapped.y + normal * mapped.z, normal);
    }
    return s.front ? normal : -normal;
}

// Irradiance of a light on a surface that faces it, and where it comes from. KHR_lights_punctual.
vec3 irradianceOf(Light light, vec3 position, out vec3 to_light)
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
    if (light.type == kLightSpot)
    {
        float cone = clamp(dot(light.direction, -to_light) * light.cone_scale + light.cone_offset, 0.0, 1.0);
        attenuation *= cone * cone;
    }
    return light.intensity * attenuation;
}

vec3 lit(Surface s, vec3 base, vec3 normal)
{
    vec4 metallic_roughness = SAMPLE(kTextureMetallicRoughness, metallic_roughness_texture);
    float metallic = clamp(material.metallic * metallic_roughness.b, 0.0, 1.0);
    Shading shading;
    // below 0.045 the highlight of a punctual light is smaller than half floats resolve
    shading.roughness = clamp(material.roughness * metallic_roughness.g, 0.045, 1.0);
    shading.diffuse = base * (1.0 - metallic);
    shading.f0 = mix(vec3(0.04), base, metallic);
    shading.normal = normal;
    shading.to_eye = normalizeOr(-s.position, normal);
    shading.n_dot_v = clamp(abs(dot(normal, shading.to_eye)), 1e-4, 1.0);

    vec3 radiance = vec3(0.0);
    for (uint i = 0u; i < lighting.light_count; ++i)
    {
        vec3 to_light;
        vec3 irradiance = irradianceOf(lighting.lights[i], s.position, to_light);
        radiance += irradiance * reflected(shading, to_light);
    }

    float occlusion = 1.0;
    if (hasTexture(kTextureOcclusion))
        occlusion = mix(1.0, sampleSurface(s, kTextureOcclusion, occlusion_texture).r, material.occlusion_strength);
    vec2 scale_bias = specularScaleBias(shading.roughness, shading.n_dot_v);
    vec3 specular = shading.f0 * scale_bias.x + scale_bias.y;
    vec3 mirror = reflect(-shading.to_eye, normal);
    radiance += occlusion * ((1.0 - specular) * shading.diffuse * skyIrradiance(normal) +
                             specular * skyRadiance(mirror, shading.roughness));
    return radiance + material.emissive * SAMPLE(kTextureEmissive, emissive_texture).rgb;
}

// A colour that differs much between neighbouring numbers.
vec3 colorOfNumber(uint number)
{
    uint h = number * 2654435761u; // Knuth's multiplicative hash
    h ^= h >> 15;
    h *= 2246822519u;
    h ^= h >> 13;
    return 0.25 + 0.75 * vec3(h & 255u, h >> 8 & 255u, h >> 16 & 255u) / 255.0;
}

vec3 colorOfLevel(uint level)
{
    // red where the source is drawn, over yellow, green and blue to violet at level 12 and coarser
    float hue = min(float(level), 12.0) / 12.0 * 0.8;
    return clamp(abs(fract(hue + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

void main()
{
    Surface s = resolveSurface(subpassLoad(visibility).x, gl_FragCoord.xy);
    // debug colours are dimmed by the angle to the eye, so that the shape can be seen
    float facing = 0.35 + 0.65 * abs(dot(geometricNormal(s), normalizeOr(s.position, vec3(0.0))));
    vec3 color;
    if (shown_view == kViewFinal)
    {
        vec3 base = material.base_color.rgb * surfaceColor(s).rgb * SAMPLE(kTextureBaseColor, base_color_texture).rgb;
        // unlit colours are display colours: no light, no tone mapping
        color = (material.flags & kMaterialUnlit) != 0u ? base : toneMap(lit(s, base, shadingNormal(s)));
    }
    else if (shown_view == kViewClusters)
        color = linearFromSrgb(facing * colorOfNumber(s.slot.cluster * 7919u + s.slot.instance));
    else if (shown_view == kViewLod)
        color = linearFromSrgb(facing * (0.15 + 0.85 * colorOfLevel(levelOf(s.draw))));
    else if (shown_view == kViewTriangles)
        color = linearFromSrgb(facing * colorOfNumber((s.slot.cluster * 128u + s.triangle) * 31u + s.slot.instance));
    else if (shown_view == kViewNormals)
        color = linearFromSrgb(shadingNormal(s) * 0.5 + 0.5);
    else
        color = linearFromSrgb(vec3(depth_scale / (depth_scale + s.distance_w)));
    out_color = vec4(color, 1.0);
}
