// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/cuts.h"

#include "formats/codecs/cluster_bounds.h"

#include <algorithm>
#include <cmath>

namespace hearth::cuts
{

using clusters::DecodedHierarchy;
using clusters::Hierarchy;

std::vector<uint8_t> cutAtError(const Hierarchy& hierarchy, double error)
{
    std::vector<uint8_t> replaced;
    for (const auto& group : hierarchy.groups)
        replaced.push_back(group.error <= error ? 1 : 0);
    return replaced;
}

std::vector<uint8_t> cutFromEye(const Hierarchy& hierarchy, Float3 eye, double threshold)
{
    std::vector<uint8_t> replaced;
    for (const auto& group : hierarchy.groups)
    {
        // in floats as the runtime does: rounding must not break the cut
        const Float3 away = group.sphere_center - eye;
        const float distance = std::max(length(away) - group.sphere_radius, 1e-3f);
        replaced.push_back(group.error <= static_cast<float>(threshold) * distance ? 1 : 0);
    }
    return replaced;
}

std::vector<uint8_t> randomCut(const Hierarchy& hierarchy, double chance, std::mt19937& random)
{
    std::vector<uint8_t> replaced(hierarchy.groups.size(), 0);
    bool possible = true;
    for (size_t g = hierarchy.groups.size(); g-- > 0;)
    {
        const auto& group = hierarchy.groups[g];
        possible &= std::isfinite(group.error);
        for (uint32_t c = 0; c < group.clusters.count; ++c)
        {
            const uint32_t refined = hierarchy.clusters[group.clusters.first + c].refined_group;
            possible &= refined == kInvalidIndex || replaced[refined] != 0;
        }
        // the decision for a set is made at its first group, which comes last
        if (group.set_offset != 0)
            continue;
        const double roll = static_cast<double>(random()) / 4294967296.0;
        replaced[g] = possible && roll < chance ? 1 : 0;
        for (size_t h = g + 1; h < replaced.size() && hierarchy.groups[h].set_offset == h - g; ++h)
            replaced[h] = replaced[g];
        possible = true;
    }
    return replaced;
}

std::vector<uint32_t> trianglesOfCut(const Hierarchy& hierarchy, const DecodedHierarchy& decoded,
                                     std::span<const uint8_t> replaced)
{
    std::vector<uint32_t> triangles;
    for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
        triangles.insert(triangles.end(), decoded.clusters[c].positions.begin(),
                         decoded.clusters[c].positions.end());
    return triangles;
}

Overshoot measureOvershoot(const Hierarchy& hierarchy)
{
    std::vector<Box3> boxes(hierarchy.levels.size());
    for (const formats::ClusterRecord& cluster : hierarchy.clusters)
        boxes[cluster.level].add(formats::clusterBox(cluster, hierarchy.mesh.grid_step));
    Overshoot worst;
    for (int axis = 0; axis < 3; ++axis)
        worst.diagonal = std::hypot(worst.diagonal, double{boxes[0].max[axis]} - boxes[0].min[axis]);
    for (uint32_t level = 1; level < boxes.size(); ++level)
        for (int axis = 0; axis < 3; ++axis)
        {
            const double beyond = std::max(double{boxes[0].min[axis]} - boxes[level].min[axis],
                                           double{boxes[level].max[axis]} - boxes[0].max[axis]);
            if (beyond > worst.part * worst.diagonal)
            {
                worst.level = level;
                worst.part = beyond / worst.diagonal;
            }
        }
    return worst;
}

Boundary findSourceBoundary(const Hierarchy& hierarchy, const DecodedHierarchy& decoded)
{
    const std::vector<uint8_t> nothing(hierarchy.groups.size(), 0);
    return findBoundary(trianglesOfCut(hierarchy, decoded, nothing));
}

} // namespace hearth::cuts
