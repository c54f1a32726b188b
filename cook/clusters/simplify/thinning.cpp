// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/thinning.h"

#include "cook/clusters/core/islands.h"
#include "cook/clusters/simplify/simplify.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>

namespace hearth::clusters
{

namespace
{

// Twice the area compensates for half of the islands; more would be visible.
constexpr float kMaxGrowth = 1.6f;

// Less growth than this is not worth new vertices.
constexpr float kMinGrowth = 1.01f;

struct Island
{
    Box3 box;
    bool locked = false;
    uint32_t order = 0; ///< among equals
    std::vector<TriangleId> triangles;

    int sizeClass() const { return std::ilogb(std::max(length(box.max - box.min), 1e-30f)); }
};

std::vector<Island> looseIslands(const GroupMesh& group, const StarMesh& mesh)
{
    const IdVector<TriangleId, TriangleId> alive = mesh.aliveTriangles();
    CornerVector<PositionId> positions;
    for (const TriangleId triangle : alive)
        for (const StarCorner corner : StarMesh::triangleCorners(triangle))
            positions.push_back(mesh.positionIdAt(corner));
    const auto island_of_triangle = islandOfTriangles(positions, group.positions.size());
    IdVector<PositionId, Island> islands(group.positions.size());
    for (const TriangleId i : alive.ids())
    {
        Island& island = islands[island_of_triangle[i]];
        island.triangles.push_back(alive[i]);
        for (const PositionId position : positions.triangle(i))
        {
            island.box.add(group.positions[position]);
            island.locked |= group.locked[position] != 0;
        }
    }
    std::erase_if(islands.values(),
                  [](const Island& island) { return island.triangles.empty() || island.locked; });
    return std::move(islands.values());
}

uint32_t reversedBits(uint32_t x)
{
    uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit)
        reversed |= (x >> bit & 1) << (31 - bit);
    return reversed;
}

/// Sort the islands: those to remove first come first.
void orderForRemoval(std::vector<Island>& islands)
{
    for (uint32_t i = 0; i < islands.size(); ++i)
        islands[i].order = reversedBits(i);
    std::sort(islands.begin(), islands.end(),
              [](const Island& a, const Island& b)
              {
                  const int size_a = a.sizeClass(), size_b = b.sizeClass();
                  return size_a != size_b ? size_a < size_b : a.order < b.order;
              });
}

/// Return the area of an island; 0 for islands that do not grow.
double growableArea(const GroupMesh& group, const StarMesh& mesh, const Island& island)
{
    double area = 0;
    if (island.triangles.size() > kMaxGrownTriangles)
        return area;
    for (const TriangleId triangle : island.triangles)
    {
        const auto corners = StarMesh::triangleCorners(triangle);
        const Float3 a = group.positions[mesh.positionIdAt(corners[0])];
        const Float3 b = group.positions[mesh.positionIdAt(corners[1])];
        const Float3 c = group.positions[mesh.positionIdAt(corners[2])];
        area += double{length(cross(b - a, c - a))};
    }
    return area;
}

std::vector<PositionId> collectPositions(const StarMesh& mesh, const Island& island)
{
    std::vector<PositionId> positions;
    for (const TriangleId triangle : island.triangles)
        for (const StarCorner corner : StarMesh::triangleCorners(triangle))
            positions.push_back(mesh.positionIdAt(corner));
    std::sort(positions.begin(), positions.end());
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    return positions;
}

} // namespace

Thinning thinIslands(const GroupMesh& group, StarMesh& mesh, size_t target_triangles,
                     IdVector<PositionId, PositionId>& target_of_position)
{
    HEARTH_ASSERT(target_of_position.size() == group.positions.size() && mesh.aliveCount() > 0);
    Thinning thinning;
    std::vector<Island> islands = looseIslands(group, mesh);
    orderForRemoval(islands);
    double area = 0;
    for (const Island& island : islands)
        area += growableArea(group, mesh, island);
    double area_left = area;
    size_t removed = 0;
    while (removed < islands.size() && mesh.aliveCount() > target_triangles &&
           mesh.aliveCount() > islands[removed].triangles.size())
    {
        const Island& island = islands[removed++];
        area_left -= growableArea(group, mesh, island);
        for (const TriangleId triangle : island.triangles)
        {
            for (const StarCorner corner : StarMesh::triangleCorners(triangle))
                target_of_position[mesh.positionIdAt(corner)] = kPruned;
            mesh.remove(triangle);
        }
    }
    HEARTH_ASSERT(mesh.aliveCount() > 0);
    thinning.pruned = removed > 0;
    if (!thinning.pruned || !(area_left > 0))
        return thinning;
    thinning.growth.factor = std::min(static_cast<float>(std::sqrt(area / area_left)), kMaxGrowth);
    for (size_t i = removed; i < islands.size() && thinning.growth.factor > kMinGrowth; ++i)
        if (islands[i].triangles.size() <= kMaxGrownTriangles)
            thinning.growth.islands.push_back(collectPositions(mesh, islands[i]));
    return thinning;
}

} // namespace hearth::clusters
