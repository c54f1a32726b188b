// Surface before or after a simplification, with its search structures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/triangle_block.h"
#include "cook/clusters/surface/piece_bound.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Lists of numbers in one array (compressed sparse rows).
class IndexLists
{
public:
    /// Append i / N to list keys[i], or to none if that is not below `list_count`.
    template <uint32_t N>
    static IndexLists byKey(size_t list_count, std::span<const uint32_t> keys)
    {
        IndexLists lists;
        lists.offsets_.assign(list_count + 1, 0);
        for (const uint32_t key : keys)
            if (key < list_count)
                ++lists.offsets_[key + 1];
        for (size_t i = 1; i < lists.offsets_.size(); ++i)
            lists.offsets_[i] += lists.offsets_[i - 1];
        lists.items_.resize(lists.offsets_.back());
        std::vector<uint32_t> next(lists.offsets_.begin(), lists.offsets_.end() - 1);
        for (uint32_t i = 0; i < keys.size(); ++i)
            if (keys[i] < list_count)
                lists.items_[next[keys[i]]++] = i / N;
        return lists;
    }

    std::span<const uint32_t> list(uint32_t key) const
    {
        return std::span(items_).subspan(offsets_[key], offsets_[key + 1] - offsets_[key]);
    }

private:
    std::vector<uint32_t> offsets_;
    std::vector<uint32_t> items_;
};

/// Triangulated surface of a group; all arrays are in local units.
struct Surface
{
    std::vector<uint32_t> position_ids;   ///< position ids, three for each triangle
    std::vector<Float3> corner_positions; ///< positions of the same corners
    std::vector<DistanceTriangle> triangles;
    std::vector<Float3> position_of_id;
    IndexLists triangles_at; ///< triangles at each position

    /// corner_ids         position ids, three for each triangle
    /// position_of_id  position of every position id
    Surface(std::vector<uint32_t> corner_ids, std::span<const Float3> all_positions)
        : position_ids(std::move(corner_ids)),
          corner_positions(gatherPositions(position_ids, all_positions)),
          triangles(makeDistanceTriangles(corner_positions)),
          position_of_id(all_positions.begin(), all_positions.end()),
          triangles_at(IndexLists::byKey<3>(all_positions.size(), position_ids))
    {
    }

    /// Move the positions; the triangles stay the same.
    void setPositions(std::span<const Float3> all_positions)
    {
        corner_positions = gatherPositions(position_ids, all_positions);
        triangles = makeDistanceTriangles(corner_positions);
        position_of_id.assign(all_positions.begin(), all_positions.end());
    }

    size_t triangleCount() const { return position_ids.size() / 3; }
    Corners triangleCorners(size_t triangle) const
    {
        return {corner_positions[triangle * 3], corner_positions[triangle * 3 + 1],
                corner_positions[triangle * 3 + 2]};
    }

private:
    static std::vector<DistanceTriangle> makeDistanceTriangles(std::span<const Float3> corner_positions)
    {
        std::vector<DistanceTriangle> triangles;
        triangles.reserve(corner_positions.size() / 3);
        for (size_t corner = 0; corner < corner_positions.size(); corner += 3)
            triangles.push_back(makeDistanceTriangle(corner_positions[corner], corner_positions[corner + 1],
                                                     corner_positions[corner + 2]));
        return triangles;
    }

    static std::vector<Float3> gatherPositions(std::span<const uint32_t> position_ids,
                                               std::span<const Float3> position_of_id)
    {
        std::vector<Float3> corner_positions;
        corner_positions.reserve(position_ids.size());
        for (const uint32_t position : position_ids)
            corner_positions.push_back(position_of_id[position]);
        return corner_positions;
    }
};

} // namespace hearth::clusters
