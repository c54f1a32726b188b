// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/vertex_fit.h"

#include "cook/visibility/fit/normal_equations.h"
#include "cook/visibility/mesh/moment_clamp.h"
#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::visibility
{

namespace
{

/// State of each vertex before the system is solved: true if it is fixed, and the start value of the solver.
struct StartState
{
    std::vector<uint8_t> fixed;
    std::vector<Block4> values;
    uint32_t unseen = 0;
};

/// Compute the start values: the mean of the samples around each vertex; without samples, the mean of its
/// island (connected component). An island without samples and without a held vertex is taken for open.
StartState computeStart(const FitMesh& fit_mesh, const NormalEquations& system, const HeldVertices& held)
{
    const size_t count = fit_mesh.positions.size();
    StartState start{std::vector<uint8_t>(count, 0), std::vector<Block4>(count), 0};
    std::vector<Block4> island_sums(count);
    std::vector<double> island_mass(count, 0);
    const auto isHeld = [&](size_t v) { return !held.is_held.empty() && held.is_held[v] != 0; };
    for (size_t v = 0; v < count; ++v)
    {
        const uint32_t island = system.island[v];
        island_sums[island].addScaled(system.right[v], 1);
        island_mass[island] += system.mass[v];
    }
    // held vertices determine an island without samples
    for (size_t v = 0; v < count; ++v)
        if (isHeld(v) && island_mass[system.island[v]] <= 0)
        {
            island_sums[system.island[v]] = blockFromMoments(held.moments[v]);
            island_mass[system.island[v]] = 1;
        }
    for (size_t v = 0; v < count; ++v)
    {
        const uint32_t island = system.island[v];
        if (isHeld(v))
        {
            start.fixed[v] = 1;
            start.values[v] = blockFromMoments(held.moments[v]);
        }
        else if (system.mass[v] > 0)
            start.values[v].addScaled(system.right[v], 1 / system.mass[v]);
        else if (island_mass[island] > 0)
            start.values[v].addScaled(island_sums[island], 1 / island_mass[island]);
        else
        {
            start.fixed[v] = 1;
            start.values[v] = blockFromMoments(openHemisphere(fit_mesh.normals[v]));
            ++start.unseen;
        }
    }
    return start;
}

/// Move fixed values to the right-hand side; their own rows become x = 0. Vertices without data and without
/// connections keep their start values.
void eliminateFixed(NormalEquations& system, StartState& start)
{
    SparseMatrix& matrix = system.matrix;
    for (size_t row = 0; row < matrix.rowCount(); ++row)
        for (uint32_t i = matrix.row_start[row]; i < matrix.row_start[row + 1]; ++i)
            if (matrix.columns[i] == row && !(matrix.values[i] > 0))
                start.fixed[row] = 1;
    for (size_t row = 0; row < matrix.rowCount(); ++row)
    {
        for (uint32_t i = matrix.row_start[row]; i < matrix.row_start[row + 1]; ++i)
        {
            const uint32_t column = matrix.columns[i];
            if (start.fixed[row] != 0)
                matrix.values[i] = column == row ? 1 : 0;
            else if (start.fixed[column] != 0)
            {
                system.right[row].addScaled(start.values[column], -matrix.values[i]);
                matrix.values[i] = 0;
            }
        }
        if (start.fixed[row] != 0)
            system.right[row] = {};
    }
}

} // namespace

FitResult fitVertices(const FitMesh& fit_mesh, std::span<const SurfaceSample> samples,
                      std::span<const Moments> values, const FitSettings& settings, const HeldVertices& held)
{
    const size_t count = fit_mesh.positions.size();
    HEARTH_ASSERT(samples.size() == values.size() && held.is_held.size() == held.moments.size());
    HEARTH_ASSERT(held.is_held.empty() || held.is_held.size() == count);
    NormalEquations system = assemble(fit_mesh, samples, values, settings);
    StartState start = computeStart(fit_mesh, system, held);
    eliminateFixed(system, start);

    FitResult result;
    FitStatistics& statistics = result.statistics;
    statistics.vertices = static_cast<uint32_t>(count);
    statistics.unseen = start.unseen;
    statistics.entries = system.matrix.columns.size();
    statistics.lost_samples = static_cast<uint32_t>(
        std::count_if(samples.begin(), samples.end(),
                      [](const SurfaceSample& sample) { return sample.triangle == kInvalidIndex; }));
    std::vector<Block4> x = start.values;
    for (size_t v = 0; v < count; ++v)
        if (start.fixed[v] != 0)
            x[v] = {};
    statistics.solve = solve(system.matrix, system.right, x, settings.tolerance, settings.max_iterations);

    result.moments.resize(count);
    for (size_t v = 0; v < count; ++v)
    {
        if (!held.is_held.empty() && held.is_held[v] != 0)
        {
            result.moments[v] = held.moments[v];
            ++statistics.held;
            continue;
        }
        result.moments[v] = momentsFromBlock(start.fixed[v] != 0 ? start.values[v] : x[v]);
        if (settings.clamp)
            statistics.clamped += clampMoments(result.moments[v], fit_mesh.normals[v]);
    }
    return result;
}

} // namespace hearth::visibility
