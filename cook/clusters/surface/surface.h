// Surface before or after a simplification, with its search structures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
#include "cook/clusters/core/triangle_block.h"
#include "cook/clusters/surface/piece_bound.h"
#include "formats/base/assert.h"
#include "formats/base/csr_lists.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Triangles at each position.
class TriangleLists
{
public:
    TriangleLists() = default;

    /// position_ids  below `position_count`
    TriangleLists(size_t position_count, CornerSpan<const PositionId> position_ids)
        : lists_(position_count,
                 [&](const auto& add)
                 {
                     HEARTH_RUNTIME_ASSERT(allBelow(position_ids, position_count));
                     for (const TriangleId triangle : position_ids.triangles())
                         for (const PositionId position : position_ids.triangle(triangle))
                             add(toIndex(position), triangle);
                 })
    {
    }

    std::span<const TriangleId> list(PositionId position) const { return lists_[toIndex(position)]; }

private:
    CsrLists<TriangleId> lists_;
};

/// Triangulated surface of a group; all arrays are in local units.
struct Surface
{
    CornerVector<PositionId> position_ids;
    CornerVector<Float3> corner_positions;
    IdVector<TriangleId, DistanceTriangle> triangles;
    IdVector<PositionId, Float3> position_of_id;
    TriangleLists triangles_at;

    /// all_positions  of all position ids, used or not
    Surface(CornerVector<PositionId> corner_ids, IdSpan<PositionId, const Float3> all_positions)
        : position_ids(std::move(corner_ids)),
          corner_positions(gatherPositions(position_ids, all_positions)),
          triangles(makeDistanceTriangles(corner_positions)),
          position_of_id(std::vector<Float3>(all_positions.begin(), all_positions.end())),
          triangles_at(all_positions.size(), position_ids)
    {
        HEARTH_ASSERT(position_ids.size() % 3 == 0);
    }

    /// Move the positions; the triangles stay the same.
    void setPositions(IdSpan<PositionId, const Float3> all_positions)
    {
        HEARTH_ASSERT(all_positions.size() == position_of_id.size());
        corner_positions = gatherPositions(position_ids, all_positions);
        triangles = makeDistanceTriangles(corner_positions);
        position_of_id.assign(all_positions.begin(), all_positions.end());
    }

    size_t triangleCount() const { return position_ids.triangleCount(); }
    Corners triangleCorners(TriangleId triangle) const { return corner_positions.triangle(triangle); }

private:
    static IdVector<TriangleId, DistanceTriangle>
    makeDistanceTriangles(CornerSpan<const Float3> corner_positions)
    {
        IdVector<TriangleId, DistanceTriangle> triangles;
        triangles.reserve(corner_positions.triangleCount());
        for (const TriangleId triangle : corner_positions.triangles())
        {
            const auto [a, b, c] = corner_positions.triangle(triangle);
            triangles.push_back(makeDistanceTriangle(a, b, c));
        }
        return triangles;
    }

    static CornerVector<Float3> gatherPositions(CornerSpan<const PositionId> position_ids,
                                                IdSpan<PositionId, const Float3> position_of_id)
    {
        CornerVector<Float3> corner_positions;
        corner_positions.reserve(position_ids.size());
        for (const PositionId position : position_ids)
            corner_positions.push_back(position_of_id[position]);
        return corner_positions;
    }
};

} // namespace hearth::clusters
