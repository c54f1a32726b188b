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

/// Return the number of triangles up to which meshes get all their rays.
/// counts          triangles of the finest levels
/// all_per_triangle  rays that a mesh asks for by its triangles
double solveThreshold(std::vector<double> counts, double all_per_triangle, double budget)
{
    std::sort(counts.begin(), counts.end());
    double roots = 0; // of the larger meshes
    for (const double count : counts)
        roots += std::sqrt(count);
    double rays = 0; // of the smaller meshes
    for (const double count : counts)
    {
        // if this mesh and all larger ones get all_per_triangle * sqrt(threshold * count)
        const double root = (budget - rays) / (all_per_triangle * roots);
        if (root < std::sqrt(count))
            return root * root;
        rays += all_per_triangle * count;
        roots -= std::sqrt(count);
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
                                       const SamplingSettings& settings, std::span<const uint32_t> originals)
{
    const auto findOriginal = [&](uint32_t mesh) { return originals.empty() ? mesh : originals[mesh]; };
    std::vector<double> copies(triangles.size()); // of each original, itself included
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
        ++copies[findOriginal(mesh)];
    std::vector<double> counts; // of each mesh together with its copies
    double total = 0;
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
        if (findOriginal(mesh) == mesh && !triangles[mesh].empty() && triangles[mesh][0] > 0)
        {
            counts.push_back(copies[mesh] * static_cast<double>(triangles[mesh][0]));
            total += counts.back();
        }
    const double all_per_triangle = std::max(settings.samples_per_vertex, kMinSamplesPerVertex) *
                                    settings.rays_per_sample / kTrianglesPerVertex;
    const double threshold = solveThreshold(
        counts, all_per_triangle, std::max(settings.max_rays, settings.max_rays_per_triangle * total));
    std::vector<MeshSampling> plan;
    for (uint32_t mesh = 0; mesh < triangles.size(); ++mesh)
    {
        const std::vector<uint64_t>& levels = triangles[mesh];
        const double alike = copies[findOriginal(mesh)];
        const double count = levels.empty() ? 0 : alike * static_cast<double>(levels[0]);
        if (count <= threshold)
            plan.push_back({0, settings.samples_per_vertex, settings.rays_per_sample});
        else
            plan.push_back(
                chooseLevel(levels, all_per_triangle * std::sqrt(threshold * count) / alike, settings));
    }
    return plan;
}

} // namespace hearth::visibility
