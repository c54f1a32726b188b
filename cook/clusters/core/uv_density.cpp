// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/uv_density.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace hearth::clusters
{

namespace
{

constexpr double kMaxAnisotropy = 8;
constexpr double kBlurredShare = 0.05; ///< of the area, at most

struct TriangleDensity
{
    double density;
    double area;
};

double dotDouble(Float3 a, Float3 b)
{
    return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z};
}

/// The squares of the singular values are the eigenvalues of M G^-1 M^T, where the columns of M are the edges
/// in UV and G has the inner products of the edges in space.
TriangleDensity measureTriangle(const Float3* p, const Float2* uv)
{
    const Float3 e = p[1] - p[0], f = p[2] - p[0];
    const double ee = dotDouble(e, e), ef = dotDouble(e, f), ff = dotDouble(f, f);
    const double g = ee * ff - ef * ef; // the square of twice the area
    if (!(g > 0))
        return {0, 0};
    const double a = double{uv[1].x} - double{uv[0].x}, b = double{uv[2].x} - double{uv[0].x};
    const double c = double{uv[1].y} - double{uv[0].y}, d = double{uv[2].y} - double{uv[0].y};
    const double trace =
        (a * a * ff - 2 * a * b * ef + b * b * ee + c * c * ff - 2 * c * d * ef + d * d * ee) / g;
    const double product = (a * d - b * c) * (a * d - b * c) / g;
    const double difference = std::sqrt(std::max(trace * trace / 4 - product, 0.0));
    const double greater = std::sqrt(trace / 2 + difference);
    const double smaller = std::sqrt(std::max(trace / 2 - difference, 0.0));
    return {std::max(smaller, greater / kMaxAnisotropy), std::sqrt(g)};
}

} // namespace

uint8_t encodeUvDensity(double density)
{
    // 2^(k/8)
    constexpr double kSteps[] = {1,
                                 1.0905077326652577,
                                 1.189207115002721,
                                 1.2968395546510096,
                                 1.4142135623730951,
                                 1.5422108254079408,
                                 1.681792830507429,
                                 1.8340080864093424};
    if (!(density > 0))
        return 1;
    int exponent = 0;
    const double mantissa = 2 * std::frexp(density, &exponent); // 1 to 2
    const auto step =
        std::upper_bound(std::begin(kSteps), std::end(kSteps), mantissa) - std::begin(kSteps) - 1;
    return static_cast<uint8_t>(std::clamp((exponent - 1) * 8 + static_cast<int>(step) + 128, 1, 255));
}

double measureUvDensity(std::span<const Float3> places, std::span<const Float2> uvs)
{
    std::vector<TriangleDensity> triangles;
    double area = 0;
    for (size_t first = 0; first + 3 <= places.size(); first += 3)
        if (const TriangleDensity triangle = measureTriangle(&places[first], &uvs[first]); triangle.area > 0)
        {
            triangles.push_back(triangle);
            area += triangle.area;
        }
    std::ranges::sort(triangles, {}, &TriangleDensity::density);
    double blurred = 0;
    for (const TriangleDensity& triangle : triangles)
    {
        blurred += triangle.area;
        if (blurred > kBlurredShare * area)
            return triangle.density;
    }
    return triangles.empty() ? 0 : triangles.back().density;
}

} // namespace hearth::clusters
