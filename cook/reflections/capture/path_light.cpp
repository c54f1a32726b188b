// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/capture/path_light.h"

#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"

#include <algorithm>

namespace hearth::reflections
{

namespace
{

constexpr float kPi = 3.14159265f;

/// Bounces of a path behind what the probe sees, at most: it ends by chance long before.
constexpr uint32_t kMaxBounces = 64;
/// Bounces after which a path may end by chance, as likely as it has lost its light.
constexpr uint32_t kSureBounces = 2;
/// Least chance to go on, which bounds the weight of a path.
constexpr float kMinChance = 0.1f;

/// Share of a path's length that its point stands for, for the mip of textures: about the width of a
/// lobe.
constexpr float kFootprintShare = 0.25f;

// numbers of seeds behind those of bounces
constexpr uint64_t kDirectSeed = 100, kChanceSeed = 200;

receivers::BakeScene listLights(const Surfaces& surfaces, const shared::SceneLighting& lighting)
{
    receivers::BakeScene lights;
    for (const shared::Light& light : lighting.lights)
        lights.lamps.push_back({light, 0});
    receivers::MeshLight emission = surfaces.listEmission(lighting.exposure, lights.triangles);
    if (!emission.triangles.empty())
        lights.mesh_lights.push_back(std::move(emission));
    return lights;
}

} // namespace

PathLight::PathLight(const Surfaces& surfaces, const shared::SceneLighting& lighting)
    : surfaces_(surfaces),
      lighting_(lighting),
      lights_(listLights(surfaces, lighting)),
      first_(lights_, surfaces.rays(), receivers::kMeshLightRays),
      later_(lights_, surfaces.rays(), 1)
{
}

Float3 PathLight::direct(const receivers::DirectLight& light, const SurfaceHit& hit, uint64_t seed) const
{
    Float3 irradiance;
    uint64_t ray_count = 0;
    for (size_t i = 0; i < lights_.lightCount(); ++i)
        irradiance += light.at(i, {hit.position, hit.normal, hit.side}, seed, ray_count);
    return irradiance;
}

/// Return the radiance that a path brings to a surface from a direction of its hemisphere, by the cosine.
/// Shining surfaces that it meets are in the direct light of its points, but for the share that this leaves
/// out.
Float3 PathLight::arriving(SurfaceHit from, uint32_t path, uint64_t seed) const
{
    Float3 sum, weight{1, 1, 1};
    for (uint32_t bounce = 0; bounce < kMaxBounces; ++bounce)
    {
        const uint64_t own = sampling::deriveSeed(seed, bounce);
        const Float3 direction = sampling::frameAround(from.normal)
                                     .fromLocal(sampling::cosineDirection(
                                         sampling::unitPoint(sampling::shuffledOwenSobol(path, own))));
        if (dot(direction, from.side) <= 0)
            break;
        const std::optional<SurfaceHit> hit = surfaces_.nearest(from.position, direction);
        if (!hit)
            return sum + weight * shared::skyRadiance(lighting_.sky, direction);
        if (hit->is_black)
            break;
        const bricks::SurfaceSample surface =
            surfaces_.sample(*hit, std::max(hit->distance * kFootprintShare, 1e-6f));
        if (!lights_.mesh_lights.empty() && surface.emission != Float3{})
        {
            const Float3 radiance = surface.emission * lighting_.exposure;
            const receivers::DirectLight& light = bounce == 0 ? first_ : later_;
            sum += weight * radiance * light.missingShare(0, radiance, hit->distance);
        }
        weight = weight * surface.albedo;
        sum += weight * direct(later_, *hit, sampling::deriveSeed(own, kDirectSeed + path)) / kPi;
        if (bounce >= kSureBounces)
        {
            const float chance = std::clamp(std::max({weight.x, weight.y, weight.z}), kMinChance, 1.0f);
            const auto pick = static_cast<uint32_t>(sampling::deriveSeed(own, kChanceSeed + path));
            if (sampling::unitFloat(pick) > chance)
                break;
            weight = weight / chance;
        }
        from = *hit;
    }
    return sum;
}

LeavingLight PathLight::leaving(const SurfaceHit& hit, float footprint, uint64_t seed) const
{
    if (hit.is_black)
        return {};
    const bricks::SurfaceSample surface = surfaces_.sample(hit, footprint);
    Float3 indirect;
    for (uint32_t path = 0; path < kPathsOfHit; ++path)
        indirect += arriving(hit, path, seed) / kPathsOfHit;
    const Float3 irradiance = direct(first_, hit, sampling::deriveSeed(seed, kDirectSeed));
    return {.shown = surface.emission * lighting_.exposure + surface.albedo * irradiance / kPi,
            .albedo = surface.albedo,
            .bounced = indirect};
}

std::array<float, formats::kLightHarmonics> PathLight::lampHarmonics(Float3 position) const
{
    std::array<float, formats::kLightHarmonics> sum{};
    uint64_t ray_count = 0;
    for (size_t i = 0; i < lights_.lamps.size(); ++i)
    {
        const shared::Light& lamp = lights_.lamps[i].light;
        if (lamp.type == shared::kLightDirectional)
            continue;
        const Float3 direction = normalizeOr(lamp.position - position, {0, 1, 0});
        const float irradiance =
            shared::luminance(first_.at(i, {position, direction, direction}, i, ray_count));
        const std::array<float, formats::kLightHarmonics> basis = shared::evaluateHarmonics(direction);
        for (size_t h = 0; h < sum.size(); ++h)
            sum[h] += irradiance * basis[h];
    }
    return sum;
}

} // namespace hearth::reflections
