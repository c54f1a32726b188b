// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/cone_refine.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <ceres/autodiff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/sphere_manifold.h>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Narrower cones have no visible effect on shading, and at 0 all derivatives vanish.
constexpr double kMinAperture = 1e-3;

// Stops the solver where errors are a quarter of a thousandth of full visibility's norm, far below any noise.
constexpr double kFunctionTolerance = 1e-10;

template <typename T>
std::array<T, 9> evaluateBasis(const T& x, const T& y, const T& z)
{
    const double band1 = std::sqrt(3 / (4 * std::numbers::pi)),
                 band2 = std::sqrt(15 / (4 * std::numbers::pi));
    const double zonal2 = std::sqrt(5 / (16 * std::numbers::pi));
    return {T(1 / std::sqrt(4 * std::numbers::pi)),
            y * band1,
            z * band1,
            x * band1,
            x * y * band2,
            y * z * band2,
            (z * z * 3.0 - 1.0) * zonal2,
            x * z * band2,
            (x * x - y * y) * (band2 / 2)};
}

/// Compute c_lm = z_l sqrt(4 pi / (2 l + 1)) Y_lm(axis), with the zonal harmonics z_l of a cone about +z.
template <typename T>
std::array<T, 9> coneHarmonics(const T* axis, const T& aperture, const T& scale)
{
    using std::cos, std::sin;
    const T c = cos(aperture), s = sin(aperture);
    const T band0 = scale * (1.0 - c) * (2 * std::numbers::pi);
    const T band1 = scale * s * s * std::numbers::pi;
    const T band2 = c * band1;
    std::array<T, 9> result = evaluateBasis(axis[0], axis[1], axis[2]);
    result[0] = result[0] * band0;
    for (size_t i = 1; i < 4; ++i)
        result[i] = result[i] * band1;
    for (size_t i = 4; i < 9; ++i)
        result[i] = result[i] * band2;
    return result;
}

struct HarmonicsResidual
{
    Sh9 visibility;

    template <typename T>
    bool operator()(const T* axis, const T* shape, T* residuals) const
    {
        const std::array<T, 9> cone = coneHarmonics(axis, shape[0], shape[1]);
        for (size_t i = 0; i < 9; ++i)
            residuals[i] = cone[i] - visibility[i];
        return true;
    }
};

double distance2(const Sh9& a, const Sh9& b)
{
    double sum = 0;
    for (size_t i = 0; i < 9; ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

ConeFit solveFrom(const Sh9& visibility, const ConeFit& start)
{
    std::array<double, 3> axis{start.axis.x, start.axis.y, start.axis.z};
    std::array<double, 2> shape{std::clamp(start.aperture_rad, kMinAperture, std::numbers::pi / 2),
                                std::clamp(start.scale, 0.0, 1.0)};
    ceres::Problem problem;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<HarmonicsResidual, 9, 3, 2>(new HarmonicsResidual{visibility}),
        nullptr, axis.data(), shape.data());
    problem.SetManifold(axis.data(), new ceres::SphereManifold<3>);
    problem.SetParameterLowerBound(shape.data(), 0, kMinAperture);
    problem.SetParameterUpperBound(shape.data(), 0, std::numbers::pi / 2);
    problem.SetParameterLowerBound(shape.data(), 1, 0);
    problem.SetParameterUpperBound(shape.data(), 1, 1);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    options.max_num_iterations = 100;
    options.function_tolerance = kFunctionTolerance;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return {{axis[0], axis[1], axis[2]}, shape[0], shape[1]};
}

} // namespace

Sh9 sphericalHarmonics(Double3 direction)
{
    return evaluateBasis(direction.x, direction.y, direction.z);
}

Sh9 computeHarmonics(const ConeFit& cone)
{
    const std::array<double, 3> axis{cone.axis.x, cone.axis.y, cone.axis.z};
    return coneHarmonics(axis.data(), cone.aperture_rad, cone.scale);
}

RefinedCone refineCone(const Sh9& visibility, const ConeFit& start, Double3 normal)
{
    RefinedCone best{start, distance2(computeHarmonics(start), visibility), 0};
    best.distance2 = best.start_distance2;
    ConeFit about_normal = start;
    about_normal.axis = normal;
    for (const ConeFit& from : {start, about_normal})
    {
        const ConeFit found = solveFrom(visibility, from);
        if (const double remaining = distance2(computeHarmonics(found), visibility);
            remaining < best.distance2)
        {
            best.cone = found;
            best.distance2 = remaining;
        }
    }
    return best;
}

RefinedCones refineCones(std::span<const Sh9> visibility, std::span<const ConeFit> starts,
                         std::span<const Float3> normals)
{
    HEARTH_ASSERT(starts.size() == visibility.size() && normals.size() == visibility.size());
    std::vector<RefinedCone> refined(visibility.size());
    tbb::parallel_for(size_t{0}, refined.size(),
                      [&](size_t i)
                      { refined[i] = refineCone(visibility[i], starts[i], widen(normals[i])); });
    RefinedCones result;
    for (const RefinedCone& cone : refined)
    {
        result.cones.push_back(cone.cone);
        result.statistics.start_rms += cone.start_distance2;
        result.statistics.rms += cone.distance2;
    }
    const double count = std::max<double>(1, static_cast<double>(refined.size()));
    result.statistics.start_rms = std::sqrt(result.statistics.start_rms / count);
    result.statistics.rms = std::sqrt(result.statistics.rms / count);
    return result;
}

} // namespace hearth::visibility
