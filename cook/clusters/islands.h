// Connected pieces of a mesh by position, and what small ones mean for splitting.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/cluster.h"
#include "formats/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Disjoint sets over [0, count): union by smaller index, path halving.
class DisjointSets
{
public:
    explicit DisjointSets(size_t count);
    uint32_t find(uint32_t element);
    void unite(uint32_t a, uint32_t b);

private:
    std::vector<uint32_t> parent_;
};

/// The representative position of each triangle's island.
/// positions  three for each triangle, all below position_count
std::vector<uint32_t> islandOfTriangles(std::span<const uint32_t> positions, size_t position_count);

/// Where the splitter takes triangles to be: at their own centers; but triangles of an island of at most 32 triangles
/// all move to the island's center, so that a leaf or a pebble is not torn apart between clusters.
///
/// centers    of the triangles, changed in place
/// positions  three for each triangle, all below position_count
void gatherSmallIslands(std::span<Float3> centers, std::span<const uint32_t> positions,
                        size_t position_count);

/// The center of a triangle, without overflow for any finite corners.
inline Float3 triangleCenter(Float3 a, Float3 b, Float3 c)
{
    constexpr float kThird = 1.0f / 3.0f;
    return a * kThird + b * kThird + c * kThird;
}

} // namespace hearth::clusters
