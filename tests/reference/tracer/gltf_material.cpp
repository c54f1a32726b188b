// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/gltf_material.h"

#include <algorithm>
#include <array>
#include <vector>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

double schlick(double f0, double f90, double cosine)
{
    return f0 + (f90 - f0) * std::pow(1 - cosine, 5);
}

double normalCosine(Double3 normal, Double3 view)
{
    return std::clamp(std::abs(dot(normal, view)), 1e-4, 1.0);
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
                  sum.scale += weight * (1 - schlick(0, 1, dot(view, half)));
                  sum.bias += weight * schlick(0, 1, dot(view, half));
              });
    return sum;
}

/// Axes of a surface: z is the normal, y is perpendicular to the view.
struct Axes
{
    Double3 x, y, z;

    Axes(Double3 normal, Double3 view) : z(normal)
    {
        const Double3 across = view - normal * dot(normal, view);
        x = length(across) > 1e-6
                ? normalize(across)
                : normalize(cross(normal, std::abs(normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
        y = cross(normal, x);
    }
    Double3 world(Double3 v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Mean radiance of the sky over a GGX lobe.
Double3 reflectedSky(double roughness, Double3 normal, const SceneLighting& lighting, Double3 view)
{
    const double nv = normalCosine(normal, view);
    const Axes axes(normal, view);
    Double3 sum;
    double weights = 0;
    visitLobe(roughness, nv, 12, 16, 2 * kPi,
              [&](Double3 light, Double3, double weight)
              {
                  sum += lighting.radiance(axes.world(light)) * weight;
                  weights += weight;
              });
    return weights > 0 ? sum / weights : lighting.radiance(normal * (2 * nv) - view);
}

/// Charlie's distribution times Neubelt's visibility, without a limit of its albedo. Cosines to the normal.
double charlie(double roughness, double nh, double nl, double nv)
{
    const double alpha = roughness * roughness;
    const double sine = std::sqrt(std::max(0.0, 1 - nh * nh));
    const double distribution = (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * kPi);
    return distribution / (4 * (nl + nv - nl * nv));
}

/// Call visit(light, weight) for directions of light over the hemisphere, with what sheen reflects of it. The
/// weights add up to the lobe's albedo without its limit. Frame of the surface's normal, which is z; the view
/// has y = 0 and x >= 0.
template <typename Visit>
void visitSheen(double roughness, double nv, int heights, int turns, const Visit& visit)
{
    const Double3 view{std::sqrt(1 - nv * nv), 0, nv};
    for (int i = 0; i < heights; ++i)
        for (int j = 0; j < turns; ++j)
        {
            // fourth powers: smooth sheen is a thin stripe at the horizon
            const double u = (i + 0.5) / heights, nl = std::pow(u, 4);
            const double turn = 2 * kPi * (j + 0.5) / turns, level = std::sqrt(1 - nl * nl);
            const Double3 light{level * std::cos(turn), level * std::sin(turn), nl};
            const double area = 4 * std::pow(u, 3) / heights * 2 * kPi / turns;
            visit(light, charlie(roughness, normalize(light + view).z, nl, nv) * nl * area);
        }
}

double integrateSheen(double roughness, double nv)
{
    double sum = 0;
    visitSheen(roughness, nv, 120, 80, [&](Double3, double weight) { sum += weight; });
    return sum;
}

/// Mean radiance of the sky over a sheen lobe.
Double3 sheenSky(double roughness, Double3 normal, const SceneLighting& lighting, Double3 view)
{
    const Axes axes(normal, view);
    Double3 sum;
    double weights = 0;
    visitSheen(roughness, normalCosine(normal, view), 24, 24,
               [&](Double3 light, double weight)
               {
                   sum += lighting.radiance(axes.world(light)) * weight;
                   weights += weight;
               });
    return sum / weights;
}

/// Values at nodes of roughness and cosine, denser where they change most, and linear between.
template <typename Value>
class Nodes
{
public:
    template <typename Integrate>
    Nodes(double min_roughness, const Integrate& integrate) : min_(min_roughness)
    {
        for (int r = 0; r < kNodes; ++r)
            for (int v = 0; v < kNodes; ++v)
                nodes_.push_back(integrate(min_ + (1 - min_) * square(place(r)),
                                           std::max(square(square(place(v))), 1e-5)));
    }

    /// Call add(node, weight) for the four nodes around a place.
    template <typename Add>
    void visit(double roughness, double nv, const Add& add) const
    {
        const double x = std::sqrt(std::max(roughness - min_, 0.0) / (1 - min_)) * (kNodes - 1);
        const double y = std::sqrt(std::sqrt(nv)) * (kNodes - 1);
        const int r = std::min(static_cast<int>(x), kNodes - 2),
                  v = std::min(static_cast<int>(y), kNodes - 2);
        for (int corner = 0; corner < 4; ++corner)
        {
            const int i = corner & 1, j = corner >> 1;
            add(nodes_[static_cast<size_t>((r + i) * kNodes + v + j)],
                (i == 1 ? x - r : 1 - (x - r)) * (j == 1 ? y - v : 1 - (y - v)));
        }
    }

private:
    static constexpr int kNodes = 64;
    static double square(double x) { return x * x; }
    static double place(int node) { return double{1} * node / (kNodes - 1); }

    double min_;
    std::vector<Value> nodes_;
};

SplitSum splitSum(double roughness, double nv)
{
    static const Nodes<SplitSum> nodes(0.04, integrateLobe);
    SplitSum sum{};
    nodes.visit(roughness, nv,
                [&](const SplitSum& node, double weight)
                {
                    sum.scale += weight * node.scale;
                    sum.bias += weight * node.bias;
                });
    return sum;
}

/// Albedo of white sheen without its limit.
double sheenSum(double roughness, double nv)
{
    static const Nodes<double> nodes(0.07, integrateSheen);
    double sum = 0;
    nodes.visit(roughness, nv, [&](double node, double weight) { sum += weight * node; });
    return sum;
}

/// Share of constant light that a lobe reflects with several scatterings.
double lobeAlbedo(double f0, double f90, const SplitSum& sum)
{
    return (f0 * sum.scale + f90 * sum.bias) * (1 + f0 * (1 / (sum.scale + sum.bias) - 1));
}

/// One channel of the surface below sheen and coat.
struct Channel
{
    double base, dielectric_f0;
};

std::array<Channel, 3> channels(const Coating& c)
{
    return {{{c.base.x, c.dielectric_f0.x}, {c.base.y, c.dielectric_f0.y}, {c.base.z, c.dielectric_f0.z}}};
}

Double3 perChannel(const Coating& c, auto&& value)
{
    const std::array<Channel, 3> all = channels(c);
    return {value(all[0]), value(all[1]), value(all[2])};
}

double dielectricAlbedo(const Coating& c, double dielectric_f0, const SplitSum& sum)
{
    return lobeAlbedo(dielectric_f0, c.dielectric_f90, sum);
}

double specularAlbedo(const Coating& c, const Channel& channel, const SplitSum& sum)
{
    return lobeAlbedo(channel.base, 1, sum) * c.metallic +
           dielectricAlbedo(c, channel.dielectric_f0, sum) * (1 - c.metallic);
}

/// All channels lose what the brightest one reflects, so that the hue of the diffuse part stays.
double diffuseAlbedo(const Coating& c, const Channel& channel, const SplitSum& sum)
{
    double reflected = 0;
    for (const Channel& each : channels(c))
        reflected = std::max(reflected, dielectricAlbedo(c, each.dielectric_f0, sum));
    return (1 - reflected) * channel.base * (1 - c.metallic);
}

/// Share of light that sheen and clear coat leave to what is below them.
struct Below
{
    double sheen, clearcoat;
};

Below shareBelow(const Coating& c, Double3 view)
{
    Below below{1, 1};
    const double brightest = std::max({c.sheen.x, c.sheen.y, c.sheen.z});
    if (brightest > 0)
        below.sheen -= brightest * std::min(sheenSum(c.sheen_roughness, normalCosine(c.normal, view)), 1.0);
    if (c.clearcoat > 0)
        below.clearcoat -=
            c.clearcoat *
            lobeAlbedo(0.04, 1, splitSum(c.clearcoat_roughness, normalCosine(c.clearcoat_normal, view)));
    return below;
}

} // namespace

Albedo albedo(const Coating& c, Double3 view)
{
    const SplitSum sum = splitSum(c.roughness, normalCosine(c.normal, view));
    const Below below = shareBelow(c, view);
    const double base = below.sheen * below.clearcoat;
    const double sheen =
        c.sheen == Double3{} ? 0 : std::min(sheenSum(c.sheen_roughness, normalCosine(c.normal, view)), 1.0);
    return {perChannel(c, [&](const Channel& channel) { return base * diffuseAlbedo(c, channel, sum); }),
            perChannel(c, [&](const Channel& channel) { return base * specularAlbedo(c, channel, sum); }),
            c.sheen * (sheen * below.clearcoat), 1 - below.clearcoat};
}

Double3 emitted(const Coating& c, Double3 view)
{
    return c.emitted * shareBelow(c, view).clearcoat;
}

double sheenLobe(double roughness, Double3 normal, Double3 view, Double3 light)
{
    const double nv = normalCosine(normal, view);
    const double nl = dot(normal, light), nh = std::min(std::abs(dot(normal, normalize(light + view))), 1.0);
    return nl > 0 ? charlie(roughness, nh, nl, nv) / std::max(sheenSum(roughness, nv), 1.0) : 0;
}

namespace
{

/// GGX lobe without its Fresnel term, times the cosine of the light.
double ggx(double roughness, Double3 normal, Double3 view, Double3 light)
{
    const double nl = dot(normal, light);
    if (nl <= 0)
        return 0;
    const double nh = std::clamp(dot(normal, normalize(light + view)), 0.0, 1.0);
    const double alpha2 = std::pow(roughness, 4);
    const double distribution = alpha2 / (kPi * std::pow(nh * nh * (alpha2 - 1) + 1, 2));
    return distribution * smith(nl, normalCosine(normal, view), alpha2) * nl;
}

} // namespace

Double3 reflected(const Coating& c, Double3 view, Double3 light)
{
    if (dot(c.normal, light) <= 0 && (c.clearcoat == 0 || dot(c.clearcoat_normal, light) <= 0))
        return {};
    const double vh = std::clamp(dot(view, normalize(light + view)), 0.0, 1.0);
    const SplitSum sum = splitSum(c.roughness, normalCosine(c.normal, view));
    const Below below = shareBelow(c, view);
    const double nl = std::max(dot(c.normal, light), 0.0);
    const double lobe = ggx(c.roughness, c.normal, view, light);
    const auto surface = [&](const Channel& channel)
    {
        const double f0 = channel.dielectric_f0 * (1 - c.metallic) + channel.base * c.metallic;
        const double f90 = c.dielectric_f90 * (1 - c.metallic) + c.metallic;
        const double once = f0 * sum.scale + f90 * sum.bias;
        const double several = once > 0 ? specularAlbedo(c, channel, sum) / once : 0;
        return diffuseAlbedo(c, channel, sum) / kPi * nl + several * schlick(f0, f90, vh) * lobe;
    };
    Double3 radiance = perChannel(c, surface) * below.sheen;
    if (c.sheen != Double3{})
        radiance += c.sheen * (sheenLobe(c.sheen_roughness, c.normal, view, light) * nl);
    radiance = radiance * below.clearcoat;
    if (c.clearcoat > 0)
    {
        const SplitSum coat = splitSum(c.clearcoat_roughness, normalCosine(c.clearcoat_normal, view));
        const double several = (1 - below.clearcoat) / (0.04 * coat.scale + coat.bias);
        const double value =
            several * schlick(0.04, 1, vh) * ggx(c.clearcoat_roughness, c.clearcoat_normal, view, light);
        radiance += {value, value, value};
    }
    return radiance;
}

SkyResponse underSky(const Coating& c, const SceneLighting& lighting, Double3 view)
{
    const Albedo part = albedo(c, view);
    SkyResponse response{part.diffuse * lighting.irradiance(c.normal),
                         part.specular * reflectedSky(c.roughness, c.normal, lighting, view),
                         {},
                         {}};
    if (c.sheen != Double3{})
        response.sheen = part.sheen * sheenSky(c.sheen_roughness, c.normal, lighting, view);
    if (c.clearcoat > 0)
        response.clearcoat =
            reflectedSky(c.clearcoat_roughness, c.clearcoat_normal, lighting, view) * part.clearcoat;
    return response;
}

double filmic(double radiance)
{
    const double x = std::max(0.0, radiance - 0.004);
    return std::pow((x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06), 2.2);
}

double invertFilmic(double shown)
{
    const double y = std::pow(std::clamp(shown, 0.0, 0.999), 1 / 2.2);
    // 6.2 (1 - y) x^2 + (0.5 - 1.7 y) x - 0.06 y = 0
    const double a = 6.2 * (1 - y), b = 0.5 - 1.7 * y;
    return (-b + std::sqrt(b * b + 0.24 * a * y)) / (2 * a) + 0.004;
}

} // namespace hearth::reference
