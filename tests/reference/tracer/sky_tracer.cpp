// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/sky_tracer.h"

#include "tests/reference/tracer/microfacets.h"

#include <algorithm>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kFar = 1e30;

/// SplitMix64 (S. Vigna).
uint64_t mixed(uint64_t x)
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

double unit(uint64_t bits)
{
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Two-dimensional sequence R2 (M. Roberts, 2018), shifted by the seed.
class Points
{
public:
    explicit Points(uint64_t seed) : u_(unit(mixed(seed))), v_(unit(mixed(mixed(seed)))) {}
    double u(uint32_t i) const { return std::fmod(u_ + i * 0.7548776662466927, 1.0); }
    double v(uint32_t i) const { return std::fmod(v_ + i * 0.5698402909980532, 1.0); }

private:
    double u_, v_;
};

Double3 ratio(Double3 part, Double3 whole)
{
    const auto of = [](double a, double b) { return b > 0 ? a / b : 1.0; };
    return {of(part.x, whole.x), of(part.y, whole.y), of(part.z, whole.z)};
}

/// Diffuse radiance of the surface that a ray from `start` hits; one path.
Double3 bounced(const ShadedScene& scene, Double3 start, Double3 direction, const SkyTracing& tracing,
                uint64_t seed)
{
    Double3 radiance, through{1, 1, 1};
    for (uint32_t bounce = 0; bounce < tracing.bounces; ++bounce)
    {
        const auto met = scene.nearest({start, direction, 0, kFar}, 0);
        if (!met || met->unlit)
            break;
        const Coating& c = met->coating;
        radiance += through * c.emitted;
        through = through * c.base * (1 - c.metallic);
        Double3 irradiance;
        start = lifted(*met);
        for (const SceneLight& light : scene.lighting().lights)
        {
            const Incident incident = light.at(met->surface.position);
            const double nl = dot(c.normal, incident.to_light);
            const bool shadowed = nl > 0 && tracing.shadows && scene.shadowed(start, incident);
            if (nl > 0 && !shadowed)
                irradiance += incident.irradiance * (nl / kPi);
        }
        radiance += through * irradiance;
        const Points points(mixed(seed + 7919 * (bounce + uint64_t{1})));
        direction = cosineDirection(c.normal, points.u(0), points.v(0));
        if (!scene.occluded({start, direction, 0, kFar}))
        {
            radiance += through * scene.lighting().radiance(direction);
            break;
        }
    }
    return radiance;
}

/// Sums over one lobe.
struct LobeSums
{
    Double3 all, visible, bounced;
    double weight = 0;

    void add(const ShadedScene& scene, Double3 start, Double3 direction, double w, const SkyTracing& tracing,
             uint64_t seed)
    {
        const Double3 sky = scene.lighting().radiance(direction) * w;
        all += sky;
        weight += w;
        if (!scene.occluded({start, direction, 0, kFar}))
            visible += sky;
        else if (tracing.bounces > 0)
            bounced += reference::bounced(scene, start, direction, tracing, seed) * w;
    }
};

} // namespace

namespace
{

/// Trace a GGX lobe.
LobeSums traceLobe(const ShadedScene& scene, Double3 start, Double3 normal, Double3 view, double roughness,
                   const SkyTracing& tracing, uint64_t seed)
{
    const Frame frame(normal);
    Double3 seen = frame.local(view);
    seen.z = std::clamp(std::abs(seen.z), 1e-4, 1.0); // as in the material model
    seen = normalize(seen);
    const double alpha = roughness * roughness;
    const Points points(seed);
    LobeSums sums;
    for (uint32_t i = 0; i < tracing.rays; ++i)
    {
        const Double3 half = visibleNormal(seen, alpha, points.u(i), points.v(i));
        const Double3 mirrored = half * (2 * dot(seen, half)) - seen;
        if (mirrored.z > 0) // the lobe below the horizon is left out of the total, too
            sums.add(scene, start, frame.world(mirrored), maskingWeight(mirrored.z, seen.z, alpha), tracing,
                     seed + i);
    }
    return sums;
}

} // namespace

SkyAccess traceSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view,
                   const SkyTracing& tracing, uint64_t seed)
{
    const Coating& c = point.coating;
    const Double3 start = lifted(point);
    const Points points(seed);
    LobeSums diffuse, sheen;
    for (uint32_t i = 0; i < tracing.rays; ++i)
    {
        const Double3 direction = cosineDirection(c.normal, points.u(i), points.v(i));
        diffuse.add(scene, start, direction, 1, tracing, mixed(seed) + 2 * uint64_t{i});
        if (c.sheen != Double3{})
            sheen.add(scene, start, direction, sheenLobe(c.sheen_roughness, c.normal, view, direction),
                      tracing, mixed(seed) + 2 * uint64_t{i});
    }
    const LobeSums specular = traceLobe(scene, start, c.normal, view, c.roughness, tracing, mixed(seed) + 1);
    SkyAccess access;
    access.diffuse = ratio(diffuse.visible, diffuse.all);
    access.specular = ratio(specular.visible, specular.all);
    access.sheen = ratio(sheen.visible, sheen.all);
    const double n = std::max(1u, tracing.rays);
    const auto mean = [](Double3 sum, double weight) { return sum / (weight > 0 ? weight : 1); };
    access.irradiance = diffuse.visible / n;
    access.reflection = mean(specular.visible, specular.weight);
    access.bounced_irradiance = diffuse.bounced / n;
    access.bounced_reflection = mean(specular.bounced, specular.weight);
    access.bounced_sheen = mean(sheen.bounced, sheen.weight);
    if (c.clearcoat > 0)
    {
        const LobeSums coat = traceLobe(scene, start, c.clearcoat_normal, view, c.clearcoat_roughness,
                                        tracing, mixed(seed) + 2);
        access.clearcoat = ratio(coat.visible, coat.all);
        access.bounced_clearcoat = mean(coat.bounced, coat.weight);
    }
    return access;
}

Double3 tracedSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view, const SkyTracing& tracing,
                  uint64_t seed)
{
    const Coating& c = point.coating;
    const SkyResponse open = underSky(c, scene.lighting(), view);
    if (tracing.rays == 0)
        return (open.diffuse + open.specular + open.sheen + open.clearcoat) * c.occlusion;
    const SkyAccess access = traceSky(scene, point, view, tracing, seed);
    const Albedo part = albedo(c, view);
    const auto limited = [&](Double3 share)
    {
        return Double3{std::min(share.x, c.occlusion), std::min(share.y, c.occlusion),
                       std::min(share.z, c.occlusion)};
    };
    const Double3 bounced = part.diffuse * access.bounced_irradiance +
                            part.specular * access.bounced_reflection + part.sheen * access.bounced_sheen +
                            access.bounced_clearcoat * part.clearcoat;
    return bounced * c.occlusion + open.diffuse * limited(access.diffuse) +
           open.specular * limited(access.specular) + open.sheen * limited(access.sheen) +
           open.clearcoat * limited(access.clearcoat);
}

Double3 underLights(const ShadedScene& scene, const ShadedPoint& point, Double3 view, bool shadows)
{
    const Double3 start = lifted(point);
    Double3 radiance;
    for (const SceneLight& light : scene.lighting().lights)
    {
        const Incident incident = light.at(point.surface.position);
        if (incident.irradiance == Double3{} || (shadows && scene.shadowed(start, incident)))
            continue;
        radiance += incident.irradiance * reflected(point.coating, view, incident.to_light);
    }
    return radiance;
}

} // namespace hearth::reference
