// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/scene_lighting.h"

#include "formats/base/assert.h"
#include "formats/gpu_shared/shading.h"
#include "formats/scene/light_flicker.h"
#include "formats/texels/shared_exponent.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hearth::reference
{

using namespace formats;

namespace
{

constexpr double kPi = 3.14159265358979323846;

double smooth(double from, double to, double x)
{
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

Double3 mixed(Double3 a, Double3 b, double t)
{
    return a * (1 - t) + b * t;
}

SceneLight makeLight(const LightRecord& record)
{
    const DoubleAffine world(record.world_from_light);
    return {static_cast<LightType>(record.type),
            world.translation,
            normalize(world.vector({0, 0, -1})),
            Double3(record.color) * double{record.intensity},
            double{record.range},
            std::cos(double{record.inner_cone_rad}),
            std::cos(double{record.outer_cone_rad})};
}

/// World bounding box of all drawn geometry.
void sceneBox(const PackView& view, Double3& low, Double3& high)
{
    low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    high = -low;
    for (const InstanceRecord& instance : view.instances())
    {
        const MeshRecord& mesh = view.meshes()[instance.mesh];
        if (mesh.clusters.count == 0)
            continue;
        for (int corner = 0; corner < 8; ++corner)
        {
            const Double3 p = DoubleAffine(instance.world_from_object)
                                  .point({double{corner & 1 ? mesh.box_max.x : mesh.box_min.x},
                                          double{corner & 2 ? mesh.box_max.y : mesh.box_min.y},
                                          double{corner & 4 ? mesh.box_max.z : mesh.box_min.z}});
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    }
    if (low.x > high.x)
    {
        low = {-0.5, -0.5, -0.5};
        high = {0.5, 0.5, 0.5};
    }
}

/// Apply the exposure rule: if the lights give the middle of the scene more than the key, all are dimmed by
/// one factor to the key. Returns the factor.
double expose(const PackView& view, std::vector<SceneLight>& lights)
{
    Double3 low, high;
    sceneBox(view, low, high);
    const Double3 center = (low + high) * 0.5;
    const double radius = 0.5 * length(high - low);
    double illuminance = 0;
    for (const SceneLight& light : lights)
    {
        const double luminance = dot(light.intensity, {0.2126, 0.7152, 0.0722});
        const double distance = std::max({length(light.position - center), 0.25 * radius, 1e-3});
        illuminance += light.type == LightType::directional ? luminance : luminance / (distance * distance);
    }
    constexpr double kKey = shared::kKeyIlluminance;
    const double exposure = illuminance > kKey ? kKey / illuminance : 1;
    for (SceneLight& light : lights)
        light.intensity = light.intensity * exposure;
    return exposure;
}

/// Mean radiance within an angle of an axis of this height, weighted by the cosine to the axis.
template <typename Weight>
Double3 integrateSky(const SceneLighting& lighting, double height, double cos_half_angle,
                     const Weight& weight)
{
    constexpr int kRings = 32, kTurns = 24;
    static const std::array kCosines = []
    {
        std::array<double, kTurns> cosines;
        for (int turn = 0; turn < kTurns; ++turn)
            cosines[static_cast<size_t>(turn)] = std::cos(kPi * (turn + 0.5) / kTurns);
        return cosines;
    }();
    const double level = std::sqrt(std::max(0.0, 1 - height * height));
    Double3 sum;
    double weights = 0;
    for (int ring = 0; ring < kRings; ++ring)
    {
        const double along = 1 - (1 - cos_half_angle) * (ring + 0.5) / kRings;
        for (int turn = 0; turn < kTurns; ++turn)
        {
            const double across = std::sqrt(1 - along * along) * kCosines[static_cast<size_t>(turn)];
            sum += lighting.radiance({0, along * height + across * level, 0}) * weight(along);
            weights += weight(along);
        }
    }
    return sum / weights;
}

/// Return the sky that the camera sees, if a pack has one.
std::shared_ptr<const SkyMap> readSkyMap(const PackView& view)
{
    for (const ProbeRecord& probe : view.probes())
    {
        if ((probe.flags & kProbeIsSky) == 0)
            continue;
        const uint32_t side = probe.face_size << probe.sharp_mips;
        environment::Environment cube{environment::Layout::cube, side, side, {}};
        for (size_t i = 0; i < size_t{6} * side * side; ++i)
        {
            const std::array<float, 3> color =
                decodeSharedExponent(view.probeTexels()[probe.texels.first + i]);
            cube.texels.push_back(Float3{color[0], color[1], color[2]} * probe.irradiance_luminance);
        }
        return std::make_shared<SkyMap>(std::move(cube));
    }
    return nullptr;
}

} // namespace

Incident SceneLight::at(Double3 point) const
{
    if (type == LightType::directional)
        return {-direction, std::numeric_limits<double>::infinity(), intensity, casts_shadows};
    const Double3 offset = position - point;
    const double distance = std::max(length(offset), 1e-4);
    double attenuation = 1 / (distance * distance);
    if (range > 0)
        attenuation *= std::clamp(1 - std::pow(distance / range, 4), 0.0, 1.0);
    const Double3 to_light = offset / distance;
    if (type == LightType::spot)
    {
        const double inside = std::clamp(
            (dot(direction, -to_light) - cos_outer) / std::max(0.001, cos_inner - cos_outer), 0.0, 1.0);
        attenuation *= inside * inside;
    }
    return {to_light, distance, intensity * attenuation, casts_shadows};
}

Double3 SceneLighting::radiance(Double3 direction) const
{
    if (sky_map != nullptr)
        return sky_map->radiance(direction);
    const Double3 above = mixed(horizon, zenith, smooth(-0.2, 1, direction.y));
    return mixed(ground, above, smooth(-0.296, 0.296, direction.y));
}

Double3 SceneLighting::irradiance(Double3 normal) const
{
    HEARTH_ASSERT(sky_map == nullptr);
    return integrateSky(*this, normal.y, 0, [](double cosine) { return cosine; });
}

Double3 SceneLighting::coneRadiance(Double3 axis, double cos_half_angle) const
{
    HEARTH_ASSERT(sky_map == nullptr);
    return integrateSky(*this, axis.y, cos_half_angle, [](double) { return 1.0; });
}

SceneLighting readLighting(const PackView& view, std::optional<double> flicker_seconds)
{
    SceneLighting lighting{
        Double3(shared::kSkyZenith), Double3(shared::kSkyHorizon), Double3(shared::kSkyGround), {}, 1};
    for (const LightRecord& record : view.lights())
        lighting.lights.push_back(makeLight(record));
    lighting.sky_map = readSkyMap(view);
    if (lighting.lights.empty() && lighting.sky_map == nullptr)
        lighting.lights.push_back({LightType::directional,
                                   {},
                                   normalize(Double3(shared::kSunDirection)),
                                   Double3(shared::kSunIlluminance),
                                   0,
                                   1,
                                   0});
    else if (!lighting.lights.empty())
        lighting.exposure = expose(view, lighting.lights);
    if (flicker_seconds)
        for (size_t i = 0; i < view.lights().size(); ++i)
            lighting.lights[i].intensity =
                lighting.lights[i].intensity * flickerFactor(view.lights()[i], *flicker_seconds);
    return lighting;
}

} // namespace hearth::reference
