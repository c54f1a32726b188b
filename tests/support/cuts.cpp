// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/cuts.h"

#include "cook/clusters/core/islands.h"
#include "cook/clusters/simplify/thinning.h"
#include "cook/mesh/triangles.h"

#include <algorithm>
#include <cmath>

namespace hearth::cuts
{

using clusters::DecodedHierarchy;
using clusters::Hierarchy;

std::vector<uint8_t> cutAtError(const Hierarchy& hierarchy, double error)
{
    std::vector<uint8_t> replaced;
    for (const auto& group : hierarchy.groups)
        replaced.push_back(group.error <= error ? 1 : 0);
    return replaced;
}

std::vector<uint8_t> cutFromEye(const Hierarchy& hierarchy, Float3 eye, double threshold)
{
    std::vector<uint8_t> replaced;
    for (const auto& group : hierarchy.groups)
    {
        // in floats as the runtime does: rounding must not break the cut
        const Float3 away = group.sphere_center - eye;
        const float distance = std::max(length(away) - group.sphere_radius, 1e-3f);
        replaced.push_back(group.error <= static_cast<float>(threshold) * distance ? 1 : 0);
    }
    return replaced;
}

std::vector<uint8_t> randomCut(const Hierarchy& hierarchy, double chance, std::mt19937& random)
{
    std::vector<uint8_t> replaced(hierarchy.groups.size(), 0);
    bool possible = true;
    for (size_t g = hierarchy.groups.size(); g-- > 0;)
    {
        const auto& group = hierarchy.groups[g];
        possible &= std::isfinite(group.error);
        for (uint32_t c = 0; c < group.clusters.count; ++c)
        {
            const uint32_t refined = hierarchy.clusters[group.clusters.first + c].refined_group;
            possible &= refined == kInvalidIndex || replaced[refined] != 0;
        }
        // the decision for a set is made at its first group, which comes last
        if (group.set_offset != 0)
            continue;
        const double roll = static_cast<double>(random()) / 4294967296.0;
        replaced[g] = possible && roll < chance ? 1 : 0;
        for (size_t h = g + 1; h < replaced.size() && hierarchy.groups[h].set_offset == h - g; ++h)
            replaced[h] = replaced[g];
        possible = true;
    }
    return replaced;
}

std::vector<uint32_t> trianglesOfCut(const Hierarchy& hierarchy, const DecodedHierarchy& decoded,
                                     std::span<const uint8_t> replaced)
{
    std::vector<uint32_t> triangles;
    for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
        triangles.insert(triangles.end(), decoded.clusters[c].positions.begin(),
                         decoded.clusters[c].positions.end());
    return triangles;
}

namespace
{

/// Edges that an odd number of triangles use, in either direction.
std::vector<uint64_t> oddEdges(std::span<const uint32_t> triangles)
{
    std::vector<uint64_t> edges;
    for (size_t t = 0; t < triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
        {
            const auto [low, high] = std::minmax(triangles[t + k], triangles[t + (k + 1) % 3]);
            edges.push_back(uint64_t{low} << 32 | high);
        }
    std::sort(edges.begin(), edges.end());
    std::vector<uint64_t> odd;
    for (size_t i = 0; i < edges.size();)
    {
        size_t end = i;
        while (end < edges.size() && edges[end] == edges[i])
            ++end;
        if ((end - i) % 2 != 0)
            odd.push_back(edges[i]);
        i = end;
    }
    return odd;
}

} // namespace

Border buildBorder(const Hierarchy& hierarchy, const DecodedHierarchy& decoded)
{
    const std::vector<uint8_t> nothing(hierarchy.groups.size(), 0);
    const auto triangles = trianglesOfCut(hierarchy, decoded, nothing);
    Border border;
    border.is_border.assign(decoded.positions.size(), 0);
    const auto open = mesh::openEdges(triangles);
    for (const auto& edge : open)
        border.is_border[edge.from] = border.is_border[edge.to] = 1;
    border.closed = open.empty();
    for (const uint64_t edge : oddEdges(triangles))
    {
        border.is_border[edge >> 32] = border.is_border[edge & 0xFFFFFFFFu] = 1;
        border.closed = false;
    }
    return border;
}

namespace
{

/// For each position that the triangles use, 1 if its island is as small as the islands that grow.
std::vector<uint8_t> grownIslands(const Border& border, std::span<const uint32_t> triangles)
{
    clusters::DisjointSets islands(border.is_border.size());
    for (size_t corner = 0; corner < triangles.size(); corner += 3)
    {
        islands.unite(triangles[corner], triangles[corner + 1]);
        islands.unite(triangles[corner], triangles[corner + 2]);
    }
    std::vector<uint32_t> triangle_count(border.is_border.size(), 0);
    for (size_t corner = 0; corner < triangles.size(); corner += 3)
        ++triangle_count[islands.find(triangles[corner])];
    std::vector<uint8_t> grown(border.is_border.size(), 0);
    for (const uint32_t position : triangles)
        grown[position] =
            border.closed || triangle_count[islands.find(position)] > clusters::kMaxGrownTriangles ? 0 : 1;
    return grown;
}

} // namespace

std::string findCrack(const Border& border, std::span<const uint32_t> triangles)
{
    const std::vector<uint8_t> grown = grownIslands(border, triangles);
    const auto outside = [&](uint32_t from, uint32_t to)
    { return (border.is_border[from] == 0 || border.is_border[to] == 0) && (grown[from] & grown[to]) == 0; };
    for (const auto& edge : mesh::openEdges(triangles))
        if (outside(edge.from, edge.to))
            return "open edge " + std::to_string(edge.from) + " -> " + std::to_string(edge.to);
    for (const uint64_t edge : oddEdges(triangles))
        if (outside(static_cast<uint32_t>(edge >> 32), static_cast<uint32_t>(edge)))
            return "edge with an odd number of triangles";
    return "";
}

} // namespace hearth::cuts
