// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/mesh_fit.h"

#include "cook/visibility/fit/finer_levels.h"
#include "formats/base/index.h"
#include "formats/codecs/visibility_code.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

/// Moments of the vertices of each level, and of each vertex whether they are interpolated for the normal as
/// it is stored: those of others are about the source's normal.
struct LevelMoments
{
    std::vector<std::vector<Moments>> moments;
    std::vector<std::vector<uint8_t>> is_about_stored_normal;
};

/// Samples of a mesh on the surface that is fitted.
struct FittedSamples
{
    std::vector<SurfaceSample> samples;
    std::vector<Moments> values;
    std::vector<SecondMoments> second;
    LevelFitSettings settings;
};

/// Move samples to the proxy, if they are not there yet. Samples without a place on it are left out.
FittedSamples moveToProxy(const SampledMesh& mesh, LevelFitSettings settings)
{
    const LevelArrays& level = mesh.levels[mesh.has_samples_on_proxy ? 0 : mesh.sampled_level];
    const MeshView from = level.mesh().mesh, to = mesh.proxy->mesh().mesh;
    settings.fit.alpha *= settings.alphaFactor(static_cast<double>(to.triangleCount()) /
                                               static_cast<double>(from.triangleCount()));
    if (mesh.has_samples_on_proxy)
        return {{mesh.samples.begin(), mesh.samples.end()}, mesh.seen.moments, mesh.seen.second, settings};
    FittedSamples moved{{}, {}, {}, settings};
    const std::vector<SurfaceSample> places = moveSamples(from, mesh.samples, to, double{mesh.proxy->reach});
    for (size_t s = 0; s < places.size(); ++s)
    {
        if (places[s].triangle == kInvalidIndex)
            continue;
        moved.samples.push_back(places[s]);
        moved.values.push_back(mesh.seen.moments[s]);
        if (!mesh.seen.second.empty())
            moved.second.push_back(mesh.seen.second[s]);
    }
    return moved;
}

/// Return the normals of a level's vertices as the source has them.
std::vector<Float3> findExactNormals(const LevelArrays& level, const SourceNormals& normals)
{
    std::vector<Float3> exact(level.normals.size());
    tbb::parallel_for(size_t{0}, exact.size(),
                      [&](size_t v) { exact[v] = normals.find(level.positions[v], level.normals[v]); });
    return exact;
}

class MeshFitter
{
public:
    MeshFitter(const SampledMesh& mesh, const MeshFitSettings& settings) : mesh_(mesh), settings_(settings) {}

    MeshFit run()
    {
        const LevelMoments moments = mesh_.proxy != nullptr ? fitProxy() : fitSampledLevels();
        encode(moments);
        return std::move(fit_);
    }

private:
    /// Fit the sampled level and coarser ones, and interpolate finer ones.
    LevelMoments fitSampledLevels()
    {
        const size_t sampled = mesh_.sampled_level;
        std::vector<LevelMesh> meshes;
        for (const LevelArrays& level : mesh_.levels)
            meshes.push_back(level.mesh());
        std::vector<LevelMesh> fitted(meshes.begin() + static_cast<ptrdiff_t>(sampled), meshes.end());
        fitted.front().finer_vertex = {}; // nothing finer is fitted
        std::vector<LevelFit> fits = fitLevelMeshes(fitted, {{mesh_.samples.begin(), mesh_.samples.end()},
                                                             mesh_.seen.moments,
                                                             mesh_.seen.second,
                                                             settings_.levels});
        LevelMoments result{
            interpolateFinerLevels(std::span(meshes).first(sampled + 1), fits.front().moments),
            findInterpolated()};
        for (LevelFit& fit : fits)
            result.moments.push_back(std::move(fit.moments));
        return result;
    }

    /// Fit the proxy, and interpolate all levels, about the source's normals.
    LevelMoments fitProxy()
    {
        const LevelMesh proxy = mesh_.proxy->mesh();
        const std::vector<LevelFit> fits = fitLevelMeshes({&proxy, 1}, moveToProxy(mesh_, settings_.levels));
        std::vector<std::vector<Float3>> normals;
        std::vector<std::vector<uint32_t>> first; // vertices that a fit merges have one value here, too
        std::vector<LevelMesh> meshes;
        LevelMoments result;
        for (const LevelArrays& level : mesh_.levels)
        {
            normals.push_back(findExactNormals(level, mesh_.normals));
            meshes.push_back(level.mesh());
            meshes.back().mesh.normals = normals.back();
            first.push_back(findMergedVertices(meshes.back().mesh, settings_.levels.fit_mesh));
            meshes.back().first_copy = first.back();
            result.is_about_stored_normal.emplace_back(level.positions.size(), 0);
        }
        meshes.push_back(proxy);
        result.moments = interpolateFinerLevels(meshes, fits.front().moments);
        return result;
    }

    std::vector<LevelFit> fitLevelMeshes(std::span<const LevelMesh> levels, const FittedSamples& samples)
    {
        MeshFitStatistics& statistics = fit_.statistics;
        std::vector<LevelFit> fits = fitLevels(levels, samples.samples, samples.values, samples.settings);
        if (settings_.refine_cones)
            statistics.refined =
                refineLevels(levels, samples.samples, samples.second, samples.settings, fits);
        if (settings_.estimate_error)
            statistics.ao_error = estimateNoise(levels.front(), samples);
        statistics.fit_mesh = fits.front().fit_mesh;
        for (const LevelFit& fit : fits)
        {
            const FitStatistics& of_level = fit.statistics;
            statistics.iterations = std::max(statistics.iterations, of_level.solve.iterations);
            statistics.condition = std::max(statistics.condition, of_level.solve.condition);
            statistics.converged = statistics.converged && of_level.solve.converged;
            statistics.vertices += of_level.vertices;
            statistics.clamped += of_level.clamped;
            statistics.unseen += of_level.unseen;
        }
        return fits;
    }

    /// Return for each vertex of each level 1, if its moments are interpolated from the sampled level.
    std::vector<std::vector<uint8_t>> findInterpolated() const
    {
        std::vector<std::vector<uint8_t>> interpolated;
        for (size_t l = 0; l < mesh_.levels.size(); ++l)
            interpolated.emplace_back(mesh_.levels[l].positions.size(), l < mesh_.sampled_level ? 1 : 0);
        for (size_t l = mesh_.sampled_level; l > 0; --l)
            for (size_t v = 0; v < interpolated[l].size(); ++v)
                if (const uint32_t finer = mesh_.levels[l].finer_vertex[v]; finer != kInvalidIndex)
                    interpolated[l - 1][finer] = interpolated[l][v];
        return interpolated;
    }

    void encode(const LevelMoments& of_levels)
    {
        for (size_t l = 0; l < mesh_.levels.size(); ++l)
            fit_.codes.push_back(encodeLevel(mesh_.levels[l], of_levels.moments[l],
                                             of_levels.is_about_stored_normal[l],
                                             l == 0 ? std::span<const uint32_t>() : fit_.codes[l - 1]));
    }

    /// Encode the moments of a level's vertices. Vertices with the moments of another one have its code.
    /// finer_codes  of the next finer level
    std::vector<uint32_t> encodeLevel(const LevelArrays& level, std::span<const Moments> moments,
                                      std::span<const uint8_t> is_about_stored_normal,
                                      std::span<const uint32_t> finer_codes) const
    {
        std::vector<uint32_t> codes(level.positions.size());
        const auto encodeVertex = [&](size_t v)
        {
            if (level.first_copy[v] != v)
                return;
            if (!level.finer_vertex.empty() && level.finer_vertex[v] != kInvalidIndex)
            {
                codes[v] = finer_codes[level.finer_vertex[v]];
                return;
            }
            const Float3 normal = level.normals[v];
            const Float3 exact =
                is_about_stored_normal[v] != 0 ? normal : mesh_.normals.find(level.positions[v], normal);
            codes[v] = formats::encodeVisibility(moments[v].m0, turnWithNormal(moments[v].m1, exact, normal),
                                                 normal);
        };
        tbb::parallel_for(size_t{0}, codes.size(), encodeVertex);
        for (size_t v = 0; v < codes.size(); ++v)
            codes[v] = codes[level.first_copy[v]];
        return codes;
    }

    /// Estimate the noise of ambient occlusion. Two fits, each to every other sample, differ by twice the
    /// noise of the fit to both: the noise of their rays, and of the samples' positions.
    static double estimateNoise(const LevelMesh& level, const FittedSamples& all)
    {
        std::array<std::vector<Moments>, 2> fitted;
        for (size_t half = 0; half < 2; ++half)
        {
            std::vector<SurfaceSample> subset;
            std::vector<Moments> values;
            for (size_t s = half; s < all.samples.size(); s += 2)
            {
                subset.push_back(all.samples[s]);
                subset.back().area *= 2; // each half represents the whole surface
                values.push_back(all.values[s]);
            }
            fitted[half] = std::move(fitLevels({&level, 1}, subset, values, all.settings).front().moments);
        }
        const std::span<const Float3> normals = level.mesh.normals;
        double sum = 0;
        for (size_t v = 0; v < normals.size(); ++v)
        {
            const double difference =
                dot(normals[v], fitted[0][v].m1 - fitted[1][v].m1) / (2 * std::numbers::pi);
            sum += difference * difference;
        }
        return std::sqrt(sum / static_cast<double>(std::max<size_t>(normals.size(), 1)));
    }

    const SampledMesh& mesh_;
    const MeshFitSettings& settings_;
    MeshFit fit_;
};

} // namespace

MeshFit fitMesh(const SampledMesh& mesh, const MeshFitSettings& settings)
{
    return MeshFitter(mesh, settings).run();
}

} // namespace hearth::visibility
