// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_map.h"

#include "cook/clusters/core/triangle_block.h"
#include "formats/base/assert.h"

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
    const DistanceTriangle new_triangle = makeDistanceTriangle(triangle[0], triangle[1], triangle[2]);
    return std::sqrt(
        makeTriangleBlock({&new_triangle, &new_triangle, &new_triangle, &new_triangle}).distance2(place)[0]);
}

/// Return the point on a half-edge at t from its start (0) to its end (1).
BarycentricPoint pointOnHalfEdge(HalfEdgeId half_edge, float t)
{
    switch (cornerNumber(half_edge))
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

SurfaceMap::SurfaceMap(const GroupMesh& group, const SimplifiedGroup& simplified,
                       CornerSpan<const PositionId> positions_before, const Surface& after,
                       IdSpan<PositionId, const TrianglePoint> points,
                       IdSpan<TriangleId, const uint8_t> wanted)
    : group_(group),
      positions_(positions_before),
      after_(after),
      opposites_(findOppositeHalfEdges(positions_before, group.positions.size())),
      tracer_(group, simplified, positions_before, after, points),
      fill_(tracer_.opposites()),
      distances_(wanted.size(), kNotMapped),
      covered_(after.triangleCount(), 0)
{
    HEARTH_ASSERT(wanted.size() == positions_before.triangleCount());
    HEARTH_ASSERT(after.triangleCount() == simplified.triangleCount());
    tracePaths(wanted);
    for (const TriangleId triangle : wanted.ids())
        if (wanted[triangle] != 0 && !mapTriangle(triangle))
            distances_[triangle] = kNotMapped;
    findCovered();
}

/// Trace the half-edges of wanted triangles, each edge once. They are listed first, because a branch on the
/// order of two opposite half-edges would be unpredictable.
void SurfaceMap::tracePaths(IdSpan<TriangleId, const uint8_t> wanted)
{
    std::vector<HalfEdgeId> half_edges(positions_.size());
    size_t count = 0;
    for (const HalfEdgeId half_edge : opposites_.ids())
    {
        const HalfEdgeId opposite = opposites_[half_edge];
        const HalfEdgeId other = opposite == kInvalid ? half_edge : opposite;
        half_edges[count] = half_edge;
        count += static_cast<uint32_t>(half_edge < opposite) &
                 (wanted[cornerTriangle(half_edge)] | wanted[cornerTriangle(other)]);
    }
    for (const HalfEdgeId half_edge : std::span(half_edges).first(count))
        tracer_.tracePath(half_edge);
}

/// Map a triangle by following the traced paths of its three half-edges.
bool SurfaceMap::mapTriangle(TriangleId triangle)
{
    /// Traced path of one half-edge; the path of a half-edge is that of its opposite backwards.
    struct FollowedPath
    {
        const TracedPath* path;
        bool backwards;
        TriangleId from, to;
    };
    std::array<FollowedPath, 3> half_edges;
    distances_[triangle] = 0;
    for (uint32_t k = 0; k < 3; ++k)
    {
        const HalfEdgeId half_edge = makeCorner(triangle, k), opposite = opposites_[half_edge];
        const bool backwards = opposite < half_edge;
        const TracedPath& path = tracer_.tracedPath(std::min(half_edge, opposite));
        if (!path.isFound())
            return false;
        half_edges[k] = {&path, backwards, backwards ? path.to : path.from, backwards ? path.from : path.to};
        distances_[triangle] = std::max(
            {distances_[triangle], path.distance, tracer_.mappedPoint(positions_[half_edge]).distance});
    }
    fill_.begin();
    for (uint32_t k = 0; k < 3; ++k)
    {
        follow(*half_edges[k].path, half_edges[k].backwards);
        const TriangleId end = half_edges[k].to, next = half_edges[(k + 1) % 3].from;
        if (end == next)
            continue;
        const PositionId position = positions_[makeCorner(triangle, (k + 1) % 3)];
        if (turn(triangle, tracer_.mappedPoint(position), end, next))
            continue;
        fill_.drop();
        return false;
    }
    if (!fill_.close())
        return false;
    for (const HalfEdgeId half_edge : fill_.inner())
    {
        const auto [a, b, c] = positions_.triangle(triangle);
        const Corners corners{group_.positions[a], group_.positions[b], group_.positions[c]};
        addInner(triangle, after_.position_ids[half_edge],
                 distanceTo(corners, after_.corner_positions[half_edge]));
    }
    return true;
}

void SurfaceMap::follow(const TracedPath& path, bool backwards)
{
    // forwards or backwards without a branch, which would be unpredictable
    const auto crossings = tracer_.crossings(path);
    const size_t back = backwards ? 1 : 0;
    const float start = static_cast<float>(back), direction = 1 - 2 * start;
    size_t at = back * (crossings.size() - 1);
    for (size_t left = crossings.size(); left > 0; --left, at += 1 - 2 * back)
    {
        const Crossing& crossing = crossings[at];
        fill_.cross(crossing.half_edges[back], crossing.half_edges[1 - back], start + direction * crossing.t);
    }
}

/// Cross from triangle to triangle around a position.
bool SurfaceMap::turn(TriangleId triangle, const MappedPoint& mapped, TriangleId from, TriangleId to)
{
    const auto half_edges = tracer_.turn(mapped.vertex, from, to);
    for (const HalfEdgeId half_edge : half_edges)
    {
        const HalfEdgeId opposite = tracer_.opposites()[half_edge];
        fill_.cross(half_edge, opposite, after_.position_ids[half_edge] == mapped.vertex ? 0.0f : 1.0f);
        if (const TriangleId passed = cornerTriangle(opposite); passed != to)
            passed_.push_back({triangle, passed, mapped.distance});
    }
    return !half_edges.empty();
}

void SurfaceMap::addInner(TriangleId triangle, PositionId position, float distance)
{
    inner_.push_back({triangle, position, distance});
    distances_[triangle] = std::max(distances_[triangle], distance);
}

IdVector<TriangleId, float> SurfaceMap::maxSums(IdSpan<TriangleId, const float> carried) const
{
    HEARTH_ASSERT(carried.size() == distances_.size());
    IdVector<TriangleId, float> sums(covered_.size(), 0);
    const auto mappedError = [&](HalfEdgeId half_edge)
    {
        const bool mapped = half_edge != kInvalid && maps(cornerTriangle(half_edge));
        return mapped ? carried[cornerTriangle(half_edge)] : kNotMapped;
    };
    const auto give = [&](TriangleId new_triangle, float sum)
    { sums[new_triangle] = std::max(sums[new_triangle], sum); };
    for (const TracedPath& path : tracer_.paths())
    {
        const float most = std::max(mappedError(path.half_edge), mappedError(opposites_[path.half_edge]));
        if (most < 0)
            continue;
        give(path.from, most + tracer_.mappedPoint(positions_[path.half_edge]).distance);
        for (const Crossing& crossing : tracer_.crossings(path))
        {
            give(cornerTriangle(crossing.leaving()), most + crossing.distance);
            give(cornerTriangle(crossing.entering()), most + crossing.distance);
        }
        give(path.to, most + tracer_.mappedPoint(positions_[nextHalfEdge(path.half_edge)]).distance);
    }
    for (const PassedTriangle& passed : passed_)
        if (maps(passed.triangle))
            give(passed.new_triangle, carried[passed.triangle] + passed.distance);
    for (const InnerPoint& inner : inner_)
        if (maps(inner.triangle))
            for (const TriangleId new_triangle : after_.triangles_at.list(inner.position))
                give(new_triangle, carried[inner.triangle] + inner.distance);
    return sums;
}

/// Find the covered triangles. The pieces in a triangle together end at its half-edges, unless the path of a
/// half-edge with only one mapped triangle beside it passes through. Then they cover all of the triangle
/// equally often, as often as they cover any of its half-edges, except those that such a path runs along.
void SurfaceMap::findCovered()
{
    const auto opposites = tracer_.opposites();
    IdVector<HalfEdgeId, float> lengths(opposites.size(), 0);
    for (const Chord& chord : fill_.chords())
        lengths[chord.half_edge] += chord.length;
    decides_.resize(opposites.size());
    for (const HalfEdgeId half_edge : opposites.ids())
        decides_[half_edge] =
            opposites[half_edge] != kInvalid &&
            std::abs(lengths[half_edge] + lengths[opposites[half_edge]] - 1) < kRoundingOfLengths;
    open_.assign(covered_.size(), 0);
    for (const TriangleId triangle : distances_.ids())
        if (maps(triangle))
            for (const HalfEdgeId half_edge : makeCorners(triangle))
                if (const HalfEdgeId opposite = opposites_[half_edge];
                    opposite == kInvalid || !maps(cornerTriangle(opposite)))
                    markOpenAlong(std::min(half_edge, opposite));
    for (const TriangleId new_triangle : covered_.ids())
    {
        const auto [a, b, c] = decides_.triangle(new_triangle);
        covered_[new_triangle] = open_[new_triangle] == 0 && (a | b | c) != 0;
    }
}

/// Mark the triangles that the path of a half-edge passes through as unknown: only one triangle beside it is
/// mapped.
void SurfaceMap::markOpenAlong(HalfEdgeId half_edge)
{
    const TracedPath& path = tracer_.tracedPath(half_edge);
    TriangleId new_triangle = path.from;
    BarycentricPoint point = tracer_.pointIn(new_triangle, tracer_.mappedPoint(positions_[half_edge]));
    for (const Crossing& crossing : tracer_.crossings(path))
    {
        markOpenBetween(new_triangle, point, pointOnHalfEdge(crossing.leaving(), crossing.t));
        new_triangle = cornerTriangle(crossing.entering());
        point = pointOnHalfEdge(crossing.entering(), 1 - crossing.t);
    }
    markOpenBetween(new_triangle, point,
                    tracer_.pointIn(new_triangle, tracer_.mappedPoint(positions_[nextHalfEdge(half_edge)])));
}

void SurfaceMap::markOpenBetween(TriangleId new_triangle, BarycentricPoint a, BarycentricPoint b)
{
    const auto outside = [](BarycentricPoint p) { return p.v + p.w >= 1; };
    const std::array<bool, 3> along{a.w <= 0 && b.w <= 0, outside(a) && outside(b), a.v <= 0 && b.v <= 0};
    for (uint32_t k = 0; k < 3; ++k)
        if (along[k])
            decides_[makeCorner(new_triangle, k)] = 0;
    if (!along[0] && !along[1] && !along[2])
        open_[new_triangle] = 1;
}

} // namespace hearth::clusters
