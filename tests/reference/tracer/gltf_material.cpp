// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/gltf_material.h"

#include <algorithm>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

double schlick(double f0, double cosine)
{
    return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

} // namespace

Double3 reflected(const Coating& c, Double3 view, Double3 light)
{
    const double nl = dot(c.normal, light);
    if (nl <= 0)
        return {};
    const Double3 half = normalize(light + view);
    const double nv = std::clamp(std::abs(dot(c.normal, view)), 1e-4, 1.0);
    const double nh = std::clamp(dot(c.normal, half), 0.0, 1.0), vh = std::clamp(dot(view, half), 0.0, 1.0);
    const double alpha2 = std::pow(c.roughness, 4);
    const double distribution = alpha2 / (kPi * std::pow(nh * nh * (alpha2 - 1) + 1, 2));
    const double smith =
        nl * std::sqrt(nv * nv * (1 - alpha2) + alpha2) + nv * std::sqrt(nl * nl * (1 - alpha2) + alpha2);
    const double specular = distribution * 0.5 / smith;
    const auto channel = [&](double base)
    {
        const double fresnel = schlick(0.04 + (base - 0.04) * c.metallic, vh);
        return ((1 - fresnel) * base * (1 - c.metallic) / kPi + fresnel * specular) * nl;
    };
    return {channel(c.base.x), channel(c.base.y), channel(c.base.z)};
}

SkyAlbedo skyAlbedo(const Coating& c, Double3 view)
{
    const double nv = std::clamp(std::abs(dot(c.normal, view)), 1e-4, 1.0);
    const double r = c.roughness;
    const double a = std::min((1 - r) * (1 - r), std::exp2(-9.28 * nv)) * (1 - r) + 0.0425 - 0.0275 * r;
    const double scale = -1.04 * a + 1.04 - 0.572 * r, bias = 1.04 * a - 0.04 + 0.022 * r;
    const auto specular = [&](double base) { return (0.04 + (base - 0.04) * c.metallic) * scale + bias; };
    const auto diffuse = [&](double base) { return (1 - specular(base)) * base * (1 - c.metallic); };
    return {{diffuse(c.base.x), diffuse(c.base.y), diffuse(c.base.z)},
            {specular(c.base.x), specular(c.base.y), specular(c.base.z)}};
}

SkyResponse underSky(const Coating& c, const SceneLighting& lighting, Double3 view)
{
    const Double3 mirror = c.normal * (2 * dot(c.normal, view)) - view;
    const SkyAlbedo albedo = skyAlbedo(c, view);
    return {albedo.diffuse * lighting.irradiance(c.normal),
            albedo.specular * lighting.radiance(mirror, c.roughness)};
}

double filmic(double radiance)
{
    const double x = std::max(0.0, radiance - 0.004);
    return std::pow((x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06), 2.2);
}

} // namespace hearth::reference
