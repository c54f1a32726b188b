// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/reduce.h"

#include "cook/clusters/bounds.h"
#include "cook/clusters/deviation.h"
#include "cook/clusters/group_mesh.h"
#include "cook/clusters/islands.h"
#include "cook/clusters/simplify.h"
#include "cook/clusters/split.h"

#include <algorithm>

namespace hearth::clusters
{

namespace
{

/// Cut what is left into clusters, material by material in order of their numbers.
ClusterStore splitSimplified(const GroupMesh& group, const Simplified& simplified)
{
    const size_t count = simplified.triangleCount();
    std::vector<uint32_t> vertices(count * 3);
    std::vector<uint32_t> positions(count * 3);
    for (size_t i = 0; i < vertices.size(); ++i)
    {
        vertices[i] = group.vertex_of_wedge[simplified.corners[i]];
        positions[i] = group.position_of_wedge[simplified.corners[i]];
    }
    std::vector<Float3> centers(count);
    for (size_t t = 0; t < count; ++t)
        centers[t] = triangleCenter(group.positions[positions[t * 3]], group.positions[positions[t * 3 + 1]],
                                    group.positions[positions[t * 3 + 2]]);
    gatherSmallIslands(centers, simplified.corners, group.vertex_of_wedge.size());
    std::vector<SplitItem> items;
    items.reserve(count);
    for (uint32_t t = 0; t < count; ++t)
        items.push_back({centers[t], t});
    const auto& materials = simplified.materials;
    if (!std::is_sorted(materials.begin(), materials.end()))
        std::stable_sort(items.begin(), items.end(),
                         [&](const SplitItem& a, const SplitItem& b)
                         { return materials[a.triangle] < materials[b.triangle]; });
    ClusterStore out;
    for (size_t first = 0; first < count;)
    {
        const uint32_t material = materials[items[first].triangle];
        size_t last = first;
        while (last < count && materials[items[last].triangle] == material)
            ++last;
        splitIntoClusters(std::span(items).subspan(first, last - first), vertices, material, out);
        first = last;
    }
    return out;
}

} // namespace

Reduced reduceGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint32_t> members,
                    std::span<const uint8_t> locked, float members_distance, const GroupGoal& goal,
                    const Config& config)
{
    Reduced reduced;
    const GroupMesh group = gatherGroup(mesh, store, members, locked, config);
    const Simplified simplified = simplifyGroup(group, goal.triangles);
    reduced.permissive = simplified.permissive;
    reduced.pruned = simplified.pruned;
    reduced.triangle_count = simplified.triangleCount();
    if (static_cast<float>(reduced.triangle_count) >
        goal.stuck_ratio * static_cast<float>(group.triangleCount()))
        return reduced;
    reduced.clusters = splitSimplified(group, simplified);
    if (reduced.clusters.shapes.size() >= members.size() + (goal.exact ? 1 : 0))
        return reduced;
    const Deviation deviation = boundDeviation(group, simplified, double{members_distance} / group.scale);
    reduced.loose_pieces = deviation.loose_pieces;
    reduced.distance = roundUp((members_distance + deviation.distance * group.scale) * kMonotoneSlack);
    reduced.progressed = true;
    return reduced;
}

} // namespace hearth::clusters
