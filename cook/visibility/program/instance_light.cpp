// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/instance_light.h"

#include <algorithm>
#include <numbers>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Maximum number of records of a mesh.
constexpr size_t kMaxGroups = 8;

// Points of all groups together, and bounds of each group's.
constexpr uint64_t kTotalPoints = 1 << 12;
constexpr uint64_t kMinGroupPoints = 16;
constexpr uint64_t kMaxGroupPoints = 64;

// Occluded share that open surfaces count as, so that they have some points.
constexpr double kOpenShare = 0.05;

/// Choose samples by how much of their hemisphere is occluded.
std::vector<ChosenSample> chooseOccluded(const SampledSurface& surface, uint32_t count)
{
    std::vector<double> rates(surface.samples.size());
    for (size_t s = 0; s < rates.size(); ++s)
        if (surface.interior[s] == 0)
            rates[s] = std::max(1 - surface.moments[s].m0 / (2 * std::numbers::pi), kOpenShare);
    return chooseSamples(surface, rates, count);
}

/// Place chosen samples among their occluders.
void addPoints(const SampledSurface& surface, std::span<const ChosenSample> chosen,
               const Affine3& occluders_from_mesh, const Affine3& world_from_occluders,
               std::vector<TransferPoint>& points)
{
    const std::vector<SamplePoint> placed = placeSamples(surface, chosen, occluders_from_mesh);
    for (size_t i = 0; i < placed.size(); ++i)
        points.push_back({placed[i], chosen[i].weight, world_from_occluders});
}

} // namespace

InstanceLight::InstanceLight(uint64_t group_count, const TransferSettings& settings)
    : points_per_group_(static_cast<uint32_t>(
          std::clamp(kTotalPoints / std::max<uint64_t>(group_count, 1), kMinGroupPoints, kMaxGroupPoints))),
      settings_(settings)
{
}

size_t InstanceLight::countGroups(size_t instance_count)
{
    return std::min(instance_count, kMaxGroups);
}

template <typename MakePoints>
void InstanceLight::bakeGroups(const Occluders& occluders, std::span<const MeshInstance> instances,
                               std::span<SurroundingsRecord> records, const MakePoints& make_points)
{
    if (instances.empty())
        return;
    std::vector<MeshInstance> sorted(instances.begin(), instances.end());
    for (const std::span<const MeshInstance> group : groupNeighbours(sorted, countGroups(sorted.size())))
    {
        TransferSettings settings = settings_;
        settings.seed += group.front().number; // instances at the same place have independent noise
        const auto transfer = estimateTransfer(occluders, make_points(group), settings);
        if (!transfer)
            continue;
        for (const MeshInstance& instance : group)
            records[instance.number].transfer = static_cast<uint32_t>(transfers_.size());
        transfers_.push_back(*transfer);
    }
}

void InstanceLight::bakeInWorld(const Occluders& world, const SampledSurface& surface,
                                std::span<const MeshInstance> instances,
                                std::span<SurroundingsRecord> records)
{
    const std::vector<ChosenSample> chosen = chooseOccluded(surface, points_per_group_);
    bakeGroups(world, instances, records,
               [&](std::span<const MeshInstance> group)
               {
                   // evenly chosen instances share the points, every n-th one each
                   const size_t count = std::min(group.size(), chosen.size());
                   std::vector<TransferPoint> points;
                   for (size_t i = 0; i < count; ++i)
                   {
                       std::vector<ChosenSample> share;
                       for (size_t s = i; s < chosen.size(); s += count)
                           share.push_back(chosen[s]);
                       addPoints(surface, share, group[i * group.size() / count].world_from_mesh, {}, points);
                   }
                   return points;
               });
}

void InstanceLight::bakeAlone(const Occluders& itself, const SampledSurface& surface,
                              std::span<const MeshInstance> instances, std::span<SurroundingsRecord> records)
{
    const std::vector<ChosenSample> chosen = chooseOccluded(surface, points_per_group_);
    bakeGroups(itself, instances, records,
               [&](std::span<const MeshInstance> group)
               {
                   std::vector<TransferPoint> points;
                   addPoints(surface, chosen, {}, group[group.size() / 2].world_from_mesh, points);
                   return points;
               });
}

} // namespace hearth::visibility
