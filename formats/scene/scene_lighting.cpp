// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/scene_lighting.h"

#include "formats/base/affine3d.h"
#include "formats/gpu_shared/shadow.h"
#include "formats/scene/sky_image.h"

#include <algorithm>
#include <cmath>

namespace hearth::shared
{

namespace
{

/// Return the sun of scenes without lights.
Light defaultSun()
{
    Light sun{};
    sun.type = static_cast<uint32_t>(formats::LightType::directional);
    sun.shadow_row = kNoShadow;
    sun.direction = normalizeOr(kSunDirection, {0, -1, 0});
    sun.intensity = kSunIlluminance;
    return sun;
}

/// Estimate the illuminance in the middle of the scene. The distance of a lamp is at least a quarter of the
/// scene's radius: its effect on most of the frame matters, not its effect on the lampshade around it.
float estimateIlluminance(const Box3& bounds, const Light& light)
{
    if (light.type == static_cast<uint32_t>(formats::LightType::directional))
        return luminance(light.intensity);
    const float radius = bounds.empty() ? 1.0f : 0.5f * length(bounds.max - bounds.min);
    const Float3 center = bounds.empty() ? Float3{} : bounds.center();
    const float distance = std::max(length(light.position - center), std::max(0.25f * radius, 1e-3f));
    return luminance(light.intensity) / (distance * distance);
}

std::span<const formats::LightRecord> shadedLights(std::span<const formats::LightRecord> lights)
{
    return lights.first(std::min<size_t>(lights.size(), kMaxLights));
}

} // namespace

float luminance(Float3 color)
{
    return dot(color, {0.2126f, 0.7152f, 0.0722f});
}

Light lightFromRecord(const formats::LightRecord& record)
{
    Light light{};
    light.type = record.type;
    light.position = transformPoint(record.world_from_light, {0, 0, 0});
    light.direction = normalizeOr(transformVector(record.world_from_light, {0, 0, -1}), {0, -1, 0});
    light.range = record.range;
    light.intensity = record.color * record.intensity;
    light.shadow_row = kNoShadow;
    // KHR_lights_punctual, "Inner and outer cone angles": linear between the two cosines
    const float cos_outer = std::cos(record.outer_cone_rad);
    light.cone_scale = 1.0f / std::max(0.001f, std::cos(record.inner_cone_rad) - cos_outer);
    light.cone_offset = -cos_outer * light.cone_scale;
    return light;
}

Box3 lightingBounds(std::span<const formats::InstanceRecord> instances,
                    std::span<const formats::MeshRecord> meshes)
{
    Box3 bounds;
    for (const formats::InstanceRecord& instance : instances)
    {
        const formats::MeshRecord& mesh = meshes[instance.mesh];
        bounds.add(transformBox(widened(instance.world_from_object), {mesh.box_min, mesh.box_max}));
    }
    return bounds;
}

float lightExposure(std::span<const formats::LightRecord> lights, const Box3& bounds)
{
    float illuminance = 0;
    for (const formats::LightRecord& record : shadedLights(lights))
        illuminance += estimateIlluminance(bounds, lightFromRecord(record));
    return illuminance > kKeyIlluminance ? kKeyIlluminance / illuminance : 1.0f;
}

SceneLighting sceneLighting(std::span<const formats::LightRecord> lights, const Box3& bounds,
                            const SceneProbes& probes)
{
    SceneLighting lighting{.sky = {kSkyZenith, kSkyHorizon, kSkyGround},
                           .exposure = lightExposure(lights, bounds),
                           .lights = {},
                           .local_probes = makeLocalProbes(probes.records)};
    for (const formats::LightRecord& record : shadedLights(lights))
        lighting.lights.push_back(lightFromRecord(record));
    if (const std::optional<size_t> i = findSkyProbe(probes.records))
    {
        const formats::ProbeRecord& probe = probes.records[*i];
        lighting.sky_image =
            makeSkyImage(probe, probes.texels.subspan(probe.texels.first, probe.texels.count));
        lighting.sky = {.zenith = {}, .horizon = {}, .ground = {}, .image = lighting.sky_image.get()};
    }
    else if (lighting.lights.empty())
        lighting.lights.push_back(defaultSun());
    for (Light& light : lighting.lights)
        light.intensity = light.intensity * lighting.exposure;
    return lighting;
}

void copyReflector(Light& light, const Light& other)
{
    light.reflector_gain = other.reflector_gain;
    light.reflector_axis = other.reflector_axis;
    light.reflected0 = other.reflected0;
    light.reflected1 = other.reflected1;
    light.reflected2 = other.reflected2;
    light.reflected3 = other.reflected3;
    light.passed0 = other.passed0;
    light.passed1 = other.passed1;
    light.passed2 = other.passed2;
    light.passed3 = other.passed3;
}

void addReflectors(SceneLighting& lighting, std::span<const formats::ReflectorRecord> reflectors)
{
    for (size_t i = 0; i < std::min(reflectors.size(), lighting.lights.size()); ++i)
    {
        Light& light = lighting.lights[i];
        const formats::ReflectorRecord& reflector = reflectors[i];
        light.reflector_gain = reflector.gain;
        light.reflector_axis = reflector.axis;
        light.reflected0 = reflector.reflected[0];
        light.reflected1 = reflector.reflected[1];
        light.reflected2 = reflector.reflected[2];
        light.reflected3 = reflector.reflected[3];
        light.passed0 = reflector.passed[0];
        light.passed1 = reflector.passed[1];
        light.passed2 = reflector.passed[2];
        light.passed3 = reflector.passed[3];
    }
}

} // namespace hearth::shared
