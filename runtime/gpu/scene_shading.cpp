// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene_shading.h"

#include "runtime/gpu/scene_boxes.h"
#include "runtime/gpu/shadow_plan.h"

#include <algorithm>
#include <cmath>

namespace hearth::gpu
{

namespace
{

Float3 translationOf(const Affine3& t)
{
    return {t.m[0][3], t.m[1][3], t.m[2][3]};
}

/// The sun of scenes without lights.
shared::Light defaultSun()
{
    shared::Light sun{};
    sun.type = static_cast<uint32_t>(formats::LightType::directional);
    sun.direction = normalizeOr(shared::kSunDirection, {0, -1, 0});
    sun.intensity = shared::kSunIlluminance;
    return sun;
}

float luminance(Float3 c)
{
    return dot(c, {0.2126f, 0.7152f, 0.0722f});
}

/// Estimated illuminance in the middle of the scene. A lamp counts from no nearer than a quarter of the scene's
/// radius: what matters is what it does to most of the picture, not to the shade around its own bulb.
float illuminanceAt(const Box3& bounds, const shared::Light& light)
{
    if (light.type == static_cast<uint32_t>(formats::LightType::directional))
        return luminance(light.intensity);
    const float radius = bounds.empty() ? 1.0f : 0.5f * length(bounds.max - bounds.min);
    const Float3 center = bounds.empty() ? Float3{} : bounds.center();
    const float distance = std::max(length(light.position - center), std::max(0.25f * radius, 1e-3f));
    return luminance(light.intensity) / (distance * distance);
}

} // namespace

std::array<formats::TextureRef, shared::kTextureCount> texturesOf(const formats::MaterialRecord& material)
{
    return {material.base_color_texture, material.metallic_roughness_texture, material.normal_texture,
            material.occlusion_texture, material.emissive_texture};
}

formats::MaterialRecord defaultMaterial()
{
    formats::MaterialRecord material{};
    material.base_color = {1, 1, 1, 1};
    material.alpha_cutoff = 0.5f;
    material.metallic = 1;
    material.roughness = 1;
    material.normal_scale = 1;
    material.occlusion_strength = 1;
    for (formats::TextureRef* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture})
        texture->image = formats::kNone;
    return material;
}

shared::Material makeMaterial(const formats::MaterialRecord& record)
{
    shared::Material material{};
    material.base_color = record.base_color;
    material.emissive = record.emissive;
    material.alpha_cutoff = record.alpha_cutoff;
    material.metallic = record.metallic;
    material.roughness = record.roughness;
    material.normal_scale = record.normal_scale;
    material.occlusion_strength = record.occlusion_strength;
    material.flags = record.flags;
    material.alpha_mode = record.alpha_mode;
    const auto textures = texturesOf(record);
    for (uint32_t slot = 0; slot < shared::kTextureCount; ++slot)
    {
        const formats::TextureRef& texture = textures[slot];
        if (texture.image == formats::kNone)
            continue;
        material.textures |= 1u << slot;
        material.uv_sets |= uint32_t{texture.uv_set} << (4 * slot);
        const float* m = texture.uv_transform;
        material.uv_rows[2 * slot] = {m[0], m[1], m[2], 0};
        material.uv_rows[2 * slot + 1] = {m[3], m[4], m[5], 0};
    }
    return material;
}

shared::Light makeLight(const formats::LightRecord& record)
{
    shared::Light light{};
    light.type = record.type;
    light.position = translationOf(record.world_from_light);
    light.direction = normalizeOr(transformVector(record.world_from_light, {0, 0, -1}), {0, -1, 0});
    light.range = record.range;
    light.intensity = record.color * record.intensity;
    // KHR_lights_punctual, "Inner and outer cone angles": linear between the two cosines
    const float cos_outer = std::cos(record.outer_cone_rad);
    light.cone_scale = 1.0f / std::max(0.001f, std::cos(record.inner_cone_rad) - cos_outer);
    light.cone_offset = -cos_outer * light.cone_scale;
    return light;
}

float lightExposure(const formats::PackView& pack)
{
    const Box3 bounds = sceneBounds(pack);
    float illuminance = 0;
    for (const formats::LightRecord& record :
         pack.lights().first(std::min<size_t>(pack.lights().size(), shared::kMaxLights)))
        illuminance += illuminanceAt(bounds, makeLight(record));
    return illuminance > shared::kKeyIlluminance ? shared::kKeyIlluminance / illuminance : 1.0f;
}

shared::Lighting makeLighting(const formats::PackView& pack)
{
    shared::Lighting lighting{};
    lighting.sky_zenith = shared::kSkyZenith;
    lighting.sky_horizon = shared::kSkyHorizon;
    lighting.sky_ground = shared::kSkyGround;

    for (const formats::LightRecord& record : pack.lights())
        if (lighting.light_count < shared::kMaxLights)
            lighting.lights[lighting.light_count++] = makeLight(record);
    if (lighting.light_count == 0)
        lighting.lights[lighting.light_count++] = defaultSun();
    const float exposure = lightExposure(pack);
    assignShadowRows(lighting);
    for (uint32_t i = 0; i < lighting.light_count; ++i)
        lighting.lights[i].intensity = lighting.lights[i].intensity * exposure;
    return lighting;
}

} // namespace hearth::gpu
