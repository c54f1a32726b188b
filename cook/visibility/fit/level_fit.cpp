// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/level_fit.h"

#include "cook/visibility/mesh/closest_point.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Samples that are looked up in sequence; each search starts at the triangle that the previous one found.
constexpr size_t kSamplesPerTask = 256;

// Default of LevelMesh::reach (stored as 0), as a share of the diagonal of the samples' box.
constexpr double kDefaultReach = 0.05;

/// Positions of the samples, with the directions that their triangles face.
struct SampleGeometry
{
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< not of length 1
    std::vector<float> weights;
    double diagonal = 0;
};

SampleGeometry computeSampleGeometry(const MeshView& mesh, std::span<const SurfaceSample> samples)
{
    SampleGeometry points;
    points.positions.resize(samples.size());
    points.normals.resize(samples.size());
    points.weights.resize(samples.size());
    tbb::parallel_for(size_t{0}, samples.size(),
                      [&](size_t i)
                      {
                          const SurfaceSample& sample = samples[i];
                          const uint32_t* corners = mesh.indices.data() + size_t{sample.triangle} * 3;
                          const Float3 a = mesh.positions[corners[0]];
                          const Float3 ab = mesh.positions[corners[1]] - a,
                                       ac = mesh.positions[corners[2]] - a;
                          points.positions[i] = a + ab * sample.u + ac * sample.v;
                          points.normals[i] = cross(ab, ac);
                          points.weights[i] = sample.weight;
                      });
    Box3 box;
    for (const Float3 p : points.positions)
        box.add(p);
    points.diagonal = box.empty() ? 0 : double{length(box.max - box.min)};
    return points;
}

/// Map the chosen samples of the finest level to a level's proxy.
std::vector<SurfaceSample> moveSamples(const SampleGeometry& points, const SampleSubset& choice,
                                       const Proxy& proxy, double reach)
{
    const ClosestPoint surface(proxy.view(), proxy.indices.size() / 3);
    std::vector<SurfaceSample> result(choice.samples.size());
    tbb::parallel_for(
        size_t{0}, (result.size() + kSamplesPerTask - 1) / kSamplesPerTask,
        [&](size_t block)
        {
            uint32_t hint = kInvalidIndex;
            for (size_t i = block * kSamplesPerTask;
                 i < std::min(result.size(), (block + 1) * kSamplesPerTask); ++i)
            {
                const uint32_t sample = choice.samples[i];
                const ClosestPoint::Hit found =
                    surface.find(points.positions[sample], points.normals[sample], reach * reach, hint);
                result[i] = {found.triangle, found.u, found.v, choice.areas[i], points.weights[sample]};
                if (found.triangle != kInvalidIndex)
                    hint = found.triangle;
            }
        });
    return result;
}

/// Fixed values of proxy vertices that keep shared vertices equal to those of the finer level.
struct HeldValues
{
    std::vector<uint8_t> is_held;
    std::vector<Moments> moments;
};

HeldValues collectHeldValues(const LevelMesh& level, const Proxy& proxy, std::span<const Moments> finer)
{
    HeldValues held{std::vector<uint8_t>(proxy.positions.size(), 0),
                    std::vector<Moments>(proxy.positions.size())};
    for (size_t v = 0; v < level.finer_vertex.size(); ++v)
    {
        const Binding& binding = proxy.bindings[v];
        const bool is_one =
            binding.vertices[0] != kInvalidIndex && binding.vertices[0] == binding.vertices[1];
        if (level.finer_vertex[v] == kInvalidIndex || !is_one || held.is_held[binding.vertices[0]] != 0)
            continue;
        held.is_held[binding.vertices[0]] = 1;
        held.moments[binding.vertices[0]] = finer[level.finer_vertex[v]];
    }
    return held;
}

LevelFit fitLevel(const LevelMesh& level, const Proxy& proxy, std::span<const SurfaceSample> samples,
                  std::span<const Moments> values, const FitSettings& settings,
                  std::span<const Moments> finer)
{
    const HeldValues held = collectHeldValues(level, proxy, finer);
    FitResult fit = fitVertices(proxy, samples, values, settings, {held.is_held, held.moments});
    LevelFit result{mapValuesToSource(proxy, fit.moments, level.mesh.normals), fit.statistics,
                    proxy.statistics, static_cast<uint32_t>(samples.size())};
    // several vertices of a level may share one proxy vertex where the finer level had two
    for (size_t v = 0; v < level.finer_vertex.size(); ++v)
        if (level.finer_vertex[v] != kInvalidIndex)
            result.moments[v] = finer[level.finer_vertex[v]];
    return result;
}

} // namespace

SampleSubset chooseSamples(std::span<const SurfaceSample> samples, size_t count)
{
    SampleSubset choice;
    if (samples.size() <= count)
    {
        choice.samples.resize(samples.size());
        std::iota(choice.samples.begin(), choice.samples.end(), 0u);
        for (const SurfaceSample& sample : samples)
            choice.areas.push_back(sample.area);
        return choice;
    }
    double total = 0;
    for (const SurfaceSample& sample : samples)
        total += sample.area;
    const double step = total / static_cast<double>(count);
    double accumulated = 0;
    size_t next = 0;
    for (uint32_t i = 0; i < samples.size(); ++i)
    {
        accumulated += samples[i].area;
        const size_t before = next;
        while (next < count && (static_cast<double>(next) + 0.5) * step < accumulated)
            ++next;
        if (next == before)
            continue;
        choice.samples.push_back(i);
        choice.areas.push_back(static_cast<float>(static_cast<double>(next - before) * step));
    }
    return choice;
}

std::vector<LevelFit> fitLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                                std::span<const Moments> values, const LevelFitSettings& settings)
{
    HEARTH_ASSERT(!levels.empty() && levels[0].finer_vertex.empty() && samples.size() == values.size());
    std::vector<LevelFit> fits;
    const Proxy finest = makeProxy(levels[0].mesh, settings.proxy);
    fits.push_back(fitLevel(levels[0], finest, mapSamplesToProxy(finest, levels[0].mesh, samples), values,
                            settings.fit, {}));
    const SampleGeometry points = computeSampleGeometry(levels[0].mesh, samples);
    for (const LevelMesh& level : levels.subspan(1))
    {
        HEARTH_ASSERT(level.finer_vertex.empty() || level.finer_vertex.size() == level.mesh.positions.size());
        const Proxy proxy = makeProxy(level.mesh, settings.proxy);
        const double vertex_ratio = static_cast<double>(proxy.positions.size()) /
                                    static_cast<double>(std::max<size_t>(1, finest.positions.size()));
        FitSettings fit = settings.fit;
        fit.alpha *= std::clamp(vertex_ratio * vertex_ratio, settings.min_alpha_factor, 1.0);
        const SampleSubset choice =
            chooseSamples(samples, proxy.positions.size() * settings.samples_per_vertex);
        const double reach = level.reach > 0 ? double{level.reach} : points.diagonal * kDefaultReach;
        std::vector<Moments> chosen;
        chosen.reserve(choice.samples.size());
        for (const uint32_t sample : choice.samples)
            chosen.push_back(values[sample]);
        fits.push_back(fitLevel(level, proxy, moveSamples(points, choice, proxy, reach), chosen, fit,
                                fits.back().moments));
    }
    return fits;
}

} // namespace hearth::visibility
