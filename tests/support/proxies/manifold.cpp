// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/proxies/manifold.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace hearth::test
{

namespace
{

using DirectedEdge = std::pair<uint32_t, uint32_t>;

std::vector<DirectedEdge> sortDirectedEdges(std::span<const uint32_t> triangles)
{
    std::vector<DirectedEdge> edges;
    for (size_t corner = 0; corner < triangles.size(); ++corner)
        edges.emplace_back(triangles[corner], triangles[corner % 3 == 2 ? corner - 2 : corner + 1]);
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Count the fans at a vertex: paths and circles along the edges opposite to it.
/// next  where the edge that begins at a vertex ends
size_t countFans(std::map<uint32_t, uint32_t> next)
{
    std::map<uint32_t, uint32_t> previous;
    for (const auto& [from, to] : next)
        previous[to] = from;
    size_t fans = 0;
    while (!next.empty())
    {
        ++fans;
        // walk to the beginning of the path, or once around the circle, then along it
        const uint32_t first = next.begin()->first;
        uint32_t at = first;
        for (auto found = previous.find(at); found != previous.end(); found = previous.find(at))
        {
            at = found->second;
            if (at == first)
                break;
        }
        for (auto found = next.find(at); found != next.end(); found = next.find(at))
        {
            at = found->second;
            next.erase(found);
        }
    }
    return fans;
}

} // namespace

std::string findManifoldDefect(size_t vertex_count, std::span<const uint32_t> triangles)
{
    const std::vector<DirectedEdge> edges = sortDirectedEdges(triangles);
    for (const auto& [from, to] : edges)
        if (from == to)
            return "a triangle names vertex " + std::to_string(from) + " twice";
    if (const auto twice = std::adjacent_find(edges.begin(), edges.end()); twice != edges.end())
        return "several triangles pass edge " + std::to_string(twice->first) + " " +
               std::to_string(twice->second) + " the same way";
    std::vector<std::map<uint32_t, uint32_t>> opposite(vertex_count);
    for (size_t t = 0; t < triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
            opposite[triangles[t + k]][triangles[t + (k + 1) % 3]] = triangles[t + (k + 2) % 3];
    for (size_t v = 0; v < vertex_count; ++v)
        if (const size_t fans = countFans(opposite[v]); fans != 1)
            return "vertex " + std::to_string(v) + " has " + std::to_string(fans) + " fans";
    return "";
}

size_t countOpenEdges(std::span<const uint32_t> triangles)
{
    const std::vector<DirectedEdge> edges = sortDirectedEdges(triangles);
    return static_cast<size_t>(std::count_if(
        edges.begin(), edges.end(),
        [&](const DirectedEdge& edge)
        { return !std::binary_search(edges.begin(), edges.end(), DirectedEdge(edge.second, edge.first)); }));
}

} // namespace hearth::test
