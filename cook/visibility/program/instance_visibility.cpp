// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/instance_visibility.h"

#include "cook/sampling/owen_sobol.h"
#include "cook/visibility/fit/visibility_factor.h"
#include "formats/base/affine3d.h"
#include "formats/base/assert.h"
#include "formats/base/half.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Rays of each of the two sets at a point, and points of an instance.
constexpr uint32_t kSetRays = 16;
constexpr uint32_t kMinInstancePoints = 8;
constexpr uint32_t kMaxInstancePoints = 64;

// An instance has a factor of its own where that lowers the rms error of its ambient occlusion by more.
constexpr double kMinGain = 0.01;

constexpr double kPointRays = 2.0 * kSetRays;

double rms(double mean_square)
{
    return std::sqrt(std::max(mean_square, 0.0)); // noise may leave less than 0
}

/// Trace the rays of all points, and fit a factor to each run of points.
/// groups  of instances, whose middle ones are traced
std::vector<VisibilityFactor> fitGroups(const Occluders& world, const SampledSurface& surface,
                                        std::span<const ChosenSample> chosen,
                                        std::span<const std::span<const MeshInstance>> groups,
                                        RaySettings settings)
{
    std::vector<SamplePoint> points;
    for (const std::span<const MeshInstance> group : groups)
    {
        const std::vector<SamplePoint> placed =
            placeSamples(surface, chosen, group[group.size() / 2].world_from_mesh);
        points.insert(points.end(), placed.begin(), placed.end());
    }
    settings.rays_per_sample = kSetRays;
    settings.seed = sampling::deriveSeed(settings.seed, 0); // others than those of the mesh's samples
    const auto first = visibilityMoments(world, points, settings);
    settings.first_ray += kSetRays;
    const auto second = visibilityMoments(world, points, settings);
    std::vector<VisibilityFactor> factors;
    std::vector<FactorSample> samples(chosen.size());
    for (size_t g = 0; g < groups.size(); ++g)
    {
        const auto mesh_from_world = inverted(widened(groups[g][groups[g].size() / 2].world_from_mesh));
        HEARTH_ASSERT(mesh_from_world.has_value());
        for (size_t i = 0; i < chosen.size(); ++i)
        {
            const size_t point = g * chosen.size() + i;
            samples[i] = {points[point].normal,
                          placeMoments(surface.moments[chosen[i].sample], *mesh_from_world),
                          {(*first)[point], (*second)[point]}};
        }
        factors.push_back(fitFactor(samples));
    }
    return factors;
}

} // namespace

shared::VisibilityMoments placeMoments(const Moments& moments, const Affine3d& mesh_from_world)
{
    // as normals, with the length kept: runtime/shaders/scene/resolve.glsl
    const auto& m = mesh_from_world.m;
    const Float3 v = moments.m1;
    const auto row = [&](size_t i)
    { return static_cast<float>(m[0][i] * double{v.x} + m[1][i] * double{v.y} + m[2][i] * double{v.z}); };
    return {moments.m0, normalizeOr({row(0), row(1), row(2)}, {}) * length(v)};
}

InstanceSpread fitInstances(const Occluders& world, const SampledSurface& surface,
                            std::span<const MeshInstance> instances, double max_rays, RaySettings settings,
                            std::span<SurroundingsRecord> records)
{
    const auto count = static_cast<double>(instances.size());
    const double group_count = std::clamp(max_rays / (kMinInstancePoints * kPointRays), 1.0, count);
    const auto points = static_cast<uint32_t>(std::clamp(
        max_rays / group_count / kPointRays, double{kMinInstancePoints}, double{kMaxInstancePoints}));
    std::vector<double> rates(surface.samples.size());
    std::ranges::transform(surface.interior, rates.begin(),
                           [](uint8_t is_interior) { return is_interior != 0 ? 0.0 : 1.0; });
    const std::vector<ChosenSample> chosen = chooseSamples(surface, rates, points);
    std::vector<MeshInstance> sorted(instances.begin(), instances.end());
    const auto groups = groupNeighbours(sorted, static_cast<size_t>(group_count));
    const std::vector<VisibilityFactor> factors = fitGroups(world, surface, chosen, groups, settings);
    InstanceSpread spread;
    spread.rays = groups.size() * chosen.size() * 2 * kSetRays;
    for (size_t g = 0; g < groups.size(); ++g)
    {
        const std::span<const MeshInstance> group = groups[g];
        const VisibilityFactor& factor = factors[g];
        const double share = static_cast<double>(group.size()) / count;
        spread.of_mean += factor.error_of_mean * share;
        if (rms(factor.error_of_mean) - rms(factor.error_with_factor) < kMinGain)
        {
            spread.with_factors += factor.error_of_mean * share;
            continue;
        }
        spread.with_factors += factor.error_with_factor * share;
        spread.changed_instances += static_cast<uint32_t>(group.size());
        const Float4& terms = factor.terms;
        for (const MeshInstance& instance : group)
            std::ranges::transform(std::array{terms.x, terms.y, terms.z, terms.w},
                                   records[instance.number].visibility, halfFromFloat);
    }
    spread.of_mean = rms(spread.of_mean);
    spread.with_factors = rms(spread.with_factors);
    return spread;
}

} // namespace hearth::visibility
