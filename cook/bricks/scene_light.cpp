// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/scene_light.h"

#include <algorithm>
#include <cmath>

namespace hearth::bricks
{

using namespace shared;

namespace
{

Light lightOf(const formats::LightRecord& record)
{
    Light light{};
    light.type = record.type;
    light.position = transformPoint(record.world_from_light, {0, 0, 0});
    light.direction = normalizeOr(transformVector(record.world_from_light, {0, 0, -1}), {0, -1, 0});
    light.range = record.range;
    light.intensity = record.color * record.intensity;
    // KHR_lights_punctual, "Inner and outer cone angles": linear between the two cosines
    const float cos_outer = std::cos(record.outer_cone_rad);
    light.cone_scale = 1.0f / std::max(0.001f, std::cos(record.inner_cone_rad) - cos_outer);
    light.cone_offset = -cos_outer * light.cone_scale;
    return light;
}

/// In lux, in the middle of the scene; a lamp counts from no nearer than a quarter of the scene's radius.
float illuminanceAt(const Box3& box, const Light& light)
{
    const float luminance = dot(light.intensity, {0.2126f, 0.7152f, 0.0722f});
    if (light.type == static_cast<uint32_t>(formats::LightType::directional))
        return luminance;
    const float radius = box.empty() ? 1.0f : 0.5f * length(box.max - box.min);
    const Float3 center = box.empty() ? Float3{} : box.center();
    const float distance = std::max({length(light.position - center), 0.25f * radius, 1e-3f});
    return luminance / (distance * distance);
}

} // namespace

Lighting lightingOf(const StaticScene& scene)
{
    Lighting lighting{};
    lighting.sky_zenith = kSkyZenith;
    lighting.sky_horizon = kSkyHorizon;
    lighting.sky_ground = kSkyGround;
    const Box3 box = scene.box();
    float illuminance = 0;
    for (const SourceParts& source : scene.sources)
        for (const formats::LightRecord& record : source.scene.lights())
        {
            if (lighting.light_count == kMaxLights)
                break;
            Light& light = lighting.lights[lighting.light_count++];
            light = lightOf(record);
            illuminance += illuminanceAt(box, light);
        }
    if (lighting.light_count == 0)
    {
        Light& sun = lighting.lights[lighting.light_count++];
        sun.type = static_cast<uint32_t>(formats::LightType::directional);
        sun.direction = normalizeOr(kSunDirection, {0, -1, 0});
        sun.intensity = kSunIlluminance;
    }
    const float exposure = illuminance > kKeyIlluminance ? kKeyIlluminance / illuminance : 1.0f;
    for (uint32_t i = 0; i < lighting.light_count; ++i)
        lighting.lights[i].intensity = lighting.lights[i].intensity * exposure;
    return lighting;
}

} // namespace hearth::bricks
