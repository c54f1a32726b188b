// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/edge_path_tracer.h"

#include "cook/clusters/core/triangle_block.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::clusters
{

namespace
{

// Maximum crossings of a traced path, and maximum triangles of its search.
constexpr size_t kMaxSteps = 24;
constexpr size_t kMaxTriangles = 64;

/// Closest approach of two segments.
struct ClosestApproach
{
    float t; ///< along the segment from a to b
    float distance;
};

ClosestApproach closestApproach(Float3 p, Float3 q, Float3 a, Float3 b)
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

EdgePathTracer::EdgePathTracer(const GroupMesh& group, const SimplifiedGroup& simplified,
                               CornerSpan<const PositionId> positions_before, const Surface& after,
                               IdSpan<PositionId, const TrianglePoint> points)
    : position_ids_(positions_before),
      local_positions_(group.positions),
      after_(after),
      opposites_(findOppositeHalfEdges(after.position_ids, group.positions.size())),
      mapped_points_(group.positions.size()),
      path_of_half_edge_(positions_before.size(), kInvalidIndex)
{
    HEARTH_ASSERT(points.size() == group.positions.size());
    HEARTH_ASSERT(simplified.target_of_position.size() == group.positions.size());
    paths_.reserve(positions_before.size()); // references to paths stay valid while others are traced
    crossings_.reserve(positions_before.size() * 2 / 3);
    findMappedPoints(group, simplified, points);
}

void EdgePathTracer::findMappedPoints(const GroupMesh& group, const SimplifiedGroup& simplified,
                                      IdSpan<PositionId, const TrianglePoint> points)
{
    for (const PositionId position : group.positions.ids())
    {
        MappedPoint& mapped = mapped_points_[position];
        if (const TrianglePoint& point = points[position]; point.triangle != kInvalid)
        {
            mapped.triangle = point.triangle;
            mapped.at = {point.v, point.w};
            mapped.distance = std::sqrt(point.distance2);
            const bool at_0 = point.v <= 0 && point.w <= 0, at_1 = point.v >= 1, at_2 = point.w >= 1;
            if (at_0 || at_1 || at_2)
                mapped.vertex = after_.position_ids[makeCorner(point.triangle, at_0 ? 0 : at_1 ? 1 : 2)];
        }
        else if (simplified.target_of_position[position] == position &&
                 !after_.triangles_at.list(position).empty())
        {
            mapped.triangle = after_.triangles_at.list(position).front();
            mapped.vertex = position;
        }
    }
}

Float3 EdgePathTracer::mappedPosition(const MappedPoint& mapped) const
{
    if (mapped.isVertex())
        return after_.position_of_id[mapped.vertex];
    const DistanceTriangle& triangle = after_.triangles[mapped.triangle];
    return triangle.a + triangle.ab * mapped.at.v + triangle.ac * mapped.at.w;
}

bool EdgePathTracer::contains(TriangleId triangle, const MappedPoint& mapped) const
{
    return mapped.isVertex() ? cornerAt(triangle, mapped.vertex) != kInvalid : triangle == mapped.triangle;
}

void EdgePathTracer::tracePath(HalfEdgeId half_edge)
{
    HEARTH_RUNTIME_ASSERT(path_of_half_edge_[half_edge] == kInvalidIndex);
    path_of_half_edge_[half_edge] = static_cast<uint32_t>(paths_.size());
    TracedPath& path = paths_.emplace_back();
    path.half_edge = half_edge;
    path.first = static_cast<uint32_t>(crossings_.size());
    const PositionId from = position_ids_[half_edge], to = position_ids_[nextHalfEdge(half_edge)];
    const MappedPoint& start = mapped_points_[from];
    const MappedPoint& end = mapped_points_[to];
    if (!start.isValid() || !end.isValid())
        return;
    from_ = local_positions_[from];
    to_ = local_positions_[to];
    path.distance = 0;
    if (!tracePath(start, end, path))
    {
        crossings_.resize(path.first);
        path.distance = -1;
    }
    path.count = static_cast<uint32_t>(crossings_.size()) - path.first;
    HEARTH_RUNTIME_ASSERT(!path.isFound() || path.count > 0 || path.from == path.to);
}

bool EdgePathTracer::tracePath(const MappedPoint& start, const MappedPoint& end, TracedPath& path)
{
    if (const TriangleId triangle = commonTriangle(start, end); triangle != kInvalid)
    {
        path.from = path.to = triangle;
        return true;
    }
    if (traceStraight(start, end, path))
        return true;
    crossings_.resize(path.first);
    path.distance = 0;
    return traceShortest(start, end, path);
}

TriangleId EdgePathTracer::commonTriangle(const MappedPoint& a, const MappedPoint& b) const
{
    if (!b.isVertex())
        return contains(b.triangle, a) ? b.triangle : kInvalid;
    if (!a.isVertex())
        return contains(a.triangle, b) ? a.triangle : kInvalid;
    for (const TriangleId triangle : after_.triangles_at.list(a.vertex))
        if (cornerAt(triangle, b.vertex) != kInvalid)
            return triangle;
    return kInvalid;
}

void EdgePathTracer::cross(HalfEdgeId half_edge, TracedPath& path)
{
    HEARTH_RUNTIME_ASSERT(opposites_[half_edge] != kInvalid);
    const ClosestApproach closest = closestApproach(from_, to_, after_.corner_positions[half_edge],
                                                    after_.corner_positions[nextHalfEdge(half_edge)]);
    crossings_.push_back({{half_edge, opposites_[half_edge]}, closest.t, closest.distance});
    path.distance = std::max(path.distance, closest.distance);
}

/// Follow a straight line, as seen from above the triangles at its ends.
bool EdgePathTracer::traceStraight(const MappedPoint& start, const MappedPoint& end, TracedPath& path)
{
    const auto makeLine = [&]
    {
        const DistanceTriangle& f = after_.triangles[start.triangle];
        const DistanceTriangle& g = after_.triangles[end.triangle];
        line_.origin = mappedPosition(start);
        line_.left = hearth::cross(hearth::cross(f.ab, f.ac) + hearth::cross(g.ab, g.ac),
                                   mappedPosition(end) - line_.origin);
    };
    const auto signedArea = [&](CornerId corner)
    { return line_.signedArea(after_.corner_positions[corner]); };
    const auto leadsToEnd = [&](HalfEdgeId half_edge)
    { return opposites_[half_edge] != kInvalid && contains(cornerTriangle(opposites_[half_edge]), end); };

    // find the triangle to start in, and the half-edge to leave it by
    HalfEdgeId exit = kInvalid;
    std::array<float, 3> signed_areas{};
    if (start.isVertex())
    {
        const auto fan = after_.triangles_at.list(start.vertex);
        for (const TriangleId triangle : fan)
            if (const HalfEdgeId opposite = nextHalfEdge(cornerAt(triangle, start.vertex));
                leadsToEnd(opposite))
                exit = opposite;
        if (exit == kInvalid)
        {
            makeLine();
            for (const TriangleId triangle : fan)
            {
                const HalfEdgeId opposite = nextHalfEdge(cornerAt(triangle, start.vertex));
                if (opposites_[opposite] == kInvalid)
                    continue;
                const float at_start = signedArea(opposite), at_end = signedArea(nextHalfEdge(opposite));
                if (at_start < 0 && at_end >= 0)
                {
                    exit = opposite;
                    signed_areas[cornerNumber(exit)] = at_start;
                    signed_areas[cornerNumber(nextHalfEdge(exit))] = at_end;
                    break;
                }
            }
        }
        path.from = cornerTriangle(exit);
    }
    else
    {
        path.from = start.triangle;
        for (const HalfEdgeId half_edge : makeCorners(start.triangle))
            if (leadsToEnd(half_edge))
                exit = half_edge;
        if (exit == kInvalid)
        {
            makeLine();
            for (uint32_t k = 0; k < 3; ++k)
                signed_areas[k] = signedArea(makeCorner(start.triangle, k));
            for (uint32_t k = 0; k < 3; ++k)
                if (signed_areas[k] < 0 && signed_areas[(k + 1) % 3] >= 0)
                    exit = makeCorner(start.triangle, k);
        }
    }
    for (size_t steps = 0; steps < kMaxSteps; ++steps)
    {
        if (exit == kInvalid || opposites_[exit] == kInvalid)
            return false;
        cross(exit, path);
        const HalfEdgeId entered = opposites_[exit];
        path.to = cornerTriangle(entered);
        if (contains(path.to, end))
            return true;
        const HalfEdgeId next = nextHalfEdge(entered), last = previousHalfEdge(entered);
        if (leadsToEnd(next))
            exit = next;
        else if (leadsToEnd(last))
            exit = last;
        else
        {
            const float tip = signedArea(last);
            const float left = signed_areas[cornerNumber(nextHalfEdge(exit))],
                        right = signed_areas[cornerNumber(exit)];
            // if the tip is to the right, leave between the tip and the left corner
            exit = tip < 0 ? last : next;
            signed_areas[cornerNumber(entered)] = left;
            signed_areas[cornerNumber(next)] = right;
            signed_areas[cornerNumber(last)] = tip;
        }
    }
    return false;
}

/// Find a path over the fewest half-edges, by breadth-first search.
bool EdgePathTracer::traceShortest(const MappedPoint& start, const MappedPoint& end, TracedPath& path)
{
    struct VisitedTriangle
    {
        TriangleId triangle;
        HalfEdgeId half_edge; ///< half-edge that was crossed to get there
        size_t before;
    };
    std::vector<VisitedTriangle> visited;
    if (start.isVertex())
        for (const TriangleId triangle : after_.triangles_at.list(start.vertex))
            visited.push_back({triangle, kInvalid, 0});
    else
        visited.push_back({start.triangle, kInvalid, 0});
    for (size_t i = 0; i < visited.size() && visited.size() < kMaxTriangles; ++i)
        for (const HalfEdgeId half_edge : makeCorners(visited[i].triangle))
        {
            if (opposites_[half_edge] == kInvalid)
                continue;
            const TriangleId triangle = cornerTriangle(opposites_[half_edge]);
            if (std::any_of(visited.begin(), visited.end(),
                            [&](const VisitedTriangle& r) { return r.triangle == triangle; }))
                continue;
            visited.push_back({triangle, half_edge, i});
            if (!contains(triangle, end))
                continue;
            size_t at = visited.size() - 1;
            for (; visited[at].half_edge != kInvalid; at = visited[at].before)
                cross(visited[at].half_edge, path);
            std::reverse(crossings_.begin() + static_cast<ptrdiff_t>(path.first), crossings_.end());
            path.from = visited[at].triangle;
            path.to = triangle;
            return true;
        }
    return false;
}

std::span<const HalfEdgeId> EdgePathTracer::turn(PositionId vertex, TriangleId from, TriangleId to)
{
    turn_.clear();
    const HalfEdgeId start = cornerAt(from, vertex);
    HEARTH_RUNTIME_ASSERT(start != kInvalid);
    HalfEdgeId left = start, right = start;
    for (size_t steps = 1; steps < kMaxSteps; ++steps)
    {
        if (left != kInvalid)
        {
            left = opposites_[previousHalfEdge(left)];
            if (left != kInvalid && cornerTriangle(left) == to)
            {
                for (HalfEdgeId at = start; cornerTriangle(at) != to; at = opposites_[turn_.back()])
                    turn_.push_back(previousHalfEdge(at));
                break;
            }
        }
        if (right != kInvalid)
        {
            right = opposites_[right];
            right = right == kInvalid ? right : nextHalfEdge(right);
            if (right != kInvalid && cornerTriangle(right) == to)
            {
                for (HalfEdgeId at = start; cornerTriangle(at) != to; at = nextHalfEdge(opposites_[at]))
                    turn_.push_back(at);
                break;
            }
        }
    }
    return turn_;
}

} // namespace hearth::clusters
