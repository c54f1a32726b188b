// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/variation.h"

#include "cook/sampling/owen_sobol.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hearth::visibility
{

using namespace formats;

namespace
{

constexpr uint32_t kPairs = 512; // of points, on a mesh
constexpr uint32_t kPairRays = 32;

// Instances of a mesh that its pairs lie on.
constexpr size_t kMeasuredInstances = 8;

// The error of a level falls about with the square root of its number of samples. The sum over all meshes
// is least where rays grow with this power of it.
constexpr double kWeightPower = 1 / 1.5;

// Range of the weights: variation is measured by few rays, and at one distance.
constexpr double kMinWeight = 0.5, kMaxWeight = 4;

/// Return a point of the same triangle, `distance` away or as far as the triangle goes.
SurfaceSample findPartner(const LevelArrays& level, const SurfaceSample& sample, float distance,
                          uint32_t index)
{
    const uint32_t* corner = &level.indices[size_t{sample.triangle} * 3];
    const Float3 origin = level.positions[corner[0]], along_u = level.positions[corner[1]] - origin,
                 along_v = level.positions[corner[2]] - origin;
    const sampling::SquarePoint random = sampling::owenSobol(index, 0);
    const float root = std::sqrt(sampling::unitFloat(random.x)); // even over the triangle
    const float v = root * sampling::unitFloat(random.y), u = root - v;
    const float there = length(along_u * (u - sample.u) + along_v * (v - sample.v));
    const float share = there > distance ? distance / there : 1;
    SurfaceSample partner = sample;
    partner.u += (u - sample.u) * share;
    partner.v += (v - sample.v) * share;
    return partner;
}

/// Return pairs of points, one after the other.
std::vector<SurfaceSample> choosePairs(const LevelArrays& level, float distance,
                                       const FitMeshSettings& fit_mesh)
{
    std::vector<SurfaceSample> pairs;
    for (const SurfaceSample& point : choosePoints(level, fit_mesh, kPairs))
    {
        pairs.push_back(point);
        pairs.push_back(findPartner(level, point, distance, static_cast<uint32_t>(pairs.size() / 2)));
    }
    return pairs;
}

/// Return the mean length of the edges of a mesh's level.
/// area  of the mesh
float computeEdge(double area, uint64_t triangles)
{
    return static_cast<float>(
        std::sqrt(area / static_cast<double>(std::max<uint64_t>(triangles, 1)) * 4 / std::numbers::sqrt3));
}

/// Return the mean square difference of ambient occlusion over pairs: product of the differences by two
/// independent sets of rays.
double measurePairs(const Occluders& world, std::span<const SamplePoint> points, RaySettings rays)
{
    rays.rays_per_sample = kPairRays;
    const auto first = visibilityMoments(world, points, rays);
    rays.first_ray += kPairRays;
    const auto second = visibilityMoments(world, points, rays);
    double sum = 0;
    for (size_t p = 0; p + 1 < points.size(); p += 2)
    {
        const auto difference = [&](const std::vector<Moments>& seen)
        {
            return double{dot(seen[p].m1, points[p].normal) - dot(seen[p + 1].m1, points[p + 1].normal)} /
                   std::numbers::pi;
        };
        sum += difference(*first) * difference(*second);
    }
    return points.empty() ? 0 : std::max(sum / static_cast<double>(points.size() / 2), 0.0);
}

} // namespace

Result<std::vector<std::optional<double>>> measureVariation(const BakedSource& source, const Occluders& world,
                                                            std::span<const MeshSampling> plan,
                                                            RaySettings rays, const FitMeshSettings& fit_mesh)
{
    std::vector<std::optional<double>> variation;
    for (uint32_t mesh = 0; mesh < source.part.meshes().size(); ++mesh)
    {
        const MeshRecord& record = source.part.meshes()[mesh];
        const std::span<const MeshInstance> instances = source.instances[mesh];
        variation.emplace_back();
        if (plan[mesh].level == 0 || !isBaked(source.scene, source.part, mesh) || isDeformed(record) ||
            instances.empty())
            continue;
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages,
                                MeshPages::readLevel(source.part, mesh, source.plan[mesh].level));
        const LevelArrays level = extractLevel(pages, source.plan[mesh].level);
        const float edge =
            computeEdge(computeArea(level), countLevelTriangles(source.part, mesh)[plan[mesh].level]);
        const std::vector<SurfaceSample> pairs = choosePairs(level, edge, fit_mesh);
        const size_t count = std::min(kMeasuredInstances, instances.size());
        std::vector<SamplePoint> points;
        for (size_t i = 0; i < count; ++i)
        {
            // whole pairs
            const size_t first = pairs.size() / 2 * i / count * 2,
                         end = pairs.size() / 2 * (i + 1) / count * 2;
            const std::vector<SamplePoint> placed =
                samplePoints(level.positions, level.indices, std::span(pairs).subspan(first, end - first),
                             instances[i * instances.size() / count].world_from_mesh);
            points.insert(points.end(), placed.begin(), placed.end());
        }
        variation.back() = measurePairs(world, points, rays);
    }
    return variation;
}

std::vector<double> makeWeights(std::span<const std::optional<double>> variation)
{
    double sum = 0, count = 0;
    for (const std::optional<double>& value : variation)
        if (value)
        {
            sum += std::pow(*value, kWeightPower);
            ++count;
        }
    std::vector<double> weights;
    for (const std::optional<double>& value : variation)
        weights.push_back(value && sum > 0 ? std::clamp(std::pow(*value, kWeightPower) / (sum / count),
                                                        kMinWeight, kMaxWeight)
                                           : 1.0);
    return weights;
}

} // namespace hearth::visibility
