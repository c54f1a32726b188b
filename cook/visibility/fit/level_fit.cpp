// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/level_fit.h"

#include "cook/mesh/closest_point.h"
#include "cook/visibility/fit/block4.h"
#include "formats/base/assert.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Samples that are looked up in sequence; each search starts at the triangle that the previous one found.
constexpr size_t kSamplesPerTask = 256;

// Default of LevelMesh::reach (stored as 0), as a share of the diagonal of the finest level's box.
constexpr double kDefaultReach = 0.05;

double computeDiagonal(const MeshView& mesh)
{
    Box3 box;
    for (const Float3 p : mesh.positions)
        box.add(p);
    return box.empty() ? 0 : double{length(box.max - box.min)};
}

/// Fixed values of fit mesh vertices that keep shared vertices equal to those of the finer level.
struct HeldValues
{
    std::vector<uint8_t> is_held;
    std::vector<Moments> moments;
};

HeldValues collectHeldValues(const LevelMesh& level, const FitMesh& fit_mesh, std::span<const Moments> finer)
{
    HeldValues held{std::vector<uint8_t>(fit_mesh.positions.size(), 0),
                    std::vector<Moments>(fit_mesh.positions.size())};
    for (size_t v = 0; v < level.finer_vertex.size(); ++v)
    {
        const Binding& binding = fit_mesh.bindings[v];
        const bool is_one =
            binding.vertices[0] != kInvalidIndex && binding.vertices[0] == binding.vertices[1];
        if (level.finer_vertex[v] == kInvalidIndex || !is_one || held.is_held[binding.vertices[0]] != 0)
            continue;
        held.is_held[binding.vertices[0]] = 1;
        held.moments[binding.vertices[0]] = finer[level.finer_vertex[v]];
    }
    return held;
}

LevelFit fitLevel(const LevelMesh& level, const FitMesh& fit_mesh, std::span<const SurfaceSample> samples,
                  std::span<const Moments> values, const FitSettings& settings,
                  std::span<const Moments> finer)
{
    const HeldValues held = collectHeldValues(level, fit_mesh, finer);
    FitResult fit = fitVertices(fit_mesh, samples, values, settings, {held.is_held, held.moments});
    LevelFit result{mapValuesToSource(fit_mesh, fit.moments, level.mesh.normals), fit.statistics,
                    fit_mesh.statistics, static_cast<uint32_t>(samples.size())};
    // several vertices of a level may share one fit mesh vertex where the finer level had two
    for (size_t v = 0; v < level.finer_vertex.size(); ++v)
        if (level.finer_vertex[v] != kInvalidIndex)
            result.moments[v] = finer[level.finer_vertex[v]];
    return result;
}

} // namespace

std::vector<SurfaceSample> moveSamples(const MeshView& from, std::span<const SurfaceSample> samples,
                                       const MeshView& to, double reach)
{
    const mesh::ClosestPoint surface(to, to.triangleCount());
    std::vector<SurfaceSample> result(samples.size());
    const auto move = [&](const SurfaceSample& sample, uint32_t hint)
    {
        const uint32_t* corners = from.indices.data() + size_t{sample.triangle} * 3;
        const Float3 a = from.positions[corners[0]];
        const Float3 ab = from.positions[corners[1]] - a, ac = from.positions[corners[2]] - a;
        const mesh::ClosestPoint::Hit found =
            surface.find(a + ab * sample.u + ac * sample.v, cross(ab, ac), reach * reach, hint);
        return SurfaceSample{found.triangle, found.u, found.v, sample.area, sample.weight};
    };
    tbb::parallel_for(size_t{0}, (result.size() + kSamplesPerTask - 1) / kSamplesPerTask,
                      [&](size_t block)
                      {
                          uint32_t hint = kInvalidIndex;
                          const size_t end = std::min(result.size(), (block + 1) * kSamplesPerTask);
                          for (size_t i = block * kSamplesPerTask; i < end; ++i)
                          {
                              result[i] = move(samples[i], hint);
                              if (result[i].triangle != kInvalidIndex)
                                  hint = result[i].triangle;
                          }
                      });
    return result;
}

SampledValues averageByTriangle(std::span<const SurfaceSample> samples, std::span<const Moments> values,
                                size_t triangle_count)
{
    struct Sum
    {
        double area = 0, weighted_area = 0, u = 0, v = 0;
        Block4 moments;
    };
    std::vector<Sum> sums(triangle_count);
    for (size_t s = 0; s < samples.size(); ++s)
    {
        const SurfaceSample& sample = samples[s];
        if (sample.triangle == kInvalidIndex)
            continue;
        const double weighted_area = double{sample.area} * double{sample.weight};
        Sum& sum = sums[sample.triangle];
        sum.area += double{sample.area};
        sum.weighted_area += weighted_area;
        sum.u += weighted_area * double{sample.u};
        sum.v += weighted_area * double{sample.v};
        sum.moments.addScaled(blockFromMoments(values[s]), weighted_area);
    }
    SampledValues means;
    for (uint32_t triangle = 0; triangle < triangle_count; ++triangle)
    {
        const Sum& sum = sums[triangle];
        if (!(sum.weighted_area > 0))
            continue;
        const auto mean = [&](double value) { return static_cast<float>(value / sum.weighted_area); };
        means.samples.push_back({triangle, mean(sum.u), mean(sum.v), static_cast<float>(sum.area),
                                 static_cast<float>(sum.weighted_area / sum.area)});
        Block4 moments;
        moments.addScaled(sum.moments, 1 / sum.weighted_area);
        means.values.push_back(momentsFromBlock(moments));
    }
    return means;
}

std::vector<LevelFit> fitLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                                std::span<const Moments> values, const LevelFitSettings& settings)
{
    HEARTH_ASSERT(!levels.empty() && levels[0].finer_vertex.empty() && samples.size() == values.size());
    std::vector<LevelFit> fits;
    FitMesh fit_mesh = makeFitMesh(levels[0].mesh, settings.fit_mesh);
    SampledValues on_level{mapSamplesToFitMesh(fit_mesh, levels[0].mesh, samples),
                           {values.begin(), values.end()}};
    fits.push_back(fitLevel(levels[0], fit_mesh, on_level.samples, on_level.values, settings.fit, {}));
    const auto finest_count = static_cast<double>(std::max<size_t>(1, fit_mesh.positions.size()));
    const double default_reach = computeDiagonal(levels[0].mesh) * kDefaultReach;
    for (const LevelMesh& level : levels.subspan(1))
    {
        HEARTH_ASSERT(level.finer_vertex.empty() || level.finer_vertex.size() == level.mesh.positions.size());
        const FitMesh finer = std::move(fit_mesh);
        on_level = averageByTriangle(on_level.samples, on_level.values, finer.indices.size() / 3);
        fit_mesh = makeFitMesh(level.mesh, settings.fit_mesh);
        const double reach = level.reach > 0 ? double{level.reach} : default_reach;
        on_level.samples = moveSamples(finer.view(), on_level.samples, fit_mesh.view(), reach);
        FitSettings fit = settings.fit;
        fit.alpha *= settings.alphaFactor(static_cast<double>(fit_mesh.positions.size()) / finest_count);
        fits.push_back(
            fitLevel(level, fit_mesh, on_level.samples, on_level.values, fit, fits.back().moments));
    }
    return fits;
}

} // namespace hearth::visibility
