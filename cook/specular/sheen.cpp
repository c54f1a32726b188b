// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/sheen.h"

#include "cook/specular/gauss_legendre.h"
#include "formats/base/half.h"
#include "formats/gpu_shared/sheen.h"

#include <algorithm>

namespace hearth::specular
{

namespace
{

// At the horizon visibility has a pole.
constexpr double kMinSheenCosine = 1e-4;

} // namespace

SheenMoments computeSheenMoments(double roughness, double cosine)
{
    // smooth lobes seen from the side rise within cosine of the horizon: cubes put the points there
    static const std::vector<QuadraturePoint> heights = gaussLegendre(128), turns = gaussLegendre(96);
    const double nv = std::max(cosine, kMinSheenCosine), exponent = 1 / (roughness * roughness);
    const double view_level = std::sqrt(1 - nv * nv);
    SheenMoments sum;
    for (const QuadraturePoint& height : heights)
    {
        const double u = 0.5 + 0.5 * height.at, nl = u * u * u;
        const double level = std::sqrt(1 - nl * nl);
        for (const QuadraturePoint& point : turns)
        {
            const double turn = std::numbers::pi * (0.5 + 0.5 * point.at);
            const double vl = nl * nv + level * view_level * std::cos(turn);
            const double nh2 = (nl + nv) * (nl + nv) / (2 + 2 * vl);
            const double distribution =
                (2 + exponent) * std::pow(std::max(1 - nh2, 0.0), exponent / 2) / (2 * std::numbers::pi);
            const double visibility = 1 / (4 * (nl + nv - nl * nv));
            // both halves of the circle are alike
            const double area = 1.5 * u * u * height.weight * std::numbers::pi * point.weight;
            const double light = distribution * visibility * nl * area;
            sum.albedo += light;
            sum.mean = sum.mean + Double3{level * std::cos(turn), 0, nl} * light;
        }
    }
    sum.mean = sum.mean * (1 / sum.albedo);
    return sum;
}

std::vector<uint64_t> cookSheen()
{
    std::vector<uint64_t> table;
    for (uint32_t row = 0; row < shared::kReflectanceRows; ++row)
        for (uint32_t column = 0; column < shared::kReflectanceColumns; ++column)
        {
            const Float2 node = shared::sheenNode(column, row);
            const SheenMoments moments = computeSheenMoments(double{node.y}, double{node.x});
            // the cone with the lobe's mean direction
            const double cos_half_angle = std::clamp(2 * length(moments.mean) - 1, 0.0, 1.0);
            uint64_t word = 0;
            for (const double value : {cos_half_angle, moments.mean.x / length(moments.mean), moments.albedo})
                word = word << 16 | halfFromFloat(static_cast<float>(value));
            table.push_back(word);
        }
    return table;
}

} // namespace hearth::specular
