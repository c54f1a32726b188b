// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/sampling_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hearth::visibility
{

namespace
{

// Triangles of a closed mesh for each of its vertices.
constexpr double kTrianglesPerVertex = 2;

// Each triangle takes a sample.
constexpr double kMinSamplesPerVertex = kTrianglesPerVertex;

// Rays a sample of a mesh whose budget is less than half: cook/visibility/README.md, "The budget".
constexpr uint32_t kReducedRaysPerSample = 32;

/// Mesh together with its copies.
struct Asker
{
    double triangles; ///< of the finest levels
    double share;     ///< of the rays where they do not suffice: square root of the triangles, times a weight
};

/// Return the factor of the shares: a mesh gets all_per_triangle times it times its share, or all rays that
/// it asks for, if that is less.
/// all_per_triangle  rays that a mesh asks for by its triangles
double solveFactor(std::vector<Asker> askers, double all_per_triangle, double budget)
{
    // those that get all at the smallest factors first
    std::ranges::sort(askers, {}, [](const Asker& asker) { return asker.triangles / asker.share; });
    double shares = 0; // of the meshes that do not get all
    for (const Asker& asker : askers)
        shares += asker.share;
    double rays = 0; // of the others
    for (const Asker& asker : askers)
    {
        const double factor = (budget - rays) / (all_per_triangle * shares);
        if (factor * asker.share < asker.triangles)
            return factor;
        rays += all_per_triangle * asker.triangles;
        shares -= asker.share;
    }
    return std::numeric_limits<double>::infinity();
}

/// Choose the level and the samples of a mesh that gets fewer rays than it asks for: first down to half the
/// samples, then fewer rays a sample, then a coarser level.
MeshSampling chooseLevel(std::span<const uint64_t> triangles, double rays, const SamplingSettings& settings)
{
    MeshSampling sampling{.rays_per_sample = settings.rays_per_sample};
    const auto samplesPerVertex = [&](uint32_t level) {
        return rays * kTrianglesPerVertex /
               (sampling.rays_per_sample * static_cast<double>(triangles[level]));
    };
    if (samplesPerVertex(0) < settings.samples_per_vertex / 2)
        sampling.rays_per_sample = std::min(settings.rays_per_sample, kReducedRaysPerSample);
    // levels halve the triangles: take the one whose number of samples is nearest
    constexpr double kTooFew = kMinSamplesPerVertex / std::numbers::sqrt2;
    while (sampling.level + 1 < triangles.size() && samplesPerVertex(sampling.level) < kTooFew)
        ++sampling.level;
    sampling.samples_per_vertex = std::clamp(samplesPerVertex(sampling.level), kMinSamplesPerVertex,
                                             std::max(settings.samples_per_vertex, kMinSamplesPerVertex));
    return sampling;
}

} // namespace

std::vector<MeshSampling> planSampling(std::span<const std::vector<uint64_t>> triangles,
                                       const SamplingSettings& settings, std::span<const uint32_t> originals,
                                       std::span<const double> weights)
{
    const auto findOriginal = [&](uint32_t mesh) { return originals.empty() ? mesh : originals[mesh]; };
    std::vector<double> copies(triangles.size()); // of each original, itself included
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
        ++copies[findOriginal(mesh)];
    const auto makeAsker = [&](uint32_t mesh)
    {
        const uint32_t original = findOriginal(mesh);
        const double count =
            triangles[mesh].empty() ? 0 : copies[original] * static_cast<double>(triangles[mesh][0]);
        return Asker{count, std::sqrt(count) * (weights.empty() ? 1 : weights[original])};
    };
    std::vector<Asker> askers;
    double total = 0;
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
        if (const Asker asker = makeAsker(mesh); findOriginal(mesh) == mesh && asker.triangles > 0)
        {
            askers.push_back(asker);
            total += asker.triangles;
        }
    const double all_per_triangle = std::max(settings.samples_per_vertex, kMinSamplesPerVertex) *
                                    settings.rays_per_sample / kTrianglesPerVertex;
    const double factor = solveFactor(askers, all_per_triangle,
                                      std::max(settings.max_rays, settings.max_rays_per_triangle * total));
    std::vector<MeshSampling> plan;
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
    {
        const Asker asker = makeAsker(mesh);
        if (asker.triangles == 0 || asker.triangles <= factor * asker.share)
            plan.push_back({0, settings.samples_per_vertex, settings.rays_per_sample});
        else
            plan.push_back(chooseLevel(triangles[mesh],
                                       all_per_triangle * factor * asker.share / copies[findOriginal(mesh)],
                                       settings));
    }
    return plan;
}

} // namespace hearth::visibility
