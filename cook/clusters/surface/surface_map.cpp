// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_map.h"

#include "cook/clusters/core/triangle_block.h"

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
BarycentricPoint pointOnHalfEdge(uint32_t half_edge, float t)
{
    switch (half_edge % 3)
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
                       std::span<const uint32_t> positions_before, const Surface& after,
                       std::span<const TrianglePoint> points, std::span<const uint8_t> wanted)
    : group_(group),
      positions_(positions_before),
      after_(after),
      opposites_(findOppositeHalfEdges(positions_before, group.positions.size())),
      tracer_(group, simplified, positions_before, after, points),
      fill_(tracer_.opposites()),
      distances_(wanted.size(), kNotMapped),
      covered_(after.triangleCount(), 0)
{
    tracePaths(wanted);
    for (uint32_t t = 0; t < wanted.size(); ++t)
        if (wanted[t] != 0 && !mapTriangle(t))
            distances_[t] = kNotMapped;
    findCovered();
}

/// Trace the half-edges of wanted triangles, each edge once. They are listed first, because a branch on the
/// order of two opposite half-edges would be unpredictable.
void SurfaceMap::tracePaths(std::span<const uint8_t> wanted)
{
    std::vector<uint32_t> half_edges(positions_.size());
    size_t count = 0;
    for (uint32_t half_edge = 0; half_edge < positions_.size(); ++half_edge)
    {
        const uint32_t opposite = opposites_[half_edge];
        const uint32_t other = opposite == kInvalidIndex ? half_edge : opposite;
        half_edges[count] = half_edge;
        count += static_cast<uint32_t>(half_edge < opposite) & (wanted[half_edge / 3] | wanted[other / 3]);
    }
    for (const uint32_t half_edge : std::span(half_edges).first(count))
        tracer_.tracePath(half_edge);
}

/// Map a triangle by following the traced paths of its three half-edges.
bool SurfaceMap::mapTriangle(uint32_t t)
{
    /// Traced path of one half-edge; the path of a half-edge is that of its opposite backwards.
    struct FollowedPath
    {
        const TracedPath* path;
        bool backwards;
        uint32_t from, to;
    };
    std::array<FollowedPath, 3> half_edges;
    distances_[t] = 0;
    for (uint32_t k = 0; k < 3; ++k)
    {
        const uint32_t half_edge = t * 3 + k, opposite = opposites_[half_edge];
        const bool backwards = opposite < half_edge;
        const TracedPath& path = tracer_.tracedPath(std::min(half_edge, opposite));
        if (!path.isFound())
            return false;
        half_edges[k] = {&path, backwards, backwards ? path.to : path.from, backwards ? path.from : path.to};
        distances_[t] =
            std::max({distances_[t], path.distance, tracer_.mappedPoint(positions_[half_edge]).distance});
    }
    fill_.begin();
    for (uint32_t k = 0; k < 3; ++k)
    {
        follow(*half_edges[k].path, half_edges[k].backwards);
        const uint32_t end = half_edges[k].to, next = half_edges[(k + 1) % 3].from;
        if (end == next)
            continue;
        if (turn(t, tracer_.mappedPoint(positions_[t * 3 + (k + 1) % 3]), end, next))
            continue;
        fill_.drop();
        return false;
    }
    if (!fill_.close())
        return false;
    for (const uint32_t half_edge : fill_.inner())
    {
        const Corners corners{group_.positions[positions_[t * 3]], group_.positions[positions_[t * 3 + 1]],
                              group_.positions[positions_[t * 3 + 2]]};
        addInner(t, after_.position_ids[half_edge], distanceTo(corners, after_.corner_positions[half_edge]));
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
bool SurfaceMap::turn(uint32_t t, const MappedPoint& mapped, uint32_t from, uint32_t to)
{
    const auto half_edges = tracer_.turn(mapped.vertex, from, to);
    for (const uint32_t half_edge : half_edges)
    {
        const uint32_t opposite = tracer_.opposites()[half_edge];
        fill_.cross(half_edge, opposite, after_.position_ids[half_edge] == mapped.vertex ? 0.0f : 1.0f);
        if (opposite / 3 != to)
            passed_.push_back({t, opposite / 3, mapped.distance});
    }
    return !half_edges.empty();
}

void SurfaceMap::addInner(uint32_t triangle, uint32_t position, float distance)
{
    inner_.push_back({triangle, position, distance});
    distances_[triangle] = std::max(distances_[triangle], distance);
}

std::vector<float> SurfaceMap::maxSums(std::span<const float> carried) const
{
    std::vector<float> sums(covered_.size(), 0);
    const auto mappedError = [&](uint32_t half_edge)
    { return half_edge != kInvalidIndex && maps(half_edge / 3) ? carried[half_edge / 3] : kNotMapped; };
    const auto give = [&](uint32_t new_triangle, float sum)
    { sums[new_triangle] = std::max(sums[new_triangle], sum); };
    for (const TracedPath& path : tracer_.paths())
    {
        const float most = std::max(mappedError(path.half_edge), mappedError(opposites_[path.half_edge]));
        if (most < 0)
            continue;
        give(path.from, most + tracer_.mappedPoint(positions_[path.half_edge]).distance);
        for (const Crossing& crossing : tracer_.crossings(path))
        {
            give(crossing.leaving() / 3, most + crossing.distance);
            give(crossing.entering() / 3, most + crossing.distance);
        }
        give(path.to, most + tracer_.mappedPoint(positions_[nextHalfEdge(path.half_edge)]).distance);
    }
    for (const PassedTriangle& passed : passed_)
        if (maps(passed.triangle))
            give(passed.new_triangle, carried[passed.triangle] + passed.distance);
    for (const InnerPoint& inner : inner_)
        if (maps(inner.triangle))
            for (const uint32_t new_triangle : after_.triangles_at.list(inner.position))
                give(new_triangle, carried[inner.triangle] + inner.distance);
    return sums;
}

/// Find the covered triangles. The pieces in a triangle together end at its half-edges, unless the path of a
/// half-edge with only one mapped triangle beside it passes through. Then they cover all of the triangle
/// equally often, as often as they cover any of its half-edges, except those that such a path runs along.
void SurfaceMap::findCovered()
{
    const auto opposites = tracer_.opposites();
    std::vector<float> lengths(opposites.size(), 0);
    for (const Chord& chord : fill_.chords())
        lengths[chord.half_edge] += chord.length;
    decides_.resize(opposites.size());
    for (uint32_t half_edge = 0; half_edge < opposites.size(); ++half_edge)
        decides_[half_edge] =
            opposites[half_edge] != kInvalidIndex &&
            std::abs(lengths[half_edge] + lengths[opposites[half_edge]] - 1) < kRoundingOfLengths;
    open_.assign(covered_.size(), 0);
    for (uint32_t t = 0; t < distances_.size(); ++t)
        if (maps(t))
            for (uint32_t half_edge = t * 3; half_edge < t * 3 + 3; ++half_edge)
                if (const uint32_t opposite = opposites_[half_edge];
                    opposite == kInvalidIndex || !maps(opposite / 3))
                    markOpenAlong(std::min(half_edge, opposite));
    for (size_t f = 0; f < covered_.size(); ++f)
        covered_[f] = open_[f] == 0 && (decides_[f * 3] | decides_[f * 3 + 1] | decides_[f * 3 + 2]) != 0;
}

/// Mark the triangles that the path of a half-edge passes through as unknown: only one triangle beside it is
/// mapped.
void SurfaceMap::markOpenAlong(uint32_t half_edge)
{
    const TracedPath& path = tracer_.tracedPath(half_edge);
    uint32_t new_triangle = path.from;
    BarycentricPoint point = tracer_.pointIn(new_triangle, tracer_.mappedPoint(positions_[half_edge]));
    for (const Crossing& crossing : tracer_.crossings(path))
    {
        markOpenBetween(new_triangle, point, pointOnHalfEdge(crossing.leaving(), crossing.t));
        new_triangle = crossing.entering() / 3;
        point = pointOnHalfEdge(crossing.entering(), 1 - crossing.t);
    }
    markOpenBetween(new_triangle, point,
                    tracer_.pointIn(new_triangle, tracer_.mappedPoint(positions_[nextHalfEdge(half_edge)])));
}

void SurfaceMap::markOpenBetween(uint32_t new_triangle, BarycentricPoint a, BarycentricPoint b)
{
    const auto outside = [](BarycentricPoint p) { return p.v + p.w >= 1; };
    const std::array<bool, 3> along{a.w <= 0 && b.w <= 0, outside(a) && outside(b), a.v <= 0 && b.v <= 0};
    for (size_t k = 0; k < 3; ++k)
        if (along[k])
            decides_[new_triangle * 3 + k] = 0;
    if (!along[0] && !along[1] && !along[2])
        open_[new_triangle] = 1;
}

} // namespace hearth::clusters
