// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/fit.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace hearth::specular
{

namespace
{

using Constants = std::array<double, 8>;
static_assert(sizeof(shared::SpecularFit) == 8 * sizeof(float));

shared::SpecularFit narrow(const double* constants)
{
    std::array<float, 8> values{};
    std::transform(constants, constants + values.size(), values.begin(),
                   [](double value) { return static_cast<float>(value); });
    return std::bit_cast<shared::SpecularFit>(values);
}

struct Residual
{
    const Configuration* configuration;
    double exact;

    bool operator()(const double* constants, double* residual) const
    {
        *residual = double{fitOcclusion(*configuration, narrow(constants))} - exact;
        return true;
    }
};

} // namespace

ConstantsFit fitConstants(size_t configuration_count, uint64_t seed, Masking masking)
{
    const std::vector<Configuration> configurations = randomConfigurations(configuration_count, seed);
    std::vector<double> exact(configurations.size());
    tbb::parallel_for(size_t{0}, exact.size(),
                      [&](size_t i) { exact[i] = exactOcclusion(configurations[i], masking); });

    const auto start = std::bit_cast<std::array<float, 8>>(shared::kSpecularFit);
    Constants constants{};
    std::copy(start.begin(), start.end(), constants.begin());
    // the shader's code computes in floats: steps must be far above their rounding
    ceres::NumericDiffOptions steps;
    steps.relative_step_size = 1e-2;
    ceres::Problem problem;
    for (size_t i = 0; i < exact.size(); ++i)
        problem.AddResidualBlock(
            new ceres::NumericDiffCostFunction<Residual, ceres::CENTRAL, 1, 8>(
                new Residual{&configurations[i], exact[i]}, ceres::TAKE_OWNERSHIP, 1, steps),
            nullptr, constants.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    const auto rms = [&](double cost) { return std::sqrt(2 * cost / static_cast<double>(exact.size())); };
    return {narrow(constants.data()), static_cast<int>(summary.iterations.size()), rms(summary.initial_cost),
            rms(summary.final_cost)};
}

std::string formatConstants(const shared::SpecularFit& fit)
{
    const auto values = std::bit_cast<std::array<float, 8>>(fit);
    std::string text = "SpecularFit(";
    for (size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{}{:.4f}f", i == 0 ? "" : ", ", values[i]);
    return text + ")";
}

} // namespace hearth::specular
