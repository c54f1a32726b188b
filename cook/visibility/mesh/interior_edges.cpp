// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/mesh/interior_edges.h"

#include <algorithm>

namespace hearth::visibility
{

namespace
{

/// Edge of a triangle, in the list of its lower vertex.
struct Side
{
    uint32_t other;
    uint32_t corner; ///< 3 * triangle + index of the opposite corner
};

struct Sides
{
    std::vector<uint32_t> first; ///< start of each vertex's list, then the total
    std::vector<Side> sides;
};

Sides sidesByLesserVertex(std::span<const uint32_t> indices, size_t vertex_count)
{
    Sides lists;
    lists.first.assign(vertex_count + 1, 0);
    const auto ends = [&](size_t corner)
    {
        const size_t t = corner / 3 * 3, k = corner % 3;
        return std::minmax(indices[t + (k + 1) % 3], indices[t + (k + 2) % 3]);
    };
    for (size_t corner = 0; corner < indices.size(); ++corner)
        ++lists.first[ends(corner).first + 1];
    for (size_t v = 0; v < vertex_count; ++v)
        lists.first[v + 1] += lists.first[v];
    std::vector<uint32_t> next(lists.first.begin(), lists.first.end() - 1);
    lists.sides.resize(indices.size());
    for (size_t corner = 0; corner < indices.size(); ++corner)
    {
        const auto [lesser, greater] = ends(corner);
        lists.sides[next[lesser]++] = {greater, static_cast<uint32_t>(corner)};
    }
    return lists;
}

} // namespace

std::vector<InteriorEdge> interiorEdges(std::span<const uint32_t> indices, size_t vertex_count)
{
    Sides lists = sidesByLesserVertex(indices, vertex_count);
    std::vector<InteriorEdge> edges;
    edges.reserve(indices.size() / 2);
    for (uint32_t a = 0; a < vertex_count; ++a)
    {
        const std::span<Side> sides(lists.sides.data() + lists.first[a],
                                    lists.sides.data() + lists.first[a + 1]);
        std::sort(sides.begin(), sides.end(),
                  [](Side x, Side y)
                  { return x.other != y.other ? x.other < y.other : x.corner < y.corner; });
        for (size_t i = 0, end = 0; i < sides.size(); i = end)
        {
            for (end = i; end < sides.size() && sides[end].other == sides[i].other;)
                ++end;
            if (end - i == 2)
                edges.push_back({a,
                                 sides[i].other,
                                 indices[sides[i].corner],
                                 indices[sides[i + 1].corner],
                                 {sides[i].corner / 3, sides[i + 1].corner / 3}});
        }
    }
    return edges;
}

} // namespace hearth::visibility
