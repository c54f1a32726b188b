// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/gltf_material.h"

#include <algorithm>
#include <vector>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

double schlick(double f0, double cosine)
{
    return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

double normalCosine(const Coating& c, Double3 view)
{
    return std::clamp(std::abs(dot(c.normal, view)), 1e-4, 1.0);
}

/// Height-correlated visibility term G2 / (4 nl nv).
double smith(double nl, double nv, double alpha2)
{
    return 0.5 / (nl * std::sqrt(nv * nv * (1 - alpha2) + alpha2) +
                  nv * std::sqrt(nl * nl * (1 - alpha2) + alpha2));
}

/// Reflectance of one scattering: f0 * scale + bias.
struct SplitSum
{
    double scale, bias;
};

/// Call visit(light, half, weight) for directions that a lobe reflects to a view, by visible normals (E.
/// Heitz, "Sampling the GGX distribution of visible normals", 2018). The weights add up to the reflectance of
/// one scattering without Fresnel. Frame of the surface's normal, which is z; the view has y = 0.
/// turns  of a whole circle, or of the half at y > 0, which has the same weights
template <typename Visit>
void visitLobe(double roughness, double nv, int radii, int turns, double circle, const Visit& visit)
{
    const double alpha = roughness * roughness, alpha2 = alpha * alpha;
    const Double3 view{std::sqrt(1 - nv * nv), 0, nv};
    const Double3 stretched = normalize({alpha * view.x, 0, view.z});
    const double lift = 0.5 * (1 + stretched.z);
    for (int i = 0; i < radii; ++i)
        for (int j = 0; j < turns; ++j)
        {
            const double radius = std::sqrt((i + 0.5) / radii), turn = circle * (j + 0.5) / turns;
            const double side = radius * std::sin(turn), flat = std::sqrt(1 - side * side);
            const double along = (1 - lift) * flat + lift * radius * std::cos(turn);
            const double out = std::sqrt(std::max(0.0, 1 - side * side - along * along));
            // axes: (0, 1, 0), and its cross product with the stretched view
            const Double3 half = normalize({alpha * (stretched.x * out - stretched.z * along), alpha * side,
                                            stretched.z * out + stretched.x * along});
            const Double3 light = half * (2 * dot(view, half)) - view;
            if (light.z <= 0)
                continue;
            // G2 / G1(view)
            const double view_root = std::sqrt(nv * nv * (1 - alpha2) + alpha2);
            visit(light, half,
                  4 * smith(light.z, nv, alpha2) * light.z * 0.5 * (nv + view_root) / (radii * turns));
        }
}

SplitSum integrateLobe(double roughness, double nv)
{
    const Double3 view{std::sqrt(1 - nv * nv), 0, nv};
    SplitSum sum{};
    visitLobe(roughness, nv, 96, 24, kPi,
              [&](Double3, Double3 half, double weight)
              {
                  sum.scale += weight * (1 - schlick(0, dot(view, half)));
                  sum.bias += weight * schlick(0, dot(view, half));
              });
    return sum;
}

/// Mean radiance of the sky over a lobe.
Double3 reflectedSky(const Coating& c, const SceneLighting& lighting, Double3 view)
{
    const double nv = normalCosine(c, view);
    const Double3 across = view - c.normal * dot(c.normal, view);
    const Double3 x =
        length(across) > 1e-6
            ? normalize(across)
            : normalize(cross(c.normal, std::abs(c.normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
    const Double3 y = cross(c.normal, x);
    Double3 sum;
    double weights = 0;
    visitLobe(c.roughness, nv, 12, 16, 2 * kPi,
              [&](Double3 light, Double3, double weight)
              {
                  sum += lighting.radiance(x * light.x + y * light.y + c.normal * light.z) * weight;
                  weights += weight;
              });
    return weights > 0 ? sum / weights : lighting.radiance(c.normal * (2 * nv) - view);
}

/// Integrals at nodes, denser where they change most, and linear between.
class SplitSums
{
public:
    SplitSums()
    {
        for (int r = 0; r < kNodes; ++r)
            for (int v = 0; v < kNodes; ++v)
                nodes_.push_back(
                    integrateLobe(0.04 + 0.96 * square(place(r)), std::max(square(square(place(v))), 1e-5)));
    }

    SplitSum at(double roughness, double nv) const
    {
        const double x = std::sqrt(std::max(roughness - 0.04, 0.0) / 0.96) * (kNodes - 1);
        const double y = std::sqrt(std::sqrt(nv)) * (kNodes - 1);
        const int r = std::min(static_cast<int>(x), kNodes - 2),
                  v = std::min(static_cast<int>(y), kNodes - 2);
        SplitSum sum{};
        for (int corner = 0; corner < 4; ++corner)
        {
            const int i = corner & 1, j = corner >> 1;
            const double weight = (i == 1 ? x - r : 1 - (x - r)) * (j == 1 ? y - v : 1 - (y - v));
            const SplitSum& node = nodes_[static_cast<size_t>((r + i) * kNodes + v + j)];
            sum.scale += weight * node.scale;
            sum.bias += weight * node.bias;
        }
        return sum;
    }

private:
    static constexpr int kNodes = 64;
    static double square(double x) { return x * x; }
    static double place(int node) { return double{1} * node / (kNodes - 1); }

    std::vector<SplitSum> nodes_;
};

SplitSum splitSum(double roughness, double nv)
{
    static const SplitSums sums;
    return sums.at(roughness, nv);
}

constexpr double kDielectric = 0.04;

/// Reflectance at normal incidence of a channel.
double f0(const Coating& c, double base)
{
    return kDielectric + (base - kDielectric) * c.metallic;
}

/// Share of constant light that a lobe reflects with several scatterings.
double lobeAlbedo(double f0, const SplitSum& sum)
{
    return (f0 * sum.scale + sum.bias) * (1 + f0 * (1 / (sum.scale + sum.bias) - 1));
}

double specularAlbedo(const Coating& c, double base, const SplitSum& sum)
{
    return lobeAlbedo(base, sum) * c.metallic + lobeAlbedo(kDielectric, sum) * (1 - c.metallic);
}

double diffuseAlbedo(const Coating& c, double base, const SplitSum& sum)
{
    return (1 - lobeAlbedo(kDielectric, sum)) * base * (1 - c.metallic);
}

Double3 perChannel(Double3 base, auto&& channel)
{
    return {channel(base.x), channel(base.y), channel(base.z)};
}

} // namespace

Albedo albedo(const Coating& c, Double3 view)
{
    const SplitSum sum = splitSum(c.roughness, normalCosine(c, view));
    return {perChannel(c.base, [&](double base) { return diffuseAlbedo(c, base, sum); }),
            perChannel(c.base, [&](double base) { return specularAlbedo(c, base, sum); })};
}

Double3 reflected(const Coating& c, Double3 view, Double3 light)
{
    const double nl = dot(c.normal, light);
    if (nl <= 0)
        return {};
    const Double3 half = normalize(light + view);
    const double nv = normalCosine(c, view);
    const double nh = std::clamp(dot(c.normal, half), 0.0, 1.0), vh = std::clamp(dot(view, half), 0.0, 1.0);
    const double alpha2 = std::pow(c.roughness, 4);
    const double distribution = alpha2 / (kPi * std::pow(nh * nh * (alpha2 - 1) + 1, 2));
    const double lobe = distribution * smith(nl, nv, alpha2);
    const SplitSum sum = splitSum(c.roughness, nv);
    const auto channel = [&](double base)
    {
        const double several = specularAlbedo(c, base, sum) / (f0(c, base) * sum.scale + sum.bias);
        return diffuseAlbedo(c, base, sum) / kPi + several * schlick(f0(c, base), vh) * lobe;
    };
    return perChannel(c.base, channel) * nl;
}

SkyResponse underSky(const Coating& c, const SceneLighting& lighting, Double3 view)
{
    const Albedo part = albedo(c, view);
    return {part.diffuse * lighting.irradiance(c.normal), part.specular * reflectedSky(c, lighting, view)};
}

double filmic(double radiance)
{
    const double x = std::max(0.0, radiance - 0.004);
    return std::pow((x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06), 2.2);
}

} // namespace hearth::reference
