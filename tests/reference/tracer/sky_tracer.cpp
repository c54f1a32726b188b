// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/sky_tracer.h"

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

/// Sample the visible normals of GGX (E. Heitz, "Sampling the GGX distribution of visible normals", 2018).
/// `view` is in the frame of the normal, which is z.
Double3 visibleNormal(Double3 view, double alpha, double u, double v)
{
    const Double3 stretched = normalize({alpha * view.x, alpha * view.y, view.z});
    const double across = stretched.x * stretched.x + stretched.y * stretched.y;
    const Double3 t1 =
        across > 0 ? Double3{-stretched.y, stretched.x, 0} / std::sqrt(across) : Double3{1, 0, 0};
    const Double3 t2 = cross(stretched, t1);
    const double r = std::sqrt(u), phi = 2 * kPi * v, s = 0.5 * (1 + stretched.z);
    const double a = r * std::cos(phi);
    const double b = (1 - s) * std::sqrt(std::max(0.0, 1 - a * a)) + s * r * std::sin(phi);
    const Double3 n = t1 * a + t2 * b + stretched * std::sqrt(std::max(0.0, 1 - a * a - b * b));
    return normalize({alpha * n.x, alpha * n.y, std::max(1e-9, n.z)});
}

/// G2 / G1(view), height-correlated: weight of a direction from visibleNormal.
double maskingWeight(double nl, double nv, double alpha)
{
    const double a2 = alpha * alpha;
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1 + a2 * (1 / (c * c) - 1)) - 1); };
    return (1 + lambda(nv)) / (1 + lambda(nv) + lambda(nl));
}

struct Frame
{
    Double3 x, y, z;
    explicit Frame(Double3 n)
        : x(normalize(cross(n, std::abs(n.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}))),
          y(cross(n, x)),
          z(n)
    {
    }
    Double3 local(Double3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
    Double3 world(Double3 v) const { return x * v.x + y * v.y + z * v.z; }
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

SkyAccess traceSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view,
                   const SkyTracing& tracing, uint64_t seed)
{
    const Double3 start = lifted(point), normal = point.coating.normal;
    const Frame frame(normal);
    Double3 seen = frame.local(view);
    seen.z = std::clamp(std::abs(seen.z), 1e-4, 1.0); // as in the material model
    seen = normalize(seen);
    const double alpha = point.coating.roughness * point.coating.roughness;
    const Points diffuse_points(seed), specular_points(mixed(seed) + 1);
    LobeSums diffuse, specular;
    for (uint32_t i = 0; i < tracing.rays; ++i)
    {
        const uint64_t ray_seed = mixed(seed) + 2 * uint64_t{i};
        diffuse.add(scene, start, cosineDirection(normal, diffuse_points.u(i), diffuse_points.v(i)), 1,
                    tracing, ray_seed);
        const Double3 half = visibleNormal(seen, alpha, specular_points.u(i), specular_points.v(i));
        const Double3 mirrored = half * (2 * dot(seen, half)) - seen;
        if (mirrored.z > 0) // the lobe below the horizon is left out of the total, too
            specular.add(scene, start, frame.world(mirrored), maskingWeight(mirrored.z, seen.z, alpha),
                         tracing, ray_seed + 1);
    }
    SkyAccess access;
    access.diffuse = ratio(diffuse.visible, diffuse.all);
    access.specular = ratio(specular.visible, specular.all);
    const double n = std::max(1u, tracing.rays), w = specular.weight > 0 ? specular.weight : 1;
    access.irradiance = diffuse.visible / n;
    access.reflection = specular.visible / w;
    access.bounced_irradiance = diffuse.bounced / n;
    access.bounced_reflection = specular.bounced / w;
    return access;
}

Double3 tracedSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view, const SkyTracing& tracing,
                  uint64_t seed)
{
    const Coating& c = point.coating;
    if (tracing.rays == 0)
    {
        const SkyResponse open = underSky(c, scene.lighting(), view);
        return (open.diffuse + open.specular) * c.occlusion;
    }
    const SkyAccess access = traceSky(scene, point, view, tracing, seed);
    const Albedo part = albedo(c, view);
    const auto limited = [&](Double3 share)
    {
        return Double3{std::min(share.x, c.occlusion), std::min(share.y, c.occlusion),
                       std::min(share.z, c.occlusion)};
    };
    const Double3 diffuse_share = limited(access.diffuse), specular_share = limited(access.specular);
    Double3 radiance =
        (part.diffuse * access.bounced_irradiance + part.specular * access.bounced_reflection) * c.occlusion;
    const SkyResponse open = underSky(c, scene.lighting(), view);
    return radiance + open.diffuse * diffuse_share + open.specular * specular_share;
}

Double3 underLights(const ShadedScene& scene, const ShadedPoint& point, Double3 view, bool shadows)
{
    const Double3 start = lifted(point);
    Double3 radiance;
    for (const SceneLight& light : scene.lighting().lights)
    {
        const Incident incident = light.at(point.surface.position);
        if (shadows && scene.shadowed(start, incident))
            continue;
        radiance += incident.irradiance * reflected(point.coating, view, incident.to_light);
    }
    return radiance;
}

} // namespace hearth::reference
