// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/islands.h"

#include "formats/base/assert.h"
#include "formats/base/disjoint_sets.h"

#include <algorithm>

namespace hearth::clusters
{

namespace
{

// A quarter of a cluster: splitting a larger island costs fewer vertices than keeping it whole wastes
// triangles.
constexpr uint32_t kMaxSmallIsland = 32;

} // namespace

template <IndexType Id>
IdVector<TriangleId, Id> islandOfTriangles(const CornerVector<Id>& corners, size_t limit)
{
    HEARTH_RUNTIME_ASSERT(allBelow(corners, limit));
    DisjointSets sets(limit);
    for (const TriangleId triangle : corners.triangles())
    {
        const auto [a, b, c] = corners.triangle(triangle);
        sets.unite(toIndex(a), toIndex(b));
        sets.unite(toIndex(a), toIndex(c));
    }
    IdVector<TriangleId, Id> island(corners.triangleCount());
    for (const TriangleId triangle : island.ids())
        island[triangle] = Id{sets.find(toIndex(corners[makeCorner(triangle, 0)]))};
    return island;
}

template <IndexType Id>
void moveToIslandCenters(IdSpan<TriangleId, Float3> centers, const CornerVector<Id>& corners, size_t limit)
{
    HEARTH_ASSERT(centers.size() == corners.triangleCount());
    const IdVector<TriangleId, Id> island = islandOfTriangles(corners, limit);
    IdVector<Id, uint32_t> size(limit, 0);
    for (const Id i : island)
        ++size[i];
    if (std::none_of(island.begin(), island.end(), [&](Id i) { return size[i] <= kMaxSmallIsland; }))
        return;
    IdVector<Id, Float3> island_center(limit);
    for (const TriangleId triangle : centers.ids())
        if (const Id i = island[triangle]; size[i] <= kMaxSmallIsland)
            island_center[i] += centers[triangle] / static_cast<float>(size[i]);
    for (const TriangleId triangle : centers.ids())
        if (const Id i = island[triangle]; size[i] <= kMaxSmallIsland)
            centers[triangle] = island_center[i];
}

template IdVector<TriangleId, PositionId> islandOfTriangles(const CornerVector<PositionId>&, size_t);
template void moveToIslandCenters(IdSpan<TriangleId, Float3>, const CornerVector<WedgeId>&, size_t);
template void moveToIslandCenters(IdSpan<TriangleId, Float3>, const CornerVector<VertexId>&, size_t);

} // namespace hearth::clusters
