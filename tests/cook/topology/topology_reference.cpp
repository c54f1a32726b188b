// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/topology/topology_reference.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace hearth::reference
{

namespace
{

LatticePoint minus(LatticePoint a, LatticePoint b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
LatticePoint cross(LatticePoint a, LatticePoint b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
int dot(LatticePoint a, LatticePoint b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(LatticePoint a)
{
    return std::sqrt(static_cast<double>(dot(a, a)));
}

bool isNull(LatticePoint a)
{
    return a == LatticePoint{};
}

using Ends = std::pair<LatticePoint, LatticePoint>; ///< the lesser first

Ends makeEnds(LatticePoint a, LatticePoint b)
{
    return {std::min(a, b), std::max(a, b)};
}

std::vector<Ends> listEdges(const LatticeTriangle& t)
{
    return {makeEnds(t[0], t[1]), makeEnds(t[1], t[2]), makeEnds(t[2], t[0])};
}

bool hasEdge(const LatticeTriangle& t, const Ends& edge)
{
    const std::vector<Ends> edges = listEdges(t);
    return std::find(edges.begin(), edges.end(), edge) != edges.end();
}

bool hasCorner(const LatticeTriangle& t, LatticePoint p)
{
    return t[0] == p || t[1] == p || t[2] == p;
}

/// True if the triangle runs from the lesser end of the edge to the other.
bool ascends(const LatticeTriangle& t, const Ends& edge)
{
    for (size_t k = 0; k < 3; ++k)
        if (t[k] == edge.first && t[(k + 1) % 3] == edge.second)
            return true;
    return false;
}

/// Corners in their order, from the least on.
LatticeTriangle rotated(LatticeTriangle t)
{
    while (t[0] != *std::min_element(t.begin(), t.end()))
        t = {t[1], t[2], t[0]};
    return t;
}

/// Split items 0 .. count - 1 into groups that hang together.
std::vector<std::vector<size_t>> split(size_t count, const std::function<bool(size_t, size_t)>& isJoined)
{
    std::vector<std::vector<size_t>> groups;
    std::vector<bool> is_taken(count, false);
    for (size_t start = 0; start < count; ++start)
    {
        if (is_taken[start])
            continue;
        is_taken[start] = true;
        std::vector<size_t> group{start};
        for (size_t i = 0; i < group.size(); ++i)
            for (size_t other = 0; other < count; ++other)
                if (!is_taken[other] && isJoined(group[i], other))
                {
                    is_taken[other] = true;
                    group.push_back(other);
                }
        groups.push_back(group);
    }
    return groups;
}

class Search
{
public:
    explicit Search(const std::vector<LatticeTriangle>& soup)
    {
        std::set<LatticeTriangle> kept; // by sorted corners
        for (const LatticeTriangle& t : soup)
        {
            if (isNull(cross(minus(t[1], t[0]), minus(t[2], t[0]))))
            {
                ++facts_.zero_area;
                continue;
            }
            LatticeTriangle sorted = t;
            std::sort(sorted.begin(), sorted.end());
            if (kept.insert(sorted).second)
            {
                triangles_.push_back(t);
                continue;
            }
            ++facts_.doubled;
            for (const LatticeTriangle& first : triangles_)
                if (rotated(first) == rotated({t[0], t[2], t[1]}))
                    ++facts_.opposite_doubled;
        }
        for (const LatticeTriangle& t : triangles_)
        {
            for (const Ends& edge : listEdges(t))
                edges_.insert(edge);
            points_.insert(t.begin(), t.end());
        }
    }

    TopologyFacts run()
    {
        facts_.components =
            split(triangles_.size(),
                  [&](size_t a, size_t b)
                  {
                      return std::any_of(triangles_[b].begin(), triangles_[b].end(),
                                         [&](LatticePoint p) { return hasCorner(triangles_[a], p); });
                  })
                .size();
        for (const Ends& edge : edges_)
        {
            const std::vector<size_t> around = findTriangles(edge);
            facts_.non_manifold_edges += around.size() > 2 ? 1 : 0;
            facts_.inconsistent_edges += around.size() == 2 && isInconsistent(edge) ? 1 : 0;
            for (const LatticePoint p : points_)
            {
                const LatticePoint along = minus(edge.second, edge.first), to = minus(p, edge.first);
                if (isNull(cross(along, to)) && dot(along, to) > 0 && dot(along, to) < dot(along, along))
                {
                    ++facts_.t_junctions;
                    facts_.open_t_junctions += around.size() == 1 ? 1 : 0;
                }
            }
        }
        for (const LatticePoint p : points_)
            if (const size_t fans = splitFans(p, {}, [](size_t count) { return count >= 2; }).size();
                fans > 1)
                facts_.non_manifold_vertices.push_back({p, fans});
        findLoops();
        findShells();
        return facts_;
    }

private:
    std::vector<size_t> findTriangles(const Ends& edge) const
    {
        std::vector<size_t> found;
        for (size_t t = 0; t < triangles_.size(); ++t)
            if (hasEdge(triangles_[t], edge))
                found.push_back(t);
        return found;
    }

    bool isInconsistent(const Ends& edge) const
    {
        const std::vector<size_t> pair = findTriangles(edge);
        return ascends(triangles_[pair[0]], edge) == ascends(triangles_[pair[1]], edge);
    }

    /// Split the triangles at a point into groups by the edges that they share there.
    /// among   only these; empty: all
    /// joins   whether an edge of so many triangles (among them) joins them
    std::vector<std::vector<size_t>> splitFans(LatticePoint p, const std::set<size_t>& among,
                                               const std::function<bool(size_t)>& joins) const
    {
        std::vector<size_t> here;
        for (size_t t = 0; t < triangles_.size(); ++t)
            if (hasCorner(triangles_[t], p) && (among.empty() || among.contains(t)))
                here.push_back(t);
        auto groups =
            split(here.size(),
                  [&](size_t a, size_t b)
                  {
                      for (const Ends& edge : listEdges(triangles_[here[a]]))
                      {
                          if ((edge.first != p && edge.second != p) || !hasEdge(triangles_[here[b]], edge))
                              continue;
                          size_t count = 0;
                          for (const size_t t : here)
                              count += hasEdge(triangles_[t], edge) ? 1 : 0;
                          if (joins(count))
                              return true;
                      }
                      return false;
                  });
        for (auto& group : groups)
            for (size_t& t : group)
                t = here[t];
        return groups;
    }

    /// Return the boundary edge at the other end of the fan in which `edge` ends at p; nullopt if there
    /// is none.
    std::optional<Ends> findPartner(const Ends& edge, LatticePoint p) const
    {
        for (const auto& fan : splitFans(p, {}, [](size_t count) { return count == 2; }))
        {
            std::vector<Ends> ends;
            bool has_edge = false;
            for (const size_t t : fan)
                for (const Ends& side : listEdges(triangles_[t]))
                    if ((side.first == p || side.second == p) && findTriangles(side).size() == 1)
                    {
                        has_edge |= side == edge;
                        ends.push_back(side);
                    }
            if (has_edge)
                return ends.size() == 2 ? std::optional(ends[ends[0] == edge ? 1 : 0]) : std::nullopt;
        }
        return std::nullopt;
    }

    void findLoops()
    {
        std::vector<Ends> boundary;
        for (const Ends& edge : edges_)
            if (findTriangles(edge).size() == 1)
                boundary.push_back(edge);
        std::vector<std::vector<Ends>> partners;
        for (const Ends& edge : boundary)
        {
            partners.emplace_back();
            for (const LatticePoint p : {edge.first, edge.second})
                if (const auto partner = findPartner(edge, p))
                    partners.back().push_back(*partner);
        }
        for (const auto& group : split(boundary.size(),
                                       [&](size_t a, size_t b) {
                                           return std::find(partners[a].begin(), partners[a].end(),
                                                            boundary[b]) != partners[a].end();
                                       }))
        {
            LoopFacts loop{0, group.size(), true};
            for (const size_t i : group)
            {
                loop.length += length(minus(boundary[i].second, boundary[i].first));
                loop.is_closed &= partners[i].size() == 2;
            }
            facts_.loops.push_back(loop);
        }
        std::sort(facts_.loops.begin(), facts_.loops.end());
    }

    void findShells()
    {
        const auto isJoined = [&](size_t a, size_t b)
        {
            for (const Ends& edge : listEdges(triangles_[a]))
                if (hasEdge(triangles_[b], edge) && findTriangles(edge).size() == 2)
                    return true;
            return false;
        };
        for (const auto& shell : split(triangles_.size(), isJoined))
            facts_.shells.push_back(describe(shell));
        std::sort(facts_.shells.begin(), facts_.shells.end());
    }

    ShellFacts describe(const std::vector<size_t>& shell) const
    {
        ShellFacts facts{.triangles = shell.size(), .is_closed = true, .is_orientable = true};
        const std::set<size_t> members(shell.begin(), shell.end());
        // Relax the sides of all pairs until nothing changes: +1 and -1, 0 is unknown.
        std::vector<int> side(triangles_.size(), 0);
        side[shell[0]] = 1;
        for (bool changes = true; changes;)
        {
            changes = false;
            for (const size_t a : shell)
                for (const size_t b : shell)
                    for (const Ends& edge : listEdges(triangles_[a]))
                    {
                        if (a == b || side[a] == 0 || !hasEdge(triangles_[b], edge) ||
                            findTriangles(edge).size() != 2)
                            continue;
                        const int wanted = isInconsistent(edge) ? -side[a] : side[a];
                        changes |= side[b] == 0;
                        facts.is_orientable &= side[b] == 0 || side[b] == wanted;
                        if (side[b] == 0)
                            side[b] = wanted;
                    }
        }
        const auto others = static_cast<size_t>(std::count(side.begin(), side.end(), -1));
        const int most = 2 * others > shell.size() ? -1 : 1;
        facts.reversed = facts.is_orientable ? std::min(others, shell.size() - others) : 0;

        std::set<Ends> edges;
        std::set<LatticePoint> points;
        for (const size_t t : shell)
        {
            for (const Ends& edge : listEdges(triangles_[t]))
                edges.insert(edge);
            points.insert(triangles_[t].begin(), triangles_[t].end());
        }
        for (const Ends& edge : edges)
        {
            std::vector<size_t> own;
            for (const size_t t : findTriangles(edge))
                if (members.contains(t))
                    own.push_back(t);
            facts.is_closed &= own.size() == 2;
            if (own.size() == 2 && findTriangles(edge).size() > 2 && facts.is_orientable)
            {
                const bool ascends_a = ascends(triangles_[own[0]], edge) == (side[own[0]] > 0);
                const bool ascends_b = ascends(triangles_[own[1]], edge) == (side[own[1]] > 0);
                facts.is_closed &= ascends_a != ascends_b;
            }
        }
        if (!facts.is_closed || !facts.is_orientable)
            return facts;
        int vertices = 0;
        for (const LatticePoint p : points)
            vertices +=
                static_cast<int>(splitFans(p, members, [](size_t count) { return count == 2; }).size());
        const int euler = vertices - static_cast<int>(edges.size()) + static_cast<int>(shell.size());
        facts.genus = (2 - euler) / 2;
        double volume = 0;
        for (const size_t t : shell)
            volume += side[t] * most * dot(triangles_[t][0], cross(triangles_[t][1], triangles_[t][2])) / 6.0;
        facts.volume = volume;
        return facts;
    }

    TopologyFacts facts_;
    std::vector<LatticeTriangle> triangles_;
    std::set<Ends> edges_;
    std::set<LatticePoint> points_;
};

} // namespace

TopologyFacts findTopology(const std::vector<LatticeTriangle>& soup)
{
    return Search(soup).run();
}

} // namespace hearth::reference
