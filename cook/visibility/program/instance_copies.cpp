// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/instance_copies.h"

#include "cook/pages/mesh_copies.h"
#include "cook/visibility/fit/visibility_factor.h"
#include "cook/visibility/program/instance_visibility.h"
#include "formats/base/affine3d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Points at which instances are compared: at most those, and fewer down to the minimum where instances are
// many. Meshes with more instances are not compared.
constexpr size_t kMaxPointsPerInstance = 64;
constexpr size_t kMinPointsPerInstance = 16;
constexpr size_t kMaxComparedPoints = size_t{1} << 12;

// Rays of each of the two sets at a point.
constexpr uint32_t kComparedRays = 16;

// Rms error of ambient occlusion from which on an instance should have a copy of its mesh.
constexpr double kMinError = 0.04;

/// Copy of a mesh that may be made.
struct Candidate
{
    uint32_t mesh;
    std::vector<uint32_t> instances; ///< that would draw it
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
        if (source.instances[mesh].size() > 1 && isBaked(source.scene, source.part, mesh) &&
            !isDeformed(record) && pages::countCopyBytes(source.part, mesh) <= max_bytes)
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
    return std::pow(std::abs(double{determinant(world_from_mesh)}), 2.0 / 3);
}

/// Instance, and its surroundings as points of its mesh see them.
struct SeenInstance
{
    uint32_t number; ///< in chunk INST
    double area;     ///< of its surface
    Affine3d mesh_from_world;
    std::vector<SamplePoint> points;
    std::array<std::vector<Moments>, 2> seen; ///< in the space of the mesh, by two independent sets of rays
    std::vector<uint8_t> interior;
};

/// Instances that could share a visibility.
struct AlikeInstances
{
    std::vector<const SeenInstance*> members;
    double error = 0; ///< square metres by mean square error, if they shared with the first group
};

/// Compares the instances of a mesh.
class InstanceComparison
{
public:
    explicit InstanceComparison(std::vector<SeenInstance> instances) : instances_(std::move(instances)) {}

    /// Divide the instances into groups that can share a visibility. The first group is what is left when the
    /// most unlike instances are taken out one by one; each of these joins a later group, or begins one.
    std::vector<AlikeInstances> group() const
    {
        std::vector<AlikeInstances> groups(1);
        for (const SeenInstance& instance : instances_)
            groups[0].members.push_back(&instance);
        const std::vector<const SeenInstance*> unlike = takeOutUnlike(groups[0].members);
        const std::vector<Moments> mean = computeMean(groups[0].members);
        for (const SeenInstance* instance : unlike)
        {
            const auto found =
                std::find_if(groups.begin() + 1, groups.end(),
                             [&](const AlikeInstances& group) { return isAlike(*instance, group.members); });
            AlikeInstances& joined = found == groups.end() ? groups.emplace_back() : *found;
            joined.members.push_back(instance);
            joined.error += instance->area * computeError(*instance, mean);
        }
        return groups;
    }

private:
    /// Take the most unlike instance out, until those that are left can share a visibility.
    /// returns  the instances that were taken out
    static std::vector<const SeenInstance*> takeOutUnlike(std::vector<const SeenInstance*>& alike)
    {
        std::vector<const SeenInstance*> unlike;
        while (alike.size() > 1)
        {
            const std::vector<Moments> mean = computeMean(alike);
            std::vector<double> errors;
            for (const SeenInstance* instance : alike)
                errors.push_back(computeError(*instance, mean) +
                                 computeNoise(*instance) / (2 * static_cast<double>(alike.size())));
            const auto worst = std::ranges::max_element(errors);
            if (*worst <= kMinError * kMinError)
                break;
            const auto place = alike.begin() + (worst - errors.begin());
            unlike.push_back(*place);
            alike.erase(place);
        }
        return unlike;
    }

    /// Return whether an instance can share the visibility of others.
    static bool isAlike(const SeenInstance& instance, std::span<const SeenInstance* const> others)
    {
        const double noise = computeNoise(instance) / (2 * static_cast<double>(others.size()));
        return computeError(instance, computeMean(others)) - noise <= kMinError * kMinError;
    }

    /// Return the mean of what instances see, at each point.
    static std::vector<Moments> computeMean(std::span<const SeenInstance* const> instances)
    {
        std::vector<Moments> mean(instances.front()->points.size());
        const float share = 0.5f / static_cast<float>(instances.size());
        for (const SeenInstance* instance : instances)
            for (const std::vector<Moments>& seen : instance->seen)
                for (size_t p = 0; p < mean.size(); ++p)
                {
                    mean[p].m0 += seen[p].m0 * share;
                    mean[p].m1 = mean[p].m1 + seen[p].m1 * share;
                }
        return mean;
    }

    /// Return the mean square error of ambient occlusion with a mean and a factor of it. The noise of the
    /// mean, that of a set of rays over twice the number of its instances, makes it more; or less, if the
    /// instance's own rays are in the mean.
    static double computeError(const SeenInstance& instance, std::span<const Moments> mean)
    {
        std::vector<FactorSample> samples;
        for (size_t p = 0; p < mean.size(); ++p)
        {
            if (instance.interior[p] != 0)
                continue;
            FactorSample sample{
                instance.points[p].normal, placeMoments(mean[p], instance.mesh_from_world), {}};
            for (size_t set = 0; set < 2; ++set)
            {
                const shared::VisibilityMoments placed =
                    placeMoments(instance.seen[set][p], instance.mesh_from_world);
                sample.seen[set] = {placed.m0, placed.m1};
            }
            samples.push_back(sample);
        }
        return samples.empty() ? 0 : fitFactor(samples).error_with_factor;
    }

    /// Return the variance of ambient occlusion by one set of rays.
    static double computeNoise(const SeenInstance& instance)
    {
        double sum = 0, count = 0;
        for (size_t p = 0; p < instance.points.size(); ++p)
            if (instance.interior[p] == 0)
            {
                const shared::VisibilityMoments difference = placeMoments(
                    {0, instance.seen[0][p].m1 - instance.seen[1][p].m1}, instance.mesh_from_world);
                const double occlusion =
                    double{dot(difference.m1, instance.points[p].normal)} / std::numbers::pi;
                sum += occlusion * occlusion / 2;
                ++count;
            }
        return count > 0 ? sum / count : 0;
    }

    std::vector<SeenInstance> instances_;
};

/// Return the candidates of a mesh.
/// points  about as many of each instance
Result<std::vector<Candidate>> findCandidates(const BakedSource& source, const Occluders& world,
                                              uint32_t mesh, RaySettings rays,
                                              const FitMeshSettings& fit_mesh, size_t points)
{
    HEARTH_ASSIGN_OR_RETURN(const MeshPages pages,
                            MeshPages::readLevel(source.part, mesh, source.plan[mesh].level));
    const LevelArrays level = extractLevel(pages, source.plan[mesh].level);
    const std::vector<SurfaceSample> samples = choosePoints(level, fit_mesh, points);
    const double area = computeArea(level);
    rays.seed += mesh;
    rays.rays_per_sample = kComparedRays;
    std::vector<SeenInstance> instances;
    for (const MeshInstance& instance : source.instances[mesh])
    {
        const Placement place{&world, instance.world_from_mesh, {}};
        SeenInstance seen{
            .number = instance.number,
            .area = area * computeAreaScale(instance.world_from_mesh),
            .mesh_from_world = *inverted(widened(instance.world_from_mesh)), // rays need it, too
            .points = samplePoints(level.positions, level.indices, samples, instance.world_from_mesh),
            .seen = {},
            .interior = {}};
        for (std::vector<Moments>& set : seen.seen)
        {
            SampledMoments traced = *sampledMoments(level.mesh().mesh, samples, {&place, 1}, rays, false,
                                                    [](size_t, uint64_t, uint64_t) { return true; });
            set = std::move(traced.moments);
            seen.interior = std::move(traced.interior);
            rays.first_ray += kComparedRays; // instances have independent noise
        }
        instances.push_back(std::move(seen));
    }
    const uint64_t bytes = pages::countCopyBytes(source.part, mesh);
    std::vector<Candidate> candidates;
    const InstanceComparison comparison(std::move(instances));
    const std::vector<AlikeInstances> groups = comparison.group();
    for (const AlikeInstances& group : std::span(groups).subspan(1))
    {
        Candidate& candidate =
            candidates.emplace_back(Candidate{mesh, {}, group.error / static_cast<double>(bytes), bytes});
        for (const SeenInstance* instance : group.members)
            candidate.instances.push_back(instance->number);
    }
    return candidates;
}

} // namespace

bool mayNeedCopies(const BakedSource& source, uint64_t max_bytes)
{
    return !findComparedMeshes(source, max_bytes).empty();
}

Result<MeshCopies> chooseCopies(const BakedSource& source, const Occluders& world,
                                std::vector<uint32_t> instance_meshes, const RaySettings& rays,
                                const FitMeshSettings& fit_mesh, uint64_t max_bytes)
{
    const std::vector<uint32_t> compared = findComparedMeshes(source, max_bytes);
    size_t count = 0;
    for (const uint32_t mesh : compared)
        count += source.instances[mesh].size();
    const size_t points = std::clamp(kMaxComparedPoints / std::max<size_t>(count, 1), kMinPointsPerInstance,
                                     kMaxPointsPerInstance);
    std::vector<Candidate> candidates;
    for (const uint32_t mesh : compared)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<Candidate> of_mesh,
                                findCandidates(source, world, mesh, rays, fit_mesh, points));
        candidates.insert(candidates.end(), of_mesh.begin(), of_mesh.end());
    }
    MeshCopies copies{{}, std::move(instance_meshes)};
    uint64_t left = max_bytes;
    std::ranges::stable_sort(candidates, std::ranges::greater(), &Candidate::value);
    for (const Candidate& candidate : candidates)
    {
        if (candidate.bytes > left)
            continue;
        left -= candidate.bytes;
        for (const uint32_t instance : candidate.instances)
            copies.instance_meshes[instance] =
                static_cast<uint32_t>(source.part.meshes().size() + copies.meshes.size());
        copies.meshes.push_back(candidate.mesh);
    }
    return copies;
}

} // namespace hearth::visibility
