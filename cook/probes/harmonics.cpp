// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/harmonics.h"

#include <Eigen/Eigenvalues>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace hearth::probes
{

namespace
{

using environment::Environment;
using environment::Layout;
using environment::PanelArea;

constexpr double kPi = std::numbers::pi;

/// A number for each harmonic.
using HarmonicValues = std::array<double, 9>;

/// Turn 1; y, x, z; y y, x y, y z, x z, x x - z z, or integrals of them over a solid angle, into harmonics.
HarmonicValues makeHarmonics(const HarmonicValues& monomials)
{
    const double degree0 = std::sqrt(1 / (4 * kPi)), degree1 = std::sqrt(3 / (4 * kPi)),
                 degree2 = std::sqrt(15 / (4 * kPi));
    return {degree0 * monomials[0],
            degree1 * monomials[1],
            degree1 * monomials[2],
            degree1 * monomials[3],
            degree2 * (3 * monomials[4] - monomials[0]) / (2 * std::numbers::sqrt3),
            degree2 * monomials[5],
            degree2 * monomials[6],
            degree2 * monomials[7],
            degree2 * monomials[8] / 2};
}

HarmonicValues evaluateMonomials(Double3 d)
{
    return {1, d.y, d.x, d.z, d.y * d.y, d.x * d.y, d.y * d.z, d.x * d.z, d.x * d.x - d.z * d.z};
}

/// Factor of each monomial that depends on the longitude: 1, sine, cosine, sine cosine, sine^2 - cosine^2.
using LongitudeValues = std::array<double, 5>;
constexpr std::array<size_t, 9> kLongitudeFactor = {0, 0, 1, 2, 0, 1, 2, 3, 4};

/// Integrate the factors over the longitudes of a column.
LongitudeValues integrateColumn(const PanelArea& area)
{
    const double from = kPi * (1 - 2 * area.u1), to = kPi * (1 - 2 * area.u0);
    return {to - from, std::cos(from) - std::cos(to), std::sin(to) - std::sin(from),
            (std::cos(2 * from) - std::cos(2 * to)) / 4, (std::sin(2 * from) - std::sin(2 * to)) / 2};
}

/// Integrate the other factor of each monomial over the angles from the zenith of a row.
HarmonicValues integrateRow(const PanelArea& area)
{
    const double from = kPi * area.v0, to = kPi * area.v1;
    const double cos_from = std::cos(from), cos_to = std::cos(to), sin_from = std::sin(from),
                 sin_to = std::sin(to);
    const double sine = cos_from - cos_to;
    const double sine2 = (to - from - (sin_to * cos_to - sin_from * cos_from)) / 2;
    const double sine_cosine = (sin_to * sin_to - sin_from * sin_from) / 2;
    const double sine_cosine2 = (cos_from * cos_from * cos_from - cos_to * cos_to * cos_to) / 3;
    const double sine2_cosine = (sin_to * sin_to * sin_to - sin_from * sin_from * sin_from) / 3;
    const double sine3 = sine - sine_cosine2;
    return {sine, sine_cosine, sine2, sine2, sine_cosine2, sine2_cosine, sine2_cosine, sine3, sine3};
}

void addTo(Harmonics& sum, const HarmonicValues& harmonics, Double3 color)
{
    for (size_t i = 0; i < sum.size(); ++i)
        sum[i] = sum[i] + color * harmonics[i];
}

/// Project a row of a lat-long image.
Harmonics projectLatLongRow(const Environment& environment, std::span<const LongitudeValues> columns,
                            uint32_t y)
{
    std::array<Double3, 5> sums{};
    for (uint32_t x = 0; x < environment.width; ++x)
    {
        const Double3 radiance = widen(environment.texels[environment.index(0, x, y)]);
        for (size_t i = 0; i < sums.size(); ++i)
            sums[i] = sums[i] + radiance * columns[x][i];
    }
    const HarmonicValues row = integrateRow(environment.area(0, y));
    Harmonics projected{};
    const auto project = [&](double Double3::*channel)
    {
        HarmonicValues integrals;
        for (size_t i = 0; i < integrals.size(); ++i)
            integrals[i] = row[i] * (sums[kLongitudeFactor[i]].*channel);
        const HarmonicValues harmonics = makeHarmonics(integrals);
        for (size_t i = 0; i < integrals.size(); ++i)
            projected[i].*channel = harmonics[i];
    };
    project(&Double3::x);
    project(&Double3::y);
    project(&Double3::z);
    return projected;
}

/// Return the mean of the harmonics over a texel of a cube, by Gauss's rule of 2 x 2 points.
HarmonicValues averageHarmonics(uint32_t panel, const PanelArea& area)
{
    const double offset = 0.5 / std::numbers::sqrt3;
    HarmonicValues sum{};
    double weights = 0;
    for (const double du : {-offset, offset})
        for (const double dv : {-offset, offset})
        {
            const double u = (area.u0 + area.u1) / 2 + du * (area.u1 - area.u0);
            const double v = (area.v0 + area.v1) / 2 + dv * (area.v1 - area.v0);
            const double a = 2 * u - 1, b = 2 * v - 1, square = 1 + a * a + b * b;
            const double weight = 1 / (square * std::sqrt(square)); // density of solid angle
            const HarmonicValues harmonics =
                makeHarmonics(evaluateMonomials(panelDirection(Layout::cube, panel, {u, v})));
            for (size_t i = 0; i < sum.size(); ++i)
                sum[i] += weight * harmonics[i];
            weights += weight;
        }
    for (double& value : sum)
        value /= weights;
    return sum;
}

Harmonics projectCubeRow(const Environment& environment, uint32_t panel, uint32_t y)
{
    Harmonics projected{};
    for (uint32_t x = 0; x < environment.width; ++x)
    {
        const PanelArea area = environment.area(x, y);
        addTo(projected, averageHarmonics(panel, area),
              widen(environment.texels[environment.index(panel, x, y)]) *
                  panelSolidAngle(Layout::cube, area));
    }
    return projected;
}

/// Return the least value of n . matrix n + linear . n over unit vectors. It is the greatest value of the
/// dual function t - sum of (linear_i / 2)^2 / (eigenvalue_i - t) for t below all eigenvalues, without a
/// gap.
/// Source: J. Nocedal, S. Wright, "Numerical optimization", 2006, section 4.3 (trust-region subproblem).
double minOnSphere(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& linear)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    const Eigen::Vector3d half = solver.eigenvectors().transpose() * linear / 2;
    const Eigen::Vector3d& values = solver.eigenvalues(); // ascending
    double low = values[0] - half.norm(), high = values[0];
    const auto terms = [&](double t, int power)
    {
        double sum = 0;
        for (int i = 0; i < 3; ++i)
            if (half[i] != 0)
                sum += half[i] * half[i] / std::pow(values[i] - t, power);
        return sum;
    };
    // the dual function is concave: find where its slope, 1 - terms(t, 2), ends to be positive
    constexpr int kSteps = 100;
    for (int step = 0; step < kSteps; ++step)
    {
        const double middle = (low + high) / 2;
        if (middle <= low || middle >= high)
            break;
        (terms(middle, 2) <= 1 ? low : high) = middle;
    }
    return half.norm() == 0 ? values[0] : low - terms(low, 1);
}

Harmonics attenuate(const Harmonics& radiance, double window)
{
    Harmonics attenuated = radiance;
    for (size_t i = 1; i < radiance.size(); ++i)
    {
        const double squared = i < 4 ? 4 : 36; // of l (l + 1)
        attenuated[i] = radiance[i] * (1 / (1 + window * squared));
    }
    return attenuated;
}

// Factors by which a cosine lobe attenuates the degrees.
constexpr double kCosine0 = kPi, kCosine1 = 2 * kPi / 3, kCosine2 = kPi / 4;

} // namespace

Harmonics projectRadiance(const Environment& environment)
{
    const bool is_cube = environment.layout == Layout::cube;
    std::vector<LongitudeValues> columns;
    for (uint32_t x = 0; !is_cube && x < environment.width; ++x)
        columns.push_back(integrateColumn(environment.area(x, 0)));
    std::vector<Harmonics> rows(size_t{environment.height} * environment.panelCount());
    tbb::parallel_for(size_t{0}, rows.size(),
                      [&](size_t i)
                      {
                          const auto panel = static_cast<uint32_t>(i / environment.height);
                          const auto y = static_cast<uint32_t>(i % environment.height);
                          rows[i] = is_cube ? projectCubeRow(environment, panel, y)
                                            : projectLatLongRow(environment, columns, y);
                      });
    Harmonics sum{};
    for (const Harmonics& row : rows)
        for (size_t i = 0; i < sum.size(); ++i)
            sum[i] = sum[i] + row[i];
    return sum;
}

Double3 harmonicIrradiance(const Harmonics& radiance, Double3 normal)
{
    const HarmonicValues harmonics = makeHarmonics(evaluateMonomials(normal));
    Double3 sum;
    for (size_t i = 0; i < radiance.size(); ++i)
        sum = sum + radiance[i] * (harmonics[i] * (i == 0 ? kCosine0 : i < 4 ? kCosine1 : kCosine2));
    return sum;
}

Double3 meanIrradiance(const Harmonics& radiance)
{
    return radiance[0] * (kCosine0 * std::sqrt(1 / (4 * kPi)));
}

double minIrradiance(const Harmonics& radiance)
{
    const double degree0 = kCosine0 * std::sqrt(1 / (4 * kPi)), degree1 = kCosine1 * std::sqrt(3 / (4 * kPi)),
                 degree2 = kCosine2 * std::sqrt(15 / (4 * kPi));
    double min = std::numeric_limits<double>::infinity();
    for (double Double3::*channel : {&Double3::x, &Double3::y, &Double3::z})
    {
        const auto c = [&](size_t i) { return radiance[i].*channel; };
        const Eigen::Vector3d linear = degree1 * Eigen::Vector3d(c(2), c(1), c(3));
        const double height = c(4) / (2 * std::numbers::sqrt3);
        Eigen::Matrix3d matrix;
        matrix << c(8) / 2, c(5) / 2, c(7) / 2, //
            c(5) / 2, 3 * height, c(6) / 2,     //
            c(7) / 2, c(6) / 2, -c(8) / 2;
        min = std::min(min, degree0 * c(0) - degree2 * height + minOnSphere(degree2 * matrix, linear));
    }
    return min;
}

WindowedHarmonics windowHarmonics(const Harmonics& radiance)
{
    if (minIrradiance(radiance) >= 0)
        return {radiance, 0};
    double low = 0, high = 1;
    while (minIrradiance(attenuate(radiance, high)) < 0 && high < 1e6)
        high *= 2;
    constexpr int kSteps = 50;
    for (int step = 0; step < kSteps; ++step)
    {
        const double middle = (low + high) / 2;
        (minIrradiance(attenuate(radiance, middle)) < 0 ? low : high) = middle;
    }
    return {attenuate(radiance, high), high};
}

} // namespace hearth::probes
