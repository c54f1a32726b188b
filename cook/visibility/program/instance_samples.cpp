// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/instance_samples.h"

#include <algorithm>

namespace hearth::visibility
{

namespace
{

Float3 place(const MeshInstance& instance)
{
    const auto& m = instance.world_from_mesh.m;
    return {m[0][3], m[1][3], m[2][3]};
}

void splitGroups(std::span<MeshInstance> instances, size_t group_count,
                 std::vector<std::span<const MeshInstance>>& groups)
{
    if (group_count == 1)
    {
        groups.emplace_back(instances);
        return;
    }
    Box3 box;
    for (const MeshInstance& instance : instances)
        box.add(place(instance));
    const Float3 size = box.max - box.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::ranges::sort(instances,
                      [&](const MeshInstance& a, const MeshInstance& b)
                      {
                          const float at_a = place(a)[axis], at_b = place(b)[axis];
                          return at_a != at_b ? at_a < at_b : a.number < b.number;
                      });
    const size_t first_groups = group_count / 2;
    const size_t first = instances.size() * first_groups / group_count;
    splitGroups(instances.first(first), first_groups, groups);
    splitGroups(instances.subspan(first), group_count - first_groups, groups);
}

} // namespace

std::vector<std::span<const MeshInstance>> groupNeighbours(std::span<MeshInstance> instances,
                                                           size_t group_count)
{
    std::vector<std::span<const MeshInstance>> groups;
    splitGroups(instances, group_count, groups);
    return groups;
}

std::vector<ChosenSample> chooseSamples(const SampledSurface& surface, std::span<const double> rates,
                                        uint32_t count)
{
    double total = 0;
    for (size_t s = 0; s < rates.size(); ++s)
        total += rates[s] * double{surface.samples[s].area};
    std::vector<ChosenSample> chosen;
    double sum = 0;
    for (uint32_t s = 0; s < rates.size(); ++s)
    {
        sum += rates[s] * double{surface.samples[s].area};
        while (chosen.size() < count && sum * count > (static_cast<double>(chosen.size()) + 0.5) * total)
            chosen.push_back({s, static_cast<float>(total / rates[s])});
    }
    return chosen;
}

std::vector<SamplePoint> placeSamples(const SampledSurface& surface, std::span<const ChosenSample> chosen,
                                      const Affine3& world_from_mesh)
{
    std::vector<SurfaceSample> samples;
    for (const ChosenSample& sample : chosen)
        samples.push_back(surface.samples[sample.sample]);
    return samplePoints(surface.positions, surface.corners, samples, world_from_mesh);
}

} // namespace hearth::visibility
