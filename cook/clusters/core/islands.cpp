// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/islands.h"

#include <algorithm>
#include <numeric>

namespace hearth::clusters
{

namespace
{

// A quarter of a cluster: splitting a larger island costs fewer vertices than keeping it whole wastes
// triangles.
constexpr uint32_t kMaxSmallIsland = 32;

} // namespace

DisjointSets::DisjointSets(size_t count) : parent_(count)
{
    std::iota(parent_.begin(), parent_.end(), 0u);
}

uint32_t DisjointSets::find(uint32_t element)
{
    while (parent_[element] != element)
    {
        parent_[element] = parent_[parent_[element]];
        element = parent_[element];
    }
    return element;
}

void DisjointSets::unite(uint32_t a, uint32_t b)
{
    a = find(a);
    b = find(b);
    if (a != b)
        parent_[std::max(a, b)] = std::min(a, b);
}

std::vector<uint32_t> islandOfTriangles(std::span<const uint32_t> positions, size_t position_count)
{
    DisjointSets sets(position_count);
    for (size_t i = 0; i < positions.size(); i += 3)
    {
        sets.unite(positions[i], positions[i + 1]);
        sets.unite(positions[i], positions[i + 2]);
    }
    std::vector<uint32_t> island(positions.size() / 3);
    for (size_t t = 0; t < island.size(); ++t)
        island[t] = sets.find(positions[t * 3]);
    return island;
}

void moveToIslandCenters(std::span<Float3> centers, std::span<const uint32_t> vertices, size_t vertex_count)
{
    const std::vector<uint32_t> island = islandOfTriangles(vertices, vertex_count);
    std::vector<uint32_t> size(vertex_count, 0);
    for (const uint32_t i : island)
        ++size[i];
    if (std::none_of(island.begin(), island.end(), [&](uint32_t i) { return size[i] <= kMaxSmallIsland; }))
        return;
    std::vector<Float3> island_center(vertex_count);
    for (size_t t = 0; t < centers.size(); ++t)
        if (size[island[t]] <= kMaxSmallIsland)
            island_center[island[t]] += centers[t] / static_cast<float>(size[island[t]]);
    for (size_t t = 0; t < centers.size(); ++t)
        if (size[island[t]] <= kMaxSmallIsland)
            centers[t] = island_center[island[t]];
}

} // namespace hearth::clusters
