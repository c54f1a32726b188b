// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/side_ways.h"

#include "cook/clusters/core/facet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::clusters
{

namespace
{

// Maximum crossings of a traced path, and maximum triangles of its search.
constexpr size_t kMostSteps = 24;
constexpr size_t kMostFacets = 64;

/// Closest approach of two segments.
struct Meeting
{
    float t; ///< along the segment from a to b
    float far;
};

Meeting meet(Float3 p, Float3 q, Float3 a, Float3 b)
{
    const Float3 pq = q - p, ab = b - a, ap = p - a;
    const float both = dot(pq, ab), inverse_pq2 = 1 / dot(pq, pq), inverse_ab2 = 1 / dot(ab, ab);
    const float t_at_p = dot(ap, ab) * inverse_ab2, t_on_way = both * inverse_ab2;
    // perpendicular to the second segment: differences that stay exact where the two are nearly parallel
    const Float3 across = ap - ab * t_at_p, across_on_way = pq - ab * t_on_way;
    // NaN becomes 0
    const auto unit = [](float x) { return std::min(x > 0 ? x : 0.0f, 1.0f); };
    float s = unit(-dot(across, across_on_way) / dot(across_on_way, across_on_way));
    const float t = unit(t_at_p + t_on_way * s);
    s = unit((both * t - dot(ap, pq)) * inverse_pq2);
    return {t, length(ap + pq * s - ab * t)};
}

} // namespace

SideWays::SideWays(const GroupMesh& group, const Simplified& simplified,
                   std::span<const uint32_t> positions_before, const Surface& after,
                   std::span<const FacetPoint> points)
    : positions_(positions_before),
      places_(group.positions),
      after_(after),
      twins_(sideTwins(after.positions, group.positions.size())),
      images_(group.positions.size()),
      way_of_side_(positions_before.size(), kNoSide)
{
    ways_.reserve(positions_before.size()); // references to paths stay valid while others are traced
    crossings_.reserve(positions_before.size() * 2 / 3);
    findImages(group, simplified, points);
}

void SideWays::findImages(const GroupMesh& group, const Simplified& simplified,
                          std::span<const FacetPoint> points)
{
    for (uint32_t p = 0; p < group.positions.size(); ++p)
    {
        Image& image = images_[p];
        if (const FacetPoint& point = points[p]; point.facet != kNoFacet)
        {
            image.facet = point.facet;
            image.at = {point.v, point.w};
            image.far = std::sqrt(point.distance2);
            const bool at_0 = point.v <= 0 && point.w <= 0, at_1 = point.v >= 1, at_2 = point.w >= 1;
            if (at_0 || at_1 || at_2)
                image.vertex = after_.positions[point.facet * 3 + (at_0 ? 0u : at_1 ? 1u : 2u)];
        }
        else if (simplified.target_of_position[p] == p && !after_.facets_at.of(p).empty())
        {
            image.facet = after_.facets_at.of(p).front();
            image.vertex = p;
        }
    }
}

Float3 SideWays::placeOf(const Image& image) const
{
    if (image.isVertex())
        return after_.place_of_position[image.vertex];
    const Facet& facet = after_.facets[image.facet];
    return facet.a + facet.ab * image.at.v + facet.ac * image.at.w;
}

bool SideWays::holds(uint32_t facet, const Image& image) const
{
    return image.isVertex() ? cornerAt(facet, image.vertex) != kNoSide : facet == image.facet;
}

void SideWays::findWay(uint32_t side)
{
    way_of_side_[side] = static_cast<uint32_t>(ways_.size());
    Way& way = ways_.emplace_back();
    way.side = side;
    way.first = static_cast<uint32_t>(crossings_.size());
    const uint32_t from = positions_[side], to = positions_[nextSide(side)];
    const Image& start = images_[from];
    const Image& end = images_[to];
    if (!start.isThere() || !end.isThere())
        return;
    from_ = places_[from];
    to_ = places_[to];
    way.far = 0;
    if (!findWay(start, end, way))
    {
        crossings_.resize(way.first);
        way.far = -1;
    }
    way.count = static_cast<uint32_t>(crossings_.size()) - way.first;
}

bool SideWays::findWay(const Image& start, const Image& end, Way& way)
{
    if (const uint32_t facet = commonFacet(start, end); facet != kNoFacet)
    {
        way.from = way.to = facet;
        return true;
    }
    if (walk(start, end, way))
        return true;
    crossings_.resize(way.first);
    way.far = 0;
    return crossFewest(start, end, way);
}

uint32_t SideWays::commonFacet(const Image& a, const Image& b) const
{
    if (!b.isVertex())
        return holds(b.facet, a) ? b.facet : kNoFacet;
    if (!a.isVertex())
        return holds(a.facet, b) ? a.facet : kNoFacet;
    for (const uint32_t facet : after_.facets_at.of(a.vertex))
        if (cornerAt(facet, b.vertex) != kNoSide)
            return facet;
    return kNoFacet;
}

void SideWays::cross(uint32_t side, Way& way)
{
    const Meeting meeting = meet(from_, to_, after_.places[side], after_.places[nextSide(side)]);
    crossings_.push_back({{side, twins_[side]}, meeting.t, meeting.far});
    way.far = std::max(way.far, meeting.far);
}

/// Follow a straight line, as seen from above the triangles at its ends.
bool SideWays::walk(const Image& start, const Image& end, Way& way)
{
    const auto makeLine = [&]
    {
        const Facet& f = after_.facets[start.facet];
        const Facet& g = after_.facets[end.facet];
        line_.origin = placeOf(start);
        line_.left =
            hearth::cross(hearth::cross(f.ab, f.ac) + hearth::cross(g.ab, g.ac), placeOf(end) - line_.origin);
    };
    const auto sideOf = [&](uint32_t corner) { return line_.sideOf(after_.places[corner]); };
    const auto leadsToEnd = [&](uint32_t side)
    { return twins_[side] != kNoSide && holds(twins_[side] / 3, end); };

    // find the triangle to start in, and the half-edge to leave it by
    uint32_t exit = kNoSide;
    std::array<float, 3> sides{};
    if (start.isVertex())
    {
        const auto fan = after_.facets_at.of(start.vertex);
        for (const uint32_t facet : fan)
            if (const uint32_t opposite = nextSide(cornerAt(facet, start.vertex)); leadsToEnd(opposite))
                exit = opposite;
        if (exit == kNoSide)
        {
            makeLine();
            for (const uint32_t facet : fan)
            {
                const uint32_t opposite = nextSide(cornerAt(facet, start.vertex));
                if (twins_[opposite] == kNoSide)
                    continue;
                const float at_start = sideOf(opposite), at_end = sideOf(nextSide(opposite));
                if (at_start < 0 && at_end >= 0)
                {
                    exit = opposite;
                    sides[exit % 3] = at_start;
                    sides[(exit + 1) % 3] = at_end;
                    break;
                }
            }
        }
        way.from = exit / 3;
    }
    else
    {
        way.from = start.facet;
        for (uint32_t side = start.facet * 3; side < start.facet * 3 + 3; ++side)
            if (leadsToEnd(side))
                exit = side;
        if (exit == kNoSide)
        {
            makeLine();
            for (uint32_t k = 0; k < 3; ++k)
                sides[k] = sideOf(start.facet * 3 + k);
            for (uint32_t k = 0; k < 3; ++k)
                if (sides[k] < 0 && sides[(k + 1) % 3] >= 0)
                    exit = start.facet * 3 + k;
        }
    }
    for (size_t steps = 0; steps < kMostSteps; ++steps)
    {
        if (exit == kNoSide || twins_[exit] == kNoSide)
            return false;
        cross(exit, way);
        const uint32_t entered = twins_[exit];
        way.to = entered / 3;
        if (holds(way.to, end))
            return true;
        const uint32_t next = nextSide(entered), last = previousSide(entered);
        if (leadsToEnd(next))
            exit = next;
        else if (leadsToEnd(last))
            exit = last;
        else
        {
            const float tip = sideOf(last);
            const float left = sides[(exit + 1) % 3], right = sides[exit % 3];
            // if the tip is to the right, leave between the tip and the left corner
            exit = tip < 0 ? last : next;
            sides[entered % 3] = left;
            sides[next % 3] = right;
            sides[last % 3] = tip;
        }
    }
    return false;
}

/// Find a path over the fewest half-edges, by breadth-first search.
bool SideWays::crossFewest(const Image& start, const Image& end, Way& way)
{
    struct Reached
    {
        uint32_t facet;
        uint32_t side; ///< half-edge that was crossed to get there
        size_t before;
    };
    std::vector<Reached> reached;
    if (start.isVertex())
        for (const uint32_t facet : after_.facets_at.of(start.vertex))
            reached.push_back({facet, kNoSide, 0});
    else
        reached.push_back({start.facet, kNoSide, 0});
    for (size_t i = 0; i < reached.size() && reached.size() < kMostFacets; ++i)
        for (uint32_t side = reached[i].facet * 3; side < reached[i].facet * 3 + 3; ++side)
        {
            if (twins_[side] == kNoSide)
                continue;
            const uint32_t facet = twins_[side] / 3;
            if (std::any_of(reached.begin(), reached.end(),
                            [&](const Reached& r) { return r.facet == facet; }))
                continue;
            reached.push_back({facet, side, i});
            if (!holds(facet, end))
                continue;
            size_t at = reached.size() - 1;
            for (; reached[at].side != kNoSide; at = reached[at].before)
                cross(reached[at].side, way);
            std::reverse(crossings_.begin() + static_cast<ptrdiff_t>(way.first), crossings_.end());
            way.from = reached[at].facet;
            way.to = facet;
            return true;
        }
    return false;
}

std::span<const uint32_t> SideWays::turn(uint32_t vertex, uint32_t from, uint32_t to)
{
    turn_.clear();
    const uint32_t start = cornerAt(from, vertex);
    uint32_t left = start, right = start;
    for (size_t steps = 1; steps < kMostSteps; ++steps)
    {
        if (left != kNoSide)
        {
            left = twins_[previousSide(left)];
            if (left != kNoSide && left / 3 == to)
            {
                for (uint32_t at = start; at / 3 != to; at = twins_[turn_.back()])
                    turn_.push_back(previousSide(at));
                break;
            }
        }
        if (right != kNoSide)
        {
            right = twins_[right];
            right = right == kNoSide ? kNoSide : nextSide(right);
            if (right != kNoSide && right / 3 == to)
            {
                for (uint32_t at = start; at / 3 != to; at = nextSide(twins_[at]))
                    turn_.push_back(at);
                break;
            }
        }
    }
    return turn_;
}

} // namespace hearth::clusters
