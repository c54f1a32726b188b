// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/deformed_cluster.h"

namespace hearth::skinning
{

double jointWeight(const DeformedCluster& cluster, size_t vertex, uint32_t joint)
{
    double weight = 0;
    for (size_t i = vertex * cluster.influences; i < (vertex + 1) * cluster.influences; ++i)
        if (cluster.joints[i] == joint)
            weight += cluster.weights[i];
    return weight;
}

std::vector<MorphedVertex> morphedVertices(const DeformedCluster& cluster,
                                           std::span<const animation_bounds::Interval> morph_weights)
{
    std::vector<MorphedVertex> vertices;
    vertices.reserve(cluster.positions.size());
    for (const Float3 position : cluster.positions)
        vertices.push_back({widen(position), {}});
    for (const MorphDeltas& morph : cluster.morphs)
    {
        const animation_bounds::Interval& weights = morph_weights[morph.target];
        for (size_t i = 0; i < vertices.size(); ++i)
        {
            const Double3 delta = widen(morph.positions[i]);
            vertices[i].middle = vertices[i].middle + delta * weights.middle();
            vertices[i].half =
                vertices[i].half +
                Double3{std::abs(delta.x), std::abs(delta.y), std::abs(delta.z)} * weights.half();
        }
    }
    return vertices;
}

} // namespace hearth::skinning
