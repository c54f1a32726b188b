// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/half_edges.h"

#include "formats/base/disjoint_sets.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace hearth::proxy
{

namespace
{

// Uses of an edge whose flattest pairs are looked for: all pairs are tried.
constexpr size_t kMaxFlattened = 64;

/// Half-edge with its undirected edge.
struct EdgeUse
{
    uint64_t ends; ///< lower vertex, higher one
    uint32_t half_edge;
    bool ascends; ///< from the lower vertex to the higher one
};

/// Return all half-edges, sorted by edge.
std::vector<EdgeUse> sortEdgeUses(std::span<const uint32_t> indices)
{
    std::vector<EdgeUse> uses;
    uses.reserve(indices.size());
    for (uint32_t h = 0; h < indices.size(); ++h)
    {
        const uint32_t from = indices[h], to = indices[nextHalfEdge(h)];
        uses.push_back({uint64_t{std::min(from, to)} << 32 | std::max(from, to), h, from < to});
    }
    std::sort(uses.begin(), uses.end(),
              [](const EdgeUse& a, const EdgeUse& b)
              { return a.ends != b.ends ? a.ends < b.ends : a.half_edge < b.half_edge; });
    return uses;
}

/// Call `use` with the uses of each edge.
template <typename Use>
void forEachEdge(std::span<const EdgeUse> uses, const Use& use)
{
    for (size_t first = 0, end = 0; first < uses.size(); first = end)
    {
        while (end < uses.size() && uses[end].ends == uses[first].ends)
            ++end;
        use(uses.subspan(first, end - first));
    }
}

/// Number of [0, 4) that grows with the angle of (x, y), by exact steps on every machine.
double pseudoAngle(double x, double y)
{
    const double sum = std::abs(x) + std::abs(y);
    if (sum == 0)
        return 0;
    if (y >= 0)
        return x >= 0 ? y / sum : 2 - y / sum;
    return x < 0 ? 2 - y / sum : 4 + y / sum;
}

/// Use of an edge with the angle of its triangle around the edge.
struct AngledUse
{
    double angle; ///< as pseudoAngle: opposite sides differ by 2
    EdgeUse use;
};

/// Sort the uses of an edge counterclockwise around it, seen from its end.
std::vector<AngledUse> sortAroundEdge(const Surface& surface, std::span<const EdgeUse> uses)
{
    const Double3 from = widen(surface.positions[uses[0].ends >> 32]);
    const Double3 axis = widen(surface.positions[uses[0].ends & 0xFFFFFFFFu]) - from;
    const auto findSide = [&](const EdgeUse& use)
    {
        const uint32_t corner = surface.indices[nextHalfEdge(nextHalfEdge(use.half_edge))];
        return widen(surface.positions[corner]) - from;
    };
    const Double3 y = cross(axis, findSide(uses[0])); // a quarter turn after the first triangle
    const Double3 x = cross(y, axis);
    const double to_x = length(x), to_y = length(y);
    std::vector<AngledUse> sorted;
    for (const EdgeUse& use : uses)
    {
        const Double3 side = findSide(use);
        sorted.push_back({pseudoAngle(dot(side, x) * to_y, dot(side, y) * to_x), use});
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const AngledUse& a, const AngledUse& b) { return a.angle < b.angle; });
    return sorted;
}

using UsePair = std::pair<EdgeUse, EdgeUse>;

/// Pair neighbours around an edge whose backs face each other.
std::vector<UsePair> pairSolids(std::span<const AngledUse> around)
{
    // a triangle that descends has its back at larger angles, one that ascends at smaller ones
    std::vector<UsePair> pairs;
    for (size_t i = 0; i < around.size(); ++i)
    {
        const EdgeUse& next = around[(i + 1) % around.size()].use;
        if (!around[i].use.ascends && next.ascends)
            pairs.emplace_back(around[i].use, next);
    }
    return pairs;
}

/// Pair triangles that pass an edge in opposite directions, those first that are closest to one plane.
std::vector<UsePair> pairFlattest(std::span<const AngledUse> around)
{
    struct Candidate
    {
        double bend;
        size_t descending, ascending;
    };
    std::vector<Candidate> candidates;
    for (size_t d = 0; d < around.size(); ++d)
        for (size_t a = 0; a < around.size(); ++a)
            if (!around[d].use.ascends && around[a].use.ascends)
                candidates.push_back({std::abs(std::abs(around[a].angle - around[d].angle) - 2), d, a});
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.bend < b.bend; });
    std::vector<bool> is_paired(around.size(), false);
    std::vector<UsePair> pairs;
    for (const Candidate& candidate : candidates)
    {
        if (is_paired[candidate.descending] || is_paired[candidate.ascending])
            continue;
        is_paired[candidate.descending] = is_paired[candidate.ascending] = true;
        pairs.emplace_back(around[candidate.descending].use, around[candidate.ascending].use);
    }
    return pairs;
}

/// Edge of a manifold: one half-edge, or two that are joined.
struct ManifoldEdge
{
    uint32_t half_edge;
    uint32_t joined; ///< or kInvalidIndex
};

/// Return, of edges that have the same two ends, all but the first.
std::vector<ManifoldEdge> findSecondEdges(const Surface& surface, std::span<const uint32_t> joined)
{
    std::vector<ManifoldEdge> second;
    const std::vector<EdgeUse> uses = sortEdgeUses(surface.indices);
    forEachEdge(uses,
                [&](std::span<const EdgeUse> edge)
                {
                    bool is_first = true;
                    for (const EdgeUse& use : edge)
                    {
                        const uint32_t other = joined[use.half_edge];
                        if (other != kInvalidIndex && other < use.half_edge)
                            continue; // counted with the other half
                        if (!is_first)
                            second.push_back({use.half_edge, other});
                        is_first = false;
                    }
                });
    return second;
}

/// Replace a triangle by triangles that have the middles of some of its edges as corners, too.
/// middles  of the edges from corners 0, 1 and 2, or kInvalidIndex; at least one
void subdivide(Surface& surface, uint32_t triangle, const std::array<uint32_t, 3>& middles)
{
    std::vector<uint32_t> border;
    size_t first_middle = 0;
    for (uint32_t k = 3; k-- > 0;)
    {
        if (middles[k] != kInvalidIndex)
            border.insert(border.begin(), middles[k]);
        border.insert(border.begin(), surface.indices[3 * triangle + k]);
    }
    while (std::find(middles.begin(), middles.end(), border[first_middle]) == middles.end())
        ++first_middle;
    // a fan from a middle has no triangle on one line, since the other middles lie on other edges
    std::rotate(border.begin(), border.begin() + static_cast<ptrdiff_t>(first_middle), border.end());
    const uint32_t material = surface.materials[triangle];
    for (size_t i = 2; i < border.size(); ++i)
    {
        if (i > 2)
        {
            surface.add({border[0], border[i - 1], border[i]}, material);
            continue;
        }
        surface.indices[3 * triangle] = border[0];
        surface.indices[3 * triangle + 1] = border[1];
        surface.indices[3 * triangle + 2] = border[2];
    }
}

/// Give all but the first of the edges between the same two vertices a vertex in their middle.
/// returns  their number
uint32_t separateSecondEdges(Surface& surface, std::span<const uint32_t> joined)
{
    const size_t first_middle = surface.positions.size();
    std::vector<std::pair<uint32_t, uint32_t>> middle_of_half_edge;
    for (const ManifoldEdge& edge : findSecondEdges(surface, joined))
    {
        const auto middle = static_cast<uint32_t>(surface.positions.size());
        const Double3 from = widen(surface.positions[surface.indices[edge.half_edge]]);
        const Double3 to = widen(surface.positions[surface.indices[nextHalfEdge(edge.half_edge)]]);
        surface.positions.push_back(narrow((from + to) * 0.5));
        middle_of_half_edge.emplace_back(edge.half_edge, middle);
        if (edge.joined != kInvalidIndex)
            middle_of_half_edge.emplace_back(edge.joined, middle);
    }
    std::sort(middle_of_half_edge.begin(), middle_of_half_edge.end());
    for (size_t i = 0; i < middle_of_half_edge.size();)
    {
        const uint32_t triangle = middle_of_half_edge[i].first / 3;
        std::array<uint32_t, 3> middles{kInvalidIndex, kInvalidIndex, kInvalidIndex};
        for (; i < middle_of_half_edge.size() && middle_of_half_edge[i].first / 3 == triangle; ++i)
            middles[middle_of_half_edge[i].first % 3] = middle_of_half_edge[i].second;
        subdivide(surface, triangle, middles);
    }
    return static_cast<uint32_t>(surface.positions.size() - first_middle);
}

} // namespace

std::vector<uint32_t> joinHalfEdges(const Surface& surface)
{
    std::vector<uint32_t> joined(surface.indices.size(), kInvalidIndex);
    const auto join = [&](const EdgeUse& a, const EdgeUse& b)
    {
        joined[a.half_edge] = b.half_edge;
        joined[b.half_edge] = a.half_edge;
    };
    const auto joinEdge = [&](std::span<const EdgeUse> uses)
    {
        if (uses.size() == 2 && uses[0].ascends != uses[1].ascends)
            return join(uses[0], uses[1]);
        if (uses.size() < 3)
            return;
        const std::vector<AngledUse> around = sortAroundEdge(surface, uses);
        std::vector<UsePair> pairs = pairSolids(around);
        if (2 * pairs.size() < around.size() && around.size() <= kMaxFlattened)
            pairs = pairFlattest(around);
        for (const auto& [a, b] : pairs)
            join(a, b);
    };
    const std::vector<EdgeUse> uses = sortEdgeUses(surface.indices);
    forEachEdge(uses, joinEdge);
    return joined;
}

ManifoldStatistics splitNonManifold(Surface& surface)
{
    ManifoldStatistics statistics;
    const auto isComplex = [](std::span<const EdgeUse> edge)
    { return edge.size() > 2 || (edge.size() == 2 && edge[0].ascends == edge[1].ascends); };
    forEachEdge(sortEdgeUses(surface.indices),
                [&](std::span<const EdgeUse> edge) { statistics.split_edges += isComplex(edge) ? 1 : 0; });

    const std::vector<uint32_t> joined = joinHalfEdges(surface);
    DisjointSets fans(surface.indices.size());
    for (uint32_t h = 0; h < joined.size(); ++h)
        if (joined[h] != kInvalidIndex)
            fans.unite(h, nextHalfEdge(joined[h]));

    std::vector<uint32_t> vertex_of_fan(surface.indices.size(), kInvalidIndex);
    std::vector<bool> is_used(surface.positions.size(), false);
    std::vector<Float3> positions;
    for (uint32_t corner = 0; corner < surface.indices.size(); ++corner)
    {
        uint32_t& vertex = vertex_of_fan[fans.find(corner)];
        if (vertex == kInvalidIndex)
        {
            vertex = static_cast<uint32_t>(positions.size());
            positions.push_back(surface.positions[surface.indices[corner]]);
            statistics.split_vertices += is_used[surface.indices[corner]] ? 1 : 0;
            is_used[surface.indices[corner]] = true;
        }
    }
    for (uint32_t corner = 0; corner < surface.indices.size(); ++corner)
        surface.indices[corner] = vertex_of_fan[fans.find(corner)];
    surface.positions = std::move(positions);
    statistics.added_vertices = separateSecondEdges(surface, joined);
    return statistics;
}

} // namespace hearth::proxy
