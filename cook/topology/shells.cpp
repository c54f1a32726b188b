// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/shells.h"

#include "cook/topology/nesting.h"
#include "cook/topology/vertex_fans.h"
#include "formats/base/disjoint_sets.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hearth::topology
{

namespace
{

/// Volume over area times diagonal under which a closed shell is flat: float positions of a leaf whose
/// two sides are cut differently leave some 1e-7.
constexpr double kFlat = 1e-6;

Shells joinTriangles(const Surface& surface, const Edges& edges)
{
    DisjointSets sets(surface.triangleCount());
    for (uint32_t half_edge = 0; half_edge < edges.opposite.size(); ++half_edge)
        if (edges.opposite[half_edge] != kInvalidIndex)
            sets.unite(half_edge / 3, edges.opposite[half_edge] / 3);
    Shells shells;
    shells.shell_of_triangle.resize(surface.triangleCount());
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
    {
        const uint32_t first = sets.find(t); // the lowest of its shell
        if (first == t)
        {
            shells.shell_of_triangle[t] = static_cast<uint32_t>(shells.shells.size());
            shells.shells.emplace_back().first_triangle = t;
        }
        shells.shell_of_triangle[t] = shells.shell_of_triangle[first];
        ++shells.shells[shells.shell_of_triangle[t]].triangles;
    }
    return shells;
}

/// Walk through each shell from its first triangle on, and mark the triangles that face the other side
/// than most.
void compareSides(const Surface& surface, const Edges& edges, Shells& shells)
{
    std::vector<bool> is_visited(surface.triangleCount(), false);
    shells.is_reversed.assign(surface.triangleCount(), false);
    std::vector<uint32_t> shell_triangles; // of the walk, in its order
    for (Shell& shell : shells.shells)
    {
        shell_triangles.assign(1, shell.first_triangle);
        is_visited[shell.first_triangle] = true;
        for (size_t i = 0; i < shell_triangles.size(); ++i)
            for (uint32_t half_edge = 3 * shell_triangles[i]; half_edge < 3 * shell_triangles[i] + 3;
                 ++half_edge)
            {
                const uint32_t other = edges.opposite[half_edge];
                if (other == kInvalidIndex)
                    continue;
                const bool is_reversed =
                    shells.is_reversed[half_edge / 3] != runsAlong(surface, half_edge, other);
                if (!is_visited[other / 3])
                {
                    is_visited[other / 3] = true;
                    shells.is_reversed[other / 3] = is_reversed;
                    shell_triangles.push_back(other / 3);
                }
                else if (shells.is_reversed[other / 3] != is_reversed)
                    shell.is_orientable = false;
            }
        const auto reversed = static_cast<uint32_t>(
            std::count_if(shell_triangles.begin(), shell_triangles.end(),
                          [&](uint32_t triangle) { return shells.is_reversed[triangle]; }));
        shell.reversed = !shell.is_orientable ? 0 : std::min(reversed, shell.triangles - reversed);
        if (shell.reversed != reversed)
            for (const uint32_t triangle : shell_triangles)
                shells.is_reversed[triangle] = shell.is_orientable && !shells.is_reversed[triangle];
    }
}

/// Counts vertices and edges of each shell, where a position that several fans of a shell meet at is
/// several vertices.
class EulerCharacteristics
{
public:
    EulerCharacteristics(const Surface& surface, const Edges& edges, Shells& shells)
        : surface_(surface),
          shells_(shells),
          vertices_(surface.corners.size()),
          edge_count_(shells.shells.size(), 0),
          vertex_count_(shells.shells.size(), 0)
    {
        for (const Edge& edge : edges.edges)
            addEdge(edge, edges.halfEdges(edge));
        for (uint32_t corner = 0; corner < surface.corners.size(); ++corner)
            if (vertices_.find(corner) == corner)
                ++vertex_count_[shells.shell_of_triangle[corner / 3]];
    }

    /// Return V - E + F.
    int64_t calculate(uint32_t shell) const
    {
        return vertex_count_[shell] - edge_count_[shell] + int64_t{shells_.shells[shell].triangles};
    }

private:
    /// Join the triangles of each shell at the edge. A shell is open where it has one, or more than
    /// two.
    void addEdge(const Edge& edge, std::span<const uint32_t> half_edges)
    {
        std::vector<uint32_t>& sorted = sorted_;
        sorted.assign(half_edges.begin(), half_edges.end());
        const auto findShell = [&](uint32_t half_edge) { return shells_.shell_of_triangle[half_edge / 3]; };
        if (sorted.size() > 2) // the two triangles of other edges are of one shell
            std::sort(sorted.begin(), sorted.end(),
                      [&](uint32_t a, uint32_t b)
                      { return std::pair(findShell(a), a) < std::pair(findShell(b), b); });
        for (size_t i = 0, end = 0; i < sorted.size(); i = end)
        {
            const uint32_t shell = findShell(sorted[i]);
            while (end < sorted.size() && findShell(sorted[end]) == shell)
                ++end;
            ++edge_count_[shell];
            if (end - i != 2 || (half_edges.size() > 2 && !joins(sorted[i], sorted[i + 1])))
            {
                shells_.shells[shell].is_closed = false;
                continue;
            }
            for (const uint32_t position : {edge.from, edge.to})
                vertices_.unite(cornerAt(surface_, sorted[i], position),
                                cornerAt(surface_, sorted[i + 1], position));
        }
    }

    /// True if two triangles of a shell continue each other, once reversed ones are turned.
    bool joins(uint32_t a, uint32_t b) const
    {
        return runsAlong(surface_, a, b) == (shells_.is_reversed[a / 3] != shells_.is_reversed[b / 3]);
    }

    const Surface& surface_;
    Shells& shells_;
    DisjointSets vertices_; ///< of corners
    std::vector<int64_t> edge_count_;
    std::vector<int64_t> vertex_count_;
    std::vector<uint32_t> sorted_;
};

/// Sum areas, volumes and boxes. Volumes are measured from the middle of each box, where they round
/// least.
void measure(const Surface& surface, Shells& shells)
{
    const auto corner = [&](uint32_t triangle, uint32_t k)
    { return surface.positions[surface.corners[3 * triangle + k]]; };
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
        for (uint32_t k = 0; k < 3; ++k)
            shells.shells[shells.shell_of_triangle[t]].box.add(corner(t, k));
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
    {
        Shell& shell = shells.shells[shells.shell_of_triangle[t]];
        const Double3 middle = (widen(shell.box.min) + widen(shell.box.max)) * 0.5;
        const Double3 a = widen(corner(t, 0)) - middle, b = widen(corner(t, 1)) - middle,
                      c = widen(corner(t, 2)) - middle;
        shell.area += length(cross(b - a, c - a)) / 2;
        const double volume = dot(a, cross(b, c)) / 6;
        shell.volume += shells.is_reversed[t] ? -volume : volume;
    }
}

ShellSide judgeSide(const Shell& shell)
{
    if (!shell.is_closed)
        return ShellSide::open;
    if (!shell.is_orientable)
        return ShellSide::unclear;
    const double diagonal = length(widen(shell.box.max) - widen(shell.box.min));
    if (std::abs(shell.volume) <= kFlat * shell.area * diagonal)
        return ShellSide::flat;
    return shell.volume > 0 ? ShellSide::outward : ShellSide::flipped;
}

void countDoubled(const Surface& surface, Shells& shells)
{
    std::vector<uint32_t> doubled; // triangles of the source that have a copy
    for (const DoubledTriangle& pair : surface.doubled)
        doubled.push_back(pair.first);
    std::sort(doubled.begin(), doubled.end());
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
        if (std::binary_search(doubled.begin(), doubled.end(), surface.source_of_triangle[t]))
            ++shells.shells[shells.shell_of_triangle[t]].doubled;
}

} // namespace

Shells findShells(const Surface& surface, const Edges& edges)
{
    Shells shells = joinTriangles(surface, edges);
    compareSides(surface, edges, shells);
    const EulerCharacteristics characteristics(surface, edges, shells);
    measure(surface, shells);
    countDoubled(surface, shells);
    for (uint32_t s = 0; s < shells.shells.size(); ++s)
    {
        Shell& shell = shells.shells[s];
        shell.side = judgeSide(shell);
        if (!shell.is_closed || !shell.is_orientable)
            shell.volume = 0;
        else // even for any closed orientable surface
            shell.genus = static_cast<uint32_t>((2 - characteristics.calculate(s)) / 2);
    }
    judgeInwardShells(surface, shells);
    return shells;
}

uint32_t countComponents(const Surface& surface)
{
    DisjointSets sets(surface.positions.size());
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
        for (uint32_t k = 1; k < 3; ++k)
            sets.unite(surface.corners[3 * t], surface.corners[3 * t + k]);
    std::vector<bool> is_counted(surface.positions.size(), false);
    uint32_t count = 0;
    for (const uint32_t corner : surface.corners)
    {
        const uint32_t piece = sets.find(corner);
        count += is_counted[piece] ? 0 : 1;
        is_counted[piece] = true;
    }
    return count;
}

} // namespace hearth::topology
