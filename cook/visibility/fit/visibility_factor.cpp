// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/visibility_factor.h"

#include "cook/visibility/mesh/matrix4.h"

#include <algorithm>
#include <numbers>

namespace hearth::visibility
{

namespace
{

// Variance of the terms of factors, of instances in a cave as of those on a hill.
constexpr double kTermVariance = 0.25;

// Ridge without noise: of surfaces that nothing is visible from.
constexpr double kMinRidge = 1e-9;

/// Return m0 / 2 pi and m1 / pi.
Vector4 makeRows(float m0, Float3 m1)
{
    constexpr double kPi = std::numbers::pi;
    return {double{m0} / (2 * kPi), double{m1.x} / kPi, double{m1.y} / kPi, double{m1.z} / kPi};
}

/// Return the rows that each term of the factor adds.
Matrix4 makeColumns(const FactorSample& sample)
{
    constexpr std::array<Float4, 4> kTerms{Float4{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    Matrix4 columns;
    for (size_t term = 0; term < 4; ++term)
    {
        const shared::VisibilityMoments part =
            shared::changedVisibility(sample.mesh, sample.normal, kTerms[term]);
        columns[term] = makeRows(part.m0, part.m1);
    }
    return columns;
}

} // namespace

double computeOcclusion(const shared::VisibilityMoments& moments, Float3 normal)
{
    const shared::VisibilityMoments feasible = shared::feasibleVisibility(moments.m0, moments.m1);
    return std::max(double{dot(feasible.m1, normal)} / std::numbers::pi, 0.0);
}

VisibilityFactor fitFactor(std::span<const FactorSample> samples)
{
    Matrix4 products{};
    Vector4 right{};
    double noise = 0; // of the mean of both sets, summed over all rows
    for (const FactorSample& sample : samples)
    {
        const Matrix4 columns = makeColumns(sample);
        const Vector4 first = makeRows(sample.seen[0].m0, sample.seen[0].m1),
                      second = makeRows(sample.seen[1].m0, sample.seen[1].m1);
        for (size_t row = 0; row < 4; ++row)
        {
            const Vector4 terms{columns[0][row], columns[1][row], columns[2][row], columns[3][row]};
            addProduct(products, terms, 1);
            const double missing = (first[row] + second[row]) / 2 - terms[3];
            for (size_t term = 0; term < 4; ++term)
                right[term] += terms[term] * missing;
            noise += (first[row] - second[row]) * (first[row] - second[row]) / 4;
        }
    }
    const double rows = 4 * static_cast<double>(std::max<size_t>(samples.size(), 1));
    for (size_t term = 0; term < 4; ++term)
        products[term][term] += noise / rows / kTermVariance + kMinRidge;
    const Vector4 change = product(inverse(products), right);
    VisibilityFactor factor;
    factor.terms = {static_cast<float>(change[0]), static_cast<float>(change[1]),
                    static_cast<float>(change[2]), static_cast<float>(1 + change[3])};
    for (const FactorSample& sample : samples)
    {
        const auto error = [&](const shared::VisibilityMoments& moments)
        {
            const double occlusion = computeOcclusion(moments, sample.normal);
            const auto difference = [&](const Moments& seen)
            { return double{dot(seen.m1, sample.normal)} / std::numbers::pi - occlusion; };
            return difference(sample.seen[0]) * difference(sample.seen[1]) /
                   static_cast<double>(samples.size());
        };
        factor.error_of_mean += error(sample.mesh);
        factor.error_with_factor +=
            error(shared::changedVisibility(sample.mesh, sample.normal, factor.terms));
    }
    return factor;
}

} // namespace hearth::visibility
