// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/unwrap/triangle_graph.h"

#include "cook/mesh/weld.h"
#include "formats/base/index.h"

#include <algorithm>
#include <tuple>

namespace hearth::receivers
{

namespace
{

/// Edge of a triangle, by position ids.
struct HalfEdge
{
    uint32_t low, high;
    uint32_t place; ///< 3 times the triangle, plus the corner that it starts at
    bool is_rising; ///< it goes from `low` to `high`

    auto key() const { return std::tuple(low, high, place); }
    bool joins(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<HalfEdge> listHalfEdges(std::span<const Float3> positions, std::span<const uint32_t> indices,
                                    std::span<const double> areas)
{
    const mesh::Weld weld = mesh::weldPositions(positions);
    std::vector<HalfEdge> edges;
    edges.reserve(indices.size());
    for (uint32_t place = 0; place < indices.size(); ++place)
    {
        const uint32_t triangle = place / 3;
        const uint32_t from = weld.position_id_of_vertex[indices[place]];
        const uint32_t to = weld.position_id_of_vertex[indices[3 * triangle + (place + 1) % 3]];
        if (areas[triangle] > 0)
            edges.push_back({std::min(from, to), std::max(from, to), place, from < to});
    }
    std::ranges::sort(edges, {}, &HalfEdge::key);
    return edges;
}

} // namespace

TriangleGraph::TriangleGraph(std::span<const Float3> positions, std::span<const uint32_t> indices)
    : neighbours(indices.size() / 3, {kInvalidIndex, kInvalidIndex, kInvalidIndex})
{
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
    {
        const Double3 corner = widen(positions[indices[i]]);
        const Double3 twice =
            cross(widen(positions[indices[i + 1]]) - corner, widen(positions[indices[i + 2]]) - corner);
        const double size = length(twice);
        areas.push_back(size / 2);
        normals.push_back(size > 0 ? twice * (1 / size) : Double3{});
    }
    const std::vector<HalfEdge> edges = listHalfEdges(positions, indices, areas);
    for (size_t first = 0; first < edges.size();)
    {
        size_t last = first + 1;
        while (last < edges.size() && edges[last].joins(edges[first]))
            ++last;
        const HalfEdge &a = edges[first], &b = edges[last - 1];
        if (last - first == 2 && a.is_rising != b.is_rising)
        {
            neighbours[a.place / 3][a.place % 3] = b.place / 3;
            neighbours[b.place / 3][b.place % 3] = a.place / 3;
        }
        first = last;
    }
}

} // namespace hearth::receivers
