// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/instance_copies.h"

#include "cook/pages/mesh_copies.h"
#include "cook/visibility/program/instance_visibility.h"
#include "formats/base/affine3d.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Points at which instances are compared: at most those, and fewer down to the minimum where instances are
// many. Meshes with more instances are not compared.
constexpr size_t kMaxPointsPerInstance = 64;
constexpr size_t kMinPointsPerInstance = 16;
constexpr size_t kMaxComparedPoints = size_t{1} << 13;

// Rays that the mean of the instances takes at a point.
constexpr uint32_t kMeanRays = 128;

// Rms error of ambient occlusion from which on an instance should have a copy of its mesh.
constexpr double kMinError = 0.04;

struct Candidate
{
    uint32_t mesh;
    uint32_t instance;
    double value; ///< square metres by mean square error of ambient occlusion, for each byte
    uint64_t bytes;
};

/// Return the meshes whose instances are compared, those with the fewest instances first.
std::vector<uint32_t> findComparedMeshes(const BakedSource& source, uint64_t max_bytes)
{
    std::vector<uint32_t> meshes;
    for (uint32_t mesh = 0; mesh < source.instances.size(); ++mesh)
    {
        const MeshRecord& record = source.part.meshes()[mesh];
        if (source.instances[mesh].size() > 1 && isBaked(record) && !isDeformed(record) &&
            pages::countCopyBytes(source.part, mesh) <= max_bytes)
            meshes.push_back(mesh);
    }
    std::ranges::stable_sort(meshes, {}, [&](uint32_t mesh) { return source.instances[mesh].size(); });
    size_t count = 0;
    for (size_t i = 0; i < meshes.size(); ++i)
    {
        count += source.instances[meshes[i]].size();
        if (count * kMinPointsPerInstance > kMaxComparedPoints)
        {
            meshes.resize(i);
            break;
        }
    }
    return meshes;
}

/// Return how much larger an instance's surface is than its mesh's, apart from shear.
double computeAreaScale(const Affine3& world_from_mesh)
{
    const Affine3d transform = widened(world_from_mesh);
    const auto& m = transform.m;
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return std::pow(std::abs(determinant), 2.0 / 3);
}

/// Compares the instances of meshes.
class InstanceComparison
{
public:
    InstanceComparison(const BakedSource& source, const Occluders& world, const RaySettings& rays,
                       const ProxySettings& proxy, size_t points)
        : source_(source), world_(world), rays_(rays), proxy_(proxy), points_(points)
    {
    }

    /// Return the instances of a mesh that should have a copy, the most valuable one first.
    Result<std::vector<Candidate>> findUnlike(uint32_t mesh) const
    {
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(source_.part, mesh));
        const LevelArrays level = extractLevel(pages, source_.plan[mesh].level);
        const std::vector<SurfaceSample> samples = choosePoints(level);
        const std::span<const MeshInstance> instances = source_.instances[mesh];
        const SampledMoments mean = traceMean(level, samples, instances, mesh);
        const SampledSurface surface{level.positions, level.indices, samples, mean.moments, mean.interior};
        std::vector<ChosenSample> chosen;
        double area = 0;
        for (uint32_t s = 0; s < samples.size(); ++s)
        {
            if (mean.interior[s] == 0)
                chosen.push_back({s, samples[s].area});
            area += samples[s].area;
        }
        if (chosen.empty())
            return std::vector<Candidate>();
        std::vector<std::span<const MeshInstance>> alone;
        for (size_t i = 0; i < instances.size(); ++i)
            alone.push_back(instances.subspan(i, 1));
        const std::vector<VisibilityFactor> factors =
            fitGroups(world_, surface, chosen, alone, seededRays(mesh));
        const uint64_t bytes = pages::countCopyBytes(source_.part, mesh);
        std::vector<Candidate> unlike;
        for (size_t i = 0; i < instances.size(); ++i)
            if (const double error = factors[i].error_with_factor; error > kMinError * kMinError)
                unlike.push_back({mesh, instances[i].number,
                                  error * area * computeAreaScale(instances[i].world_from_mesh) /
                                      static_cast<double>(bytes),
                                  bytes});
        std::ranges::stable_sort(unlike, std::ranges::greater(), &Candidate::value);
        // the mesh itself is left to one of them
        if (unlike.size() == instances.size())
            unlike.pop_back();
        return unlike;
    }

private:
    /// Return about as many points as wanted, evenly over the area.
    std::vector<SurfaceSample> choosePoints(const LevelArrays& level) const
    {
        const std::vector<SurfaceSample> all = createSamples(level, 1, proxy_);
        const std::vector<double> rates(all.size(), 1.0);
        std::vector<SurfaceSample> points;
        for (const ChosenSample& chosen : chooseSamples({level.positions, level.indices, all, {}, {}}, rates,
                                                        static_cast<uint32_t>(points_)))
        {
            points.push_back(all[chosen.sample]);
            points.back().area = chosen.weight / static_cast<float>(points_);
        }
        return points;
    }

    /// Trace the visibility that the mesh would have: the mean over its instances.
    SampledMoments traceMean(const LevelArrays& level, std::span<const SurfaceSample> samples,
                             std::span<const MeshInstance> instances, uint32_t mesh) const
    {
        const std::vector<Placement> places = placeInstances(world_, instances, kMeanRays);
        RaySettings rays = seededRays(mesh);
        rays.rays_per_sample = kMeanRays / static_cast<uint32_t>(places.size());
        return *sampledMoments(level.mesh().mesh, samples, places, rays, false,
                               [](size_t, uint64_t, uint64_t) { return true; });
    }

    RaySettings seededRays(uint32_t mesh) const
    {
        RaySettings rays = rays_;
        rays.seed += mesh;
        return rays;
    }

    const BakedSource& source_;
    const Occluders& world_;
    const RaySettings& rays_;
    const ProxySettings& proxy_;
    size_t points_;
};

} // namespace

bool mayNeedCopies(const BakedSource& source, uint64_t max_bytes)
{
    return !findComparedMeshes(source, max_bytes).empty();
}

Result<MeshCopies> chooseCopies(const BakedSource& source, const Occluders& world,
                                std::vector<uint32_t> instance_meshes, const RaySettings& rays,
                                const ProxySettings& proxy, uint64_t max_bytes)
{
    const std::vector<uint32_t> compared = findComparedMeshes(source, max_bytes);
    size_t count = 0;
    for (const uint32_t mesh : compared)
        count += source.instances[mesh].size();
    const size_t points = std::clamp(kMaxComparedPoints / std::max<size_t>(count, 1), kMinPointsPerInstance,
                                     kMaxPointsPerInstance);
    const InstanceComparison comparison(source, world, rays, proxy, points);
    std::vector<Candidate> candidates;
    for (const uint32_t mesh : compared)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<Candidate> unlike, comparison.findUnlike(mesh));
        candidates.insert(candidates.end(), unlike.begin(), unlike.end());
    }
    std::vector<Candidate> chosen;
    uint64_t left = max_bytes;
    std::ranges::stable_sort(candidates, std::ranges::greater(), &Candidate::value);
    for (const Candidate& candidate : candidates)
        if (candidate.bytes <= left)
        {
            chosen.push_back(candidate);
            left -= candidate.bytes;
        }
    std::ranges::sort(chosen, {}, &Candidate::instance);
    MeshCopies copies{{}, std::move(instance_meshes)};
    for (const Candidate& candidate : chosen)
    {
        copies.instance_meshes[candidate.instance] =
            static_cast<uint32_t>(source.part.meshes().size() + copies.meshes.size());
        copies.meshes.push_back(candidate.mesh);
    }
    return copies;
}

} // namespace hearth::visibility
