// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/convex/hull.h"

#include "formats/base/assert.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <queue>

namespace hearth::proxy
{

namespace
{

/// Vector whose products with differences of lattice points fit: each component has at most 41 bits.
struct Long3
{
    int64_t x, y, z;
};

Long3 subtract(LatticePoint a, LatticePoint b)
{
    return {int64_t{a.x} - b.x, int64_t{a.y} - b.y, int64_t{a.z} - b.z};
}

Long3 crossProduct(Long3 a, Long3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

int64_t dotProduct(Long3 a, Long3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Double3 toDouble(Long3 a)
{
    return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

/// Return the normal of a triangle, twice as long as its area.
Long3 findNormal(LatticePoint a, LatticePoint b, LatticePoint c)
{
    return crossProduct(subtract(b, a), subtract(c, a));
}

[[maybe_unused]] bool isOnLattice(LatticePoint p)
{
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kMaxLatticeCoordinate;
}

/// Grows a hull facet by facet.
class HullBuilder
{
public:
    explicit HullBuilder(std::span<const LatticePoint> points)
        : points_(points), facet_from_point_(points.size(), kInvalidIndex)
    {
    }

    Hull build(size_t max_points)
    {
        const std::optional<std::array<uint32_t, 4>> start = findTetrahedron();
        if (!start)
            return {};
        addTetrahedron(*start);
        for (size_t added = 4; added < max_points && !waiting_.empty();)
        {
            const uint32_t facet = waiting_.top().facet;
            waiting_.pop();
            if (!facets_[facet].is_part)
                continue;
            addPoint(facet);
            ++added;
        }
        return collect();
    }

private:
    struct Facet
    {
        std::array<uint32_t, 3> corners;
        std::array<uint32_t, 3> neighbours{}; ///< [k] across the edge from corner k
        Long3 normal;                         ///< outwards
        std::vector<uint32_t> outside;        ///< points in front of it
        uint32_t farthest = kInvalidIndex;    ///< of these
        bool is_part = true;                  ///< of the hull so far
    };

    /// Facet with points in front of it; the one with the farthest point comes first.
    struct Waiting
    {
        double distance;
        uint32_t facet;
        bool operator<(const Waiting& other) const
        {
            return distance != other.distance ? distance < other.distance : facet > other.facet;
        }
    };

    /// Edge between a facet that a new point sees and one that it does not see.
    struct HorizonEdge
    {
        uint32_t from, to;
        uint32_t beyond; ///< the facet that is not seen
    };

    /// Return the height of a point over a facet times the length of the facet's normal.
    int64_t height(const Facet& facet, uint32_t point) const
    {
        return dotProduct(facet.normal, subtract(points_[point], points_[facet.corners[0]]));
    }

    /// Return the index with the greatest value.
    template <typename Value>
    uint32_t findGreatest(const Value& value) const
    {
        uint32_t greatest = 0;
        for (uint32_t i = 1; i < points_.size(); ++i)
            if (value(i) > value(greatest))
                greatest = i;
        return greatest;
    }

    /// Return four points with volume between them, far apart; nothing if there are none.
    std::optional<std::array<uint32_t, 4>> findTetrahedron() const
    {
        if (points_.empty())
            return std::nullopt;
        const auto fromFirst = [&](uint32_t first, uint32_t i)
        { return subtract(points_[i], points_[first]); };
        const auto a = static_cast<uint32_t>(std::ranges::min_element(points_) - points_.begin());
        const uint32_t b = findGreatest(
            [&](uint32_t i)
            {
                const Long3 v = fromFirst(a, i);
                return dotProduct(v, v);
            });
        const auto normalTo = [&](uint32_t i) { return crossProduct(fromFirst(a, b), fromFirst(a, i)); };
        const uint32_t c = findGreatest(
            [&](uint32_t i)
            {
                const Double3 v = toDouble(normalTo(i));
                return dot(v, v);
            });
        const Long3 normal = normalTo(c);
        const uint32_t d =
            findGreatest([&](uint32_t i) { return std::abs(dotProduct(normal, fromFirst(a, i))); });
        const int64_t volume = dotProduct(normal, fromFirst(a, d));
        if (volume == 0)
            return std::nullopt;
        return volume < 0 ? std::array{a, b, c, d} : std::array{a, c, b, d};
    }

    /// Begin with a tetrahedron whose last corner is behind the triangle of the others.
    void addTetrahedron(const std::array<uint32_t, 4>& corners)
    {
        const auto [a, b, c, d] = corners;
        addFacet({a, b, c}, {1, 2, 3});
        addFacet({b, a, d}, {0, 3, 2});
        addFacet({c, b, d}, {0, 1, 3});
        addFacet({a, c, d}, {0, 2, 1});
        for (uint32_t i = 0; i < points_.size(); ++i)
            assign(i, 0);
        for (uint32_t facet = 0; facet < facets_.size(); ++facet)
            enqueue(facet);
    }

    uint32_t addFacet(std::array<uint32_t, 3> corners, std::array<uint32_t, 3> neighbours)
    {
        Facet facet{.corners = corners,
                    .neighbours = neighbours,
                    .normal = findNormal(points_[corners[0]], points_[corners[1]], points_[corners[2]])};
        facets_.push_back(std::move(facet));
        return static_cast<uint32_t>(facets_.size() - 1);
    }

    /// Give a point to the first facet from `first` on that it is in front of; to none if the hull holds it.
    void assign(uint32_t point, uint32_t first)
    {
        for (uint32_t f = first; f < facets_.size(); ++f)
        {
            Facet& facet = facets_[f];
            const int64_t h = height(facet, point);
            if (h <= 0)
                continue;
            if (facet.farthest == kInvalidIndex || h > height(facet, facet.farthest))
                facet.farthest = point;
            facet.outside.push_back(point);
            return;
        }
    }

    void enqueue(uint32_t facet)
    {
        const Facet& f = facets_[facet];
        if (f.farthest == kInvalidIndex)
            return;
        const auto h = static_cast<double>(height(f, f.farthest));
        waiting_.push({h / length(toDouble(f.normal)), facet});
    }

    /// Remove the facets that a point sees from the hull, and return the edges around them.
    std::vector<HorizonEdge> removeSeen(uint32_t point, uint32_t facet, std::vector<uint32_t>& seen)
    {
        std::vector<HorizonEdge> horizon;
        seen.push_back(facet);
        facets_[facet].is_part = false;
        for (size_t i = 0; i < seen.size(); ++i)
            for (uint32_t k = 0; k < 3; ++k)
            {
                const Facet& from = facets_[seen[i]];
                Facet& next = facets_[from.neighbours[k]];
                if (!next.is_part)
                    continue;
                if (height(next, point) > 0)
                {
                    next.is_part = false;
                    seen.push_back(from.neighbours[k]);
                }
                else
                    horizon.push_back({from.corners[k], from.corners[(k + 1) % 3], from.neighbours[k]});
            }
        return horizon;
    }

    /// Let the facet across the edge that starts at `from` know its new neighbour.
    void join(uint32_t facet, uint32_t from, uint32_t neighbour)
    {
        Facet& f = facets_[facet];
        for (uint32_t k = 0; k < 3; ++k)
            if (f.corners[k] == from)
                f.neighbours[k] = neighbour;
    }

    /// Add the farthest point in front of a facet: a cone of facets from the horizon takes the place of those
    /// it sees.
    void addPoint(uint32_t facet)
    {
        const uint32_t apex = facets_[facet].farthest;
        std::vector<uint32_t> seen;
        const std::vector<HorizonEdge> horizon = removeSeen(apex, facet, seen);
        const auto first = static_cast<uint32_t>(facets_.size());
        for (const HorizonEdge& edge : horizon)
        {
            const uint32_t added = addFacet({edge.from, edge.to, apex}, {edge.beyond, 0, 0});
            join(edge.beyond, edge.to, added);
            facet_from_point_[edge.from] = added;
        }
        for (uint32_t f = first; f < facets_.size(); ++f)
        {
            const uint32_t next = facet_from_point_[facets_[f].corners[1]];
            facets_[f].neighbours[1] = next;
            facets_[next].neighbours[2] = f;
        }
        for (const uint32_t f : seen)
            for (const uint32_t point : std::exchange(facets_[f].outside, {}))
                if (point != apex)
                    assign(point, first);
        for (uint32_t f = first; f < facets_.size(); ++f)
            enqueue(f);
    }

    Hull collect() const
    {
        Hull hull;
        std::vector<uint32_t> number(points_.size(), kInvalidIndex);
        for (const Facet& facet : facets_)
            if (facet.is_part)
            {
                std::array<uint32_t, 3>& triangle = hull.triangles.emplace_back();
                for (size_t k = 0; k < 3; ++k)
                {
                    uint32_t& at = number[facet.corners[k]];
                    if (at == kInvalidIndex)
                    {
                        at = static_cast<uint32_t>(hull.points.size());
                        hull.points.push_back(points_[facet.corners[k]]);
                    }
                    triangle[k] = at;
                }
            }
        return hull;
    }

    std::span<const LatticePoint> points_;
    std::vector<Facet> facets_;
    std::priority_queue<Waiting> waiting_;
    std::vector<uint32_t> facet_from_point_; ///< the newest facet whose first corner is the point
};

} // namespace

Hull makeHull(std::span<const LatticePoint> points, size_t max_points)
{
    HEARTH_RUNTIME_ASSERT(std::ranges::all_of(points, isOnLattice));
    return HullBuilder(points).build(max_points);
}

bool holds(const Hull& hull, LatticePoint point)
{
    return std::ranges::all_of(hull.triangles,
                               [&](const std::array<uint32_t, 3>& t)
                               {
                                   const LatticePoint a = hull.points[t[0]];
                                   const Long3 normal = findNormal(a, hull.points[t[1]], hull.points[t[2]]);
                                   return dotProduct(normal, subtract(point, a)) <= 0;
                               });
}

double findVolume(const Hull& hull)
{
    double volume = 0;
    for (const auto& [a, b, c] : hull.triangles)
    {
        const LatticePoint apex = hull.points[0];
        const Long3 normal = findNormal(hull.points[a], hull.points[b], hull.points[c]);
        volume += static_cast<double>(dotProduct(normal, subtract(hull.points[a], apex))) / 6;
    }
    return volume;
}

double findArea(const Hull& hull)
{
    double area = 0;
    for (const auto& [a, b, c] : hull.triangles)
        area += length(toDouble(findNormal(hull.points[a], hull.points[b], hull.points[c]))) / 2;
    return area;
}

} // namespace hearth::proxy
