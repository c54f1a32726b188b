// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_map.h"

#include "cook/clusters/core/facet.h"

#include <array>
#include <cmath>

namespace hearth::clusters
{

namespace
{

constexpr float kNotMapped = -1;

// A triangle is covered a whole number of times: this tolerance is well above rounding.
constexpr float kRoundingOfLengths = 0.25f;

float distanceTo(const Corners& triangle, Float3 place)
{
    const Facet facet = makeFacet(triangle[0], triangle[1], triangle[2]);
    return std::sqrt(makeBlock({&facet, &facet, &facet, &facet}).distance2(place)[0]);
}

/// Return the point on a half-edge at t from its start (0) to its end (1).
InFacet onSide(uint32_t side, float t)
{
    switch (side % 3)
    {
    case 0:
        return {t, 0};
    case 1:
        return {1 - t, t};
    default:
        return {0, 1 - t};
    }
}

} // namespace

SurfaceMap::SurfaceMap(const GroupMesh& group, const Simplified& simplified,
                       std::span<const uint32_t> positions_before, const Surface& after,
                       std::span<const FacetPoint> points, std::span<const uint8_t> wanted)
    : group_(group),
      positions_(positions_before),
      after_(after),
      twins_(sideTwins(positions_before, group.positions.size())),
      ways_(group, simplified, positions_before, after, points),
      fill_(ways_.twins()),
      far_(wanted.size(), kNotMapped),
      covered_(after.facetCount(), 0)
{
    findWays(wanted);
    for (uint32_t t = 0; t < wanted.size(); ++t)
        if (wanted[t] != 0 && !mapTriangle(t))
            far_[t] = kNotMapped;
    findCovered();
}

/// Trace the half-edges of wanted triangles, each edge once. They are listed first, because a branch on the
/// order of two opposite half-edges would be unpredictable.
void SurfaceMap::findWays(std::span<const uint8_t> wanted)
{
    std::vector<uint32_t> sides(positions_.size());
    size_t count = 0;
    for (uint32_t side = 0; side < positions_.size(); ++side)
    {
        const uint32_t twin = twins_[side];
        const uint32_t other = twin == kNoSide ? side : twin;
        sides[count] = side;
        count += static_cast<uint32_t>(side < twin) & (wanted[side / 3] | wanted[other / 3]);
    }
    for (const uint32_t side : std::span(sides).first(count))
        ways_.findWay(side);
}

/// Map a triangle by following the traced paths of its three half-edges.
bool SurfaceMap::mapTriangle(uint32_t t)
{
    /// Traced path of one half-edge; the path of a half-edge is that of its opposite backwards.
    struct Followed
    {
        const Way* way;
        bool backwards;
        uint32_t from, to;
    };
    std::array<Followed, 3> sides;
    far_[t] = 0;
    for (uint32_t k = 0; k < 3; ++k)
    {
        const uint32_t side = t * 3 + k, twin = twins_[side];
        const bool backwards = twin < side;
        const Way& way = ways_.wayOf(std::min(side, twin));
        if (!way.isFound())
            return false;
        sides[k] = {&way, backwards, backwards ? way.to : way.from, backwards ? way.from : way.to};
        far_[t] = std::max({far_[t], way.far, ways_.imageOf(positions_[side]).far});
    }
    fill_.begin();
    for (uint32_t k = 0; k < 3; ++k)
    {
        follow(*sides[k].way, sides[k].backwards);
        const uint32_t end = sides[k].to, next = sides[(k + 1) % 3].from;
        if (end == next)
            continue;
        if (turn(t, ways_.imageOf(positions_[t * 3 + (k + 1) % 3]), end, next))
            continue;
        fill_.drop();
        return false;
    }
    if (!fill_.close())
        return false;
    for (const uint32_t side : fill_.inner())
    {
        const Corners corners{group_.positions[positions_[t * 3]], group_.positions[positions_[t * 3 + 1]],
                              group_.positions[positions_[t * 3 + 2]]};
        addInner(t, after_.positions[side], distanceTo(corners, after_.places[side]));
    }
    return true;
}

void SurfaceMap::follow(const Way& way, bool backwards)
{
    // forwards or backwards without a branch, which would be unpredictable
    const auto crossings = ways_.crossingsOf(way);
    const size_t back = backwards ? 1 : 0;
    const float start = static_cast<float>(back), direction = 1 - 2 * start;
    size_t at = back * (crossings.size() - 1);
    for (size_t left = crossings.size(); left > 0; --left, at += 1 - 2 * back)
    {
        const Crossing& crossing = crossings[at];
        fill_.cross(crossing.sides[back], crossing.sides[1 - back], start + direction * crossing.t);
    }
}

/// Cross from triangle to triangle around a position.
bool SurfaceMap::turn(uint32_t t, const Image& image, uint32_t from, uint32_t to)
{
    const auto sides = ways_.turn(image.vertex, from, to);
    for (const uint32_t side : sides)
    {
        const uint32_t twin = ways_.twins()[side];
        fill_.cross(side, twin, after_.positions[side] == image.vertex ? 0.0f : 1.0f);
        if (twin / 3 != to)
            passed_.push_back({t, twin / 3, image.far});
    }
    return !sides.empty();
}

void SurfaceMap::addInner(uint32_t triangle, uint32_t position, float far)
{
    inner_.push_back({triangle, position, far});
    far_[triangle] = std::max(far_[triangle], far);
}

std::vector<float> SurfaceMap::sumsOver(std::span<const float> carried) const
{
    std::vector<float> sums(covered_.size(), 0);
    const auto mappedError = [&](uint32_t side)
    { return side != kNoSide && maps(side / 3) ? carried[side / 3] : kNotMapped; };
    const auto give = [&](uint32_t facet, float sum) { sums[facet] = std::max(sums[facet], sum); };
    for (const Way& way : ways_.ways())
    {
        const float most = std::max(mappedError(way.side), mappedError(twins_[way.side]));
        if (most < 0)
            continue;
        give(way.from, most + ways_.imageOf(positions_[way.side]).far);
        for (const Crossing& crossing : ways_.crossingsOf(way))
        {
            give(crossing.leaving() / 3, most + crossing.far);
            give(crossing.entering() / 3, most + crossing.far);
        }
        give(way.to, most + ways_.imageOf(positions_[nextSide(way.side)]).far);
    }
    for (const Passed& passed : passed_)
        if (maps(passed.triangle))
            give(passed.facet, carried[passed.triangle] + passed.far);
    for (const Inner& inner : inner_)
        if (maps(inner.triangle))
            for (const uint32_t facet : after_.facets_at.of(inner.position))
                give(facet, carried[inner.triangle] + inner.far);
    return sums;
}

/// Find the covered triangles. The pieces in a triangle together end at its half-edges, unless the path of a
/// half-edge with only one mapped triangle beside it passes through. Then they cover all of the triangle
/// equally often, as often as they cover any of its half-edges, except those that such a path runs along.
void SurfaceMap::findCovered()
{
    const auto twins = ways_.twins();
    std::vector<float> lengths(twins.size(), 0);
    for (const Chord& chord : fill_.chords())
        lengths[chord.side] += chord.length;
    telling_.resize(twins.size());
    for (uint32_t side = 0; side < twins.size(); ++side)
        telling_[side] =
            twins[side] != kNoSide && std::abs(lengths[side] + lengths[twins[side]] - 1) < kRoundingOfLengths;
    open_.assign(covered_.size(), 0);
    for (uint32_t t = 0; t < far_.size(); ++t)
        if (maps(t))
            for (uint32_t side = t * 3; side < t * 3 + 3; ++side)
                if (const uint32_t twin = twins_[side]; twin == kNoSide || !maps(twin / 3))
                    openAlong(std::min(side, twin));
    for (size_t f = 0; f < covered_.size(); ++f)
        covered_[f] = open_[f] == 0 && (telling_[f * 3] | telling_[f * 3 + 1] | telling_[f * 3 + 2]) != 0;
}

/// Mark the triangles that the path of a half-edge passes through as unknown: only one triangle beside it is
/// mapped.
void SurfaceMap::openAlong(uint32_t side)
{
    const Way& way = ways_.wayOf(side);
    uint32_t facet = way.from;
    InFacet point = ways_.pointIn(facet, ways_.imageOf(positions_[side]));
    for (const Crossing& crossing : ways_.crossingsOf(way))
    {
        openBetween(facet, point, onSide(crossing.leaving(), crossing.t));
        facet = crossing.entering() / 3;
        point = onSide(crossing.entering(), 1 - crossing.t);
    }
    openBetween(facet, point, ways_.pointIn(facet, ways_.imageOf(positions_[nextSide(side)])));
}

void SurfaceMap::openBetween(uint32_t facet, InFacet a, InFacet b)
{
    const auto outside = [](InFacet p) { return p.v + p.w >= 1; };
    const std::array<bool, 3> along{a.w <= 0 && b.w <= 0, outside(a) && outside(b), a.v <= 0 && b.v <= 0};
    for (size_t k = 0; k < 3; ++k)
        if (along[k])
            telling_[facet * 3 + k] = 0;
    if (!along[0] && !along[1] && !along[2])
        open_[facet] = 1;
}

} // namespace hearth::clusters
