// Welds vertices with a hash grid in six dimensions: three of the position, three of the normal. A vertex is
// stored in one cell and searches all cells within its tolerances, mostly that one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/mesh/vertex_weld.h"

#include "formats/base/disjoint_sets.h"
#include "formats/base/index.h"

#include <array>
#include <bit>
#include <cmath>

namespace hearth::visibility
{

namespace
{

// Cell size in tolerances: larger cells need fewer searches in neighbours, but hold more vertices that are
// too far away.
constexpr double kCellSize = 5;

using Cell = std::array<int64_t, 6>;

uint64_t hashCell(const Cell& cell)
{
    uint64_t hash = 0;
    for (const int64_t part : cell)
    {
        // finaliser of splitmix64 (S. Vigna)
        hash = (hash ^ static_cast<uint64_t>(part)) + 0x9E3779B97F4A7C15u;
        hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9u;
        hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBu;
        hash ^= hash >> 31;
    }
    return hash;
}

class Welder
{
public:
    Welder(std::span<const Float3> positions, std::span<const Float3> normals, double position_tolerance,
           double normal_tolerance)
        : positions_(positions),
          normals_(normals),
          position_tolerance_(position_tolerance),
          normal_tolerance_(normal_tolerance),
          sets_(positions.size()),
          next_(positions.size(), kInvalidIndex),
          heads_(std::bit_ceil(positions.size() * 2 + 1), kInvalidIndex)
    {
    }

    std::vector<uint32_t> weld()
    {
        for (uint32_t vertex = 0; vertex < next_.size(); ++vertex)
        {
            const Cell own = cellAt(vertex, 0);
            // an exact duplicate is merged and not searched for again: a thousand triangles that meet in one
            // vertex, each with its own copy, cost no time
            if (const uint32_t equal = findEqual(own, vertex); equal != kInvalidIndex)
            {
                sets_.unite(vertex, equal);
                continue;
            }
            uniteWithNeighbours(vertex);
            uint32_t& head = listHead(own);
            next_[vertex] = head;
            head = vertex;
        }
        std::vector<uint32_t> first(next_.size());
        for (uint32_t vertex = 0; vertex < next_.size(); ++vertex)
            first[vertex] = sets_.find(vertex);
        return first;
    }

private:
    double coordinate(uint32_t vertex, size_t axis) const
    {
        return axis < 3 ? positions_[vertex][static_cast<int>(axis)]
                        : normals_[vertex][static_cast<int>(axis) - 3];
    }

    double axisTolerance(size_t axis) const { return axis < 3 ? position_tolerance_ : normal_tolerance_; }

    /// Return the cell of a vertex that is moved by `tolerances` in every axis.
    Cell cellAt(uint32_t vertex, double tolerances) const
    {
        Cell cell;
        for (size_t axis = 0; axis < 6; ++axis)
        {
            const double x = coordinate(vertex, axis), tolerance = axisTolerance(axis);
            // without a tolerance, the cell is the coordinate itself; + 0.0 turns -0 into 0
            cell[axis] =
                tolerance > 0
                    ? static_cast<int64_t>(std::floor((x + tolerances * tolerance) / (kCellSize * tolerance)))
                    : std::bit_cast<int64_t>(x + 0.0);
        }
        return cell;
    }

    uint32_t& listHead(const Cell& cell) { return heads_[hashCell(cell) & (heads_.size() - 1)]; }

    uint32_t findEqual(const Cell& cell, uint32_t vertex)
    {
        for (uint32_t other = listHead(cell); other != kInvalidIndex; other = next_[other])
            if (positions_[other] == positions_[vertex] && normals_[other] == normals_[vertex])
                return other;
        return kInvalidIndex;
    }

    bool isNear(uint32_t a, uint32_t b) const
    {
        for (size_t axis = 0; axis < 6; ++axis)
            if (!(std::abs(coordinate(a, axis) - coordinate(b, axis)) <= axisTolerance(axis)))
                return false;
        return true;
    }

    void uniteWithNeighbours(uint32_t vertex)
    {
        // slightly more than the tolerance, because sums are rounded
        const Cell low = cellAt(vertex, -1.001), high = cellAt(vertex, 1.001);
        for (Cell cell = low;;)
        {
            for (uint32_t other = listHead(cell); other != kInvalidIndex; other = next_[other])
                if (isNear(vertex, other))
                    sets_.unite(vertex, other);
            size_t axis = 0;
            while (axis < 6 && cell[axis] == high[axis])
            {
                cell[axis] = low[axis];
                ++axis;
            }
            if (axis == 6)
                return;
            ++cell[axis];
        }
    }

    std::span<const Float3> positions_;
    std::span<const Float3> normals_;
    double position_tolerance_;
    double normal_tolerance_;
    DisjointSets sets_;           ///< of vertices that are welded
    std::vector<uint32_t> next_;  ///< next vertex in the cell's list
    std::vector<uint32_t> heads_; ///< first vertex of each list; cells may share a list
};

} // namespace

std::vector<uint32_t> weldVertices(std::span<const Float3> positions, std::span<const Float3> normals,
                                   double position_tolerance, double normal_tolerance)
{
    return Welder(positions, normals, position_tolerance, normal_tolerance).weld();
}

} // namespace hearth::visibility
