// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/piece_bound.h"

#include <algorithm>
#include <cmath>

namespace hearth::clusters
{

namespace
{

/// Return twice the signed area of a triangle in the plane.
float area2(Float2 a, Float2 b, Float2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Return the parameter in [0, 1] where a coordinate that runs from x to y becomes negative.
Lanes exitParameter(Lanes x, Lanes y)
{
    const Lanes start = maximum(x, splat(0));
    return y < splat(0) ? start / (start - y) : splat(1);
}

} // namespace

Bound PieceBounder::bound(const Corners& piece, std::span<const TriangleBlock> blocks, float allowed2,
                          float radius, size_t max_points, const PointMetric* metric)
{
    HEARTH_RUNTIME_ASSERT(!blocks.empty() && blocks.size() <= kMaxBlocks);
    HEARTH_RUNTIME_ASSERT(max_points >= 3 && max_points <= kMaxPoints);
    blocks_ = blocks;
    metric_ = metric;
    used_ = 0;
    allowed2_ = allowed2;
    radius2_ = radius * radius;
    point_count_ = 0;
    lower2_ = 0;
    corners_found_ = false;
    float upper2 = 0;
    size_t stack_size = 0;
    stack_[stack_size++] = {addPoint(piece[0], {0, 0}), addPoint(piece[1], {1, 0}),
                            addPoint(piece[2], {0, 1})};
    while (stack_size > 0)
    {
        // a real distance beyond the range of these triangles ends the search among them
        if (lower2_ > std::max(allowed2, radius2_ * kSlack2))
            return {kInfinity, lower2_, std::min(lower2_, radius2_), false};
        const Part part = stack_[--stack_size];
        const float best2 = commonDistance2(part);
        if (best2 <= std::max(tolerance2(), upper2) || point_count_ >= max_points)
        {
            upper2 = std::max(upper2, best2);
            use(best(part), best2);
            continue;
        }
        if (!corners_found_)
            findCorners();
        if (const uint8_t inner = cornerInside(part); inner != kNoPoint)
        {
            for (size_t k = 0; k < 3; ++k)
                stack_[stack_size++] = {part[k], part[(k + 1) % 3], inner};
            continue;
        }
        const size_t edge = worstEdge(part);
        const uint8_t p = part[edge];
        const uint8_t q = part[(edge + 1) % 3];
        const uint8_t apex = part[(edge + 2) % 3];
        const uint8_t middle = cutEdge(p, q);
        stack_[stack_size++] = {p, middle, apex};
        stack_[stack_size++] = {middle, q, apex};
    }
    return {upper2, lower2_, std::min(lower2_, radius2_), upper2 <= tolerance2()};
}

/// Record that a part's bound was taken from a candidate.
void PieceBounder::use(size_t candidate, float distance2)
{
    used_distance2_[candidate] =
        wasUsed(candidate) ? std::max(used_distance2_[candidate], distance2) : distance2;
    used_ |= uint64_t{1} << candidate;
}

/// Return the squared distance below which bounds need not be improved.
float PieceBounder::tolerance2() const
{
    return std::max(allowed2_, std::min(lower2_, radius2_) * kSlack2);
}

uint8_t PieceBounder::addPoint(Float3 place, Float2 plane)
{
    HEARTH_RUNTIME_ASSERT(point_count_ < points_.size());
    Probe& probe = points_[point_count_];
    probe.place = place;
    probe.plane = plane;
    Lanes least = splat(kInfinity);
    for (size_t b = 0; b < blocks_.size(); ++b)
    {
        probe.distance2[b] = metric_ == nullptr ? blocks_[b].distance2(place)
                                                : metric_->distance2(plane, b, blocks_[b].nearest(place));
        least = minimum(least, probe.distance2[b]);
    }
    lower2_ = std::max(lower2_, minLane(least));
    return static_cast<uint8_t>(point_count_++);
}

/// Return the squared distance within which one candidate is near all the given points.
template <size_t N>
float PieceBounder::commonDistance2(const std::array<uint8_t, N>& names) const
{
    Lanes least = splat(kInfinity);
    for (size_t b = 0; b < blocks_.size(); ++b)
    {
        Lanes worst = points_[names[0]].distance2[b];
        for (size_t i = 1; i < N; ++i)
            worst = maximum(worst, points_[names[i]].distance2[b]);
        least = minimum(least, worst);
    }
    return minLane(least);
}

/// Return the first candidate with the smallest common distance to a part's points.
size_t PieceBounder::best(const Part& part) const
{
    const float least = commonDistance2(part);
    for (size_t b = 0; b < blocks_.size(); ++b)
    {
        const Lanes worst = maximum(maximum(points_[part[0]].distance2[b], points_[part[1]].distance2[b]),
                                    points_[part[2]].distance2[b]);
        for (size_t lane = 0; lane < kLanes; ++lane)
            if (worst[lane] <= least)
                return b * kLanes + lane;
    }
    return 0;
}

/// Find the corners of candidates that project into the piece.
void PieceBounder::findCorners()
{
    corners_found_ = true;
    corner_count_ = 0;
    const Float3 origin = points_[0].place;
    const Float3 e1 = points_[1].place - origin;
    const Float3 e2 = points_[2].place - origin;
    const float d11 = hearth::dot(e1, e1), d12 = hearth::dot(e1, e2), d22 = hearth::dot(e2, e2);
    const float det = d11 * d22 - d12 * d12;
    if (!(det > 1e-5f * d11 * d22))
        return;
    const LaneVector f1 = splat((e1 * d22 - e2 * d12) / det);
    const LaneVector f2 = splat((e2 * d11 - e1 * d12) / det);
    for (const TriangleBlock& block : blocks_)
    {
        const LaneVector corner_a = block.a - splat(origin);
        const Lanes a1 = dot(corner_a, f1), a2 = dot(corner_a, f2);
        keepInside(a1, a2);
        keepInside(a1 + dot(block.ab, f1), a2 + dot(block.ab, f2));
        keepInside(a1 + dot(block.ac, f1), a2 + dot(block.ac, f2));
    }
}

void PieceBounder::keepInside(Lanes x, Lanes y)
{
    const Lanes margin = splat(kCornerMargin);
    const Lanes inside = minimum(minimum(x, y), splat(1) - x - y) - margin;
    for (size_t lane = 0; lane < kLanes; ++lane)
    {
        if (!(inside[lane] > 0) || corner_count_ == corners_.size())
            continue;
        const Float2 corner{x[lane], y[lane]};
        // each corner comes once for each of its triangles
        const bool known = std::any_of(corners_.begin(), corners_.begin() + corner_count_,
                                       [&](Float2 other) {
                                           return std::abs(other.x - corner.x) < kCornerMargin &&
                                                  std::abs(other.y - corner.y) < kCornerMargin;
                                       });
        if (!known)
            corners_[corner_count_++] = corner;
    }
}

Float3 PieceBounder::positionAt(Float2 plane) const
{
    return points_[0].place + (points_[1].place - points_[0].place) * plane.x +
           (points_[2].place - points_[0].place) * plane.y;
}

/// Add a point at a candidate's corner over the part; kNoPoint if there is none.
uint8_t PieceBounder::cornerInside(const Part& part)
{
    const Float2 a = points_[part[0]].plane, b = points_[part[1]].plane, c = points_[part[2]].plane;
    const float least = kCornerMargin * std::abs(area2(a, b, c));
    for (uint32_t i = 0; i < corner_count_; ++i)
    {
        const Float2 corner = corners_[i];
        if (area2(a, b, corner) > least && area2(b, c, corner) > least && area2(c, a, corner) > least)
            return addPoint(positionAt(corner), corner);
    }
    return kNoPoint;
}

/// Return the edge whose ends have the largest common distance to a candidate.
size_t PieceBounder::worstEdge(const Part& part) const
{
    size_t edge = 0;
    float edge_value = -1;
    float edge_length2 = -1;
    for (size_t k = 0; k < 3; ++k)
    {
        const std::array<uint8_t, 2> ends{part[k], part[(k + 1) % 3]};
        const float value = commonDistance2(ends);
        const Float3 along = points_[ends[1]].place - points_[ends[0]].place;
        const float length2 = hearth::dot(along, along);
        if (value > edge_value || (value == edge_value && length2 > edge_length2))
        {
            edge = k;
            edge_value = value;
            edge_length2 = length2;
        }
    }
    return edge;
}

/// Add a point between two, where the edge has left every candidate that it starts on; at the middle if that
/// fails.
uint8_t PieceBounder::cutEdge(uint8_t p, uint8_t q)
{
    const Lanes near2 = splat(tolerance2());
    const LaneVector place_p = splat(points_[p].place);
    const LaneVector place_q = splat(points_[q].place);
    Lanes farthest = splat(0);
    for (size_t b = 0; b < blocks_.size(); ++b)
    {
        const LaneMask starts_here = (points_[p].distance2[b] <= near2) & (blocks_[b].inverse_det > splat(0));
        if (!anyLane(starts_here))
            continue;
        const TriangleBlock::Coordinates at_p = blocks_[b].project(place_p);
        const TriangleBlock::Coordinates at_q = blocks_[b].project(place_q);
        const Lanes leaves = minimum(minimum(exitParameter(at_p.v, at_q.v), exitParameter(at_p.w, at_q.w)),
                                     exitParameter(splat(1) - at_p.v - at_p.w, splat(1) - at_q.v - at_q.w));
        farthest = maximum(farthest, starts_here ? leaves : splat(0));
    }
    const float t = maxLane(farthest);
    const float s = t > kMinCut && t < 1 - kMinCut ? t : 0.5f;
    return addPoint(points_[p].place * (1 - s) + points_[q].place * s,
                    points_[p].plane * (1 - s) + points_[q].plane * s);
}

} // namespace hearth::clusters
