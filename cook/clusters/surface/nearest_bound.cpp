// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/nearest_bound.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hearth::clusters
{

namespace
{

// A triangle this close, in parts of its own size, is not searched further: on a plane all distances are
// rounding. Parts of 512 would do, except beside an open border, where this tolerance would be the whole
// error of a plane.
constexpr float kFinest2 = 1.0f / (8192.0f * 8192.0f);

// Triangles within this part of a triangle's size are searched first.
constexpr float kTouching = 0.1f;

// Likely triangles and points of the first attempts.
constexpr size_t kFewLikely = 2 * kLanes;
constexpr size_t kFewPoints = 6;
constexpr size_t kQuickPoints = 16;

// Rounding of planes' distances between points in [-1, 1]^3.
constexpr float kSideMargin = 1e-5f;

// A triangle is searched in at most this many parts; then its bound is taken as it is.
constexpr size_t kMaxParts = 64;
constexpr size_t kMaxMetricParts = 16;

constexpr Bound kNoBound{kInfinity, 0, 0, false};

Box3 boxAround(const Corners& corners, float radius)
{
    Box3 box;
    for (const Float3 corner : corners)
        box.add(corner);
    box.min -= Float3{radius, radius, radius};
    box.max += Float3{radius, radius, radius};
    return box;
}

float longestEdge(const Corners& corners)
{
    return std::max(
        {length(corners[1] - corners[0]), length(corners[2] - corners[1]), length(corners[0] - corners[2])});
}

constexpr std::array<Float2, 3> kWhole{Float2{0, 0}, Float2{1, 0}, Float2{0, 1}};

} // namespace

/// Halve the longest edge.
std::pair<NearestBound::Piece, NearestBound::Piece> NearestBound::halve(const Piece& piece)
{
    const Corners& c = piece.corners;
    size_t longest = 0;
    for (size_t k = 1; k < 3; ++k)
        if (length(c[(k + 1) % 3] - c[k]) > length(c[(longest + 1) % 3] - c[longest]))
            longest = k;
    const size_t second = (longest + 1) % 3, third = (longest + 2) % 3;
    const Float3 p = c[longest], q = c[second], apex = c[third];
    const Float3 middle = (p + q) * 0.5f;
    const Float2 plane_p = piece.plane[longest], plane_q = piece.plane[second],
                 plane_apex = piece.plane[third];
    const Float2 plane_middle = (plane_p + plane_q) * 0.5f;
    return {{{p, middle, apex}, {plane_p, plane_middle, plane_apex}},
            {{middle, q, apex}, {plane_middle, plane_q, plane_apex}}};
}

float NearestBound::bound(const Corners& triangle, TriangleBoxes& index, std::span<const TriangleId> likely,
                          Tolerance tolerance, SurfaceMetric* metric)
{
    HEARTH_RUNTIME_ASSERT(likely.size() <= kMaxCandidates && tolerance.slack >= 0);
    metric_ = metric;
    const size_t max_parts = metric == nullptr ? kMaxParts : kMaxMetricParts;
    const float size = longestEdge(triangle);
    tolerance_ = tolerance;
    floor2_ = size * size * kFinest2;
    lower2_ = 0;
    used_.clear();
    if (!likely.empty())
        if (const Bound quick = boundByLikely(triangle, index, likely); quick.closed)
        {
            addUsed(likely);
            return std::sqrt(quick.upper2);
        }
    float worst2 = 0;
    stack_.assign(1, {triangle, kWhole});
    for (size_t parts = 1; !stack_.empty(); ++parts)
    {
        const Piece piece = stack_.back();
        stack_.pop_back();
        // the triangles that touch the piece suffice for most; otherwise search all that could be the nearest
        Bound bound = boundPiece(piece, index, allowed2(), size * kTouching);
        if (!bound.closed && metric == nullptr)
            bound = boundPiece(piece, index, allowed2(), std::sqrt(bound.found2) * 1.01f);
        lower2_ = std::max(lower2_, bound.sure2);
        if (!bound.closed && parts < max_parts)
        {
            const auto [first, second] = halve(piece);
            stack_.push_back(first);
            stack_.push_back(second);
            continue;
        }
        if (!bound.closed)
        {
            ++loose_pieces_;
            bound = boundPiece(piece, index, kInfinity,
                               metric == nullptr ? std::sqrt(bound.found2) : size * kTouching);
        }
        addUsed(found_);
        worst2 = std::max(worst2, bound.upper2);
    }
    HEARTH_RUNTIME_ASSERT(!used_.empty() || metric != nullptr);
    return std::sqrt(worst2);
}

Bound NearestBound::boundByLikely(const Corners& triangle, TriangleBoxes& index,
                                  std::span<const TriangleId> likely)
{
    const auto few = likely.first(std::min(likely.size(), kFewLikely));
    if (metric_ != nullptr)
        metric_->setPiece(kWhole);
    if (!load(index, few))
        return kNoBound;
    const Bound bound = bounder_.bound(triangle, candidates_.blocks(), allowed2(), 0, kFewPoints, metric_);
    if (bound.closed || few.size() == likely.size())
        return bound;
    if (!load(index, likely))
        return kNoBound;
    return bounder_.bound(triangle, candidates_.blocks(), allowed2(), 0, kQuickPoints, metric_);
}

/// Load the candidate triangles. False if the metric has no bound.
bool NearestBound::load(const TriangleBoxes& index, std::span<const TriangleId> triangles)
{
    triangles_.clear();
    for (const TriangleId triangle : triangles)
        triangles_.push_back(index.triangle(triangle));
    candidates_.load(triangles_);
    return metric_ == nullptr || metric_->load(triangles);
}

/// Record the loaded triangles that the last bound was taken from.
void NearestBound::addUsed(std::span<const TriangleId> triangles)
{
    for (size_t i = 0; i < triangles.size(); ++i)
        if (bounder_.wasUsed(i))
            used_.push_back({triangles[i], std::sqrt(bounder_.usedDistance2(i))});
}

float NearestBound::allowed2() const
{
    const float allowed = std::max(tolerance_.enough, std::sqrt(lower2_) * kSlack + tolerance_.slack);
    return std::max(allowed * allowed, floor2_);
}

/// Bound the distance to the triangles within `radius`; if there are none, to those within a larger one. If
/// there are too many, those with the nearest centers serve.
Bound NearestBound::boundPiece(const Piece& piece, TriangleBoxes& index, float allowed2, float radius)
{
    index.query(boxAround(piece.corners, radius), found_);
    for (float wider = std::max(radius, 1e-3f); found_.empty(); wider *= 2)
        index.query(boxAround(piece.corners, wider), found_);
    if (found_.size() > kLanes)
        dropDistant(piece.corners, index, radius);
    if (found_.size() > kMaxCandidates)
    {
        keepNearest(piece.corners, index);
        radius = 0;
    }
    else if (metric_ != nullptr)
        radius = kInfinity; // do not search for savings by triangles farther away
    if (metric_ != nullptr)
        metric_->setPiece(piece.plane);
    if (!load(index, found_))
        return kNoBound;
    return bounder_.bound(piece.corners, candidates_.blocks(), allowed2, radius, kMaxPoints, metric_);
}

/// Drop triangles that lie beyond an edge of the piece by more than `radius`: the index tests only their
/// boxes. Keeps all if none would remain.
void NearestBound::dropDistant(const Corners& piece, TriangleBoxes& index, float radius)
{
    const Float3 normal = cross(piece[1] - piece[0], piece[2] - piece[0]);
    std::array<Float3, 3> outward;
    std::array<float, 3> limit;
    for (size_t k = 0; k < 3; ++k)
    {
        outward[k] = cross(piece[(k + 1) % 3] - piece[k], normal);
        limit[k] = std::max({hearth::dot(outward[k], piece[0]), hearth::dot(outward[k], piece[1]),
                             hearth::dot(outward[k], piece[2])}) +
                   length(outward[k]) * (radius + kSideMargin);
    }
    const auto beside = [&](TriangleId candidate)
    {
        const DistanceTriangle triangle = index.triangle(candidate);
        for (size_t k = 0; k < 3; ++k)
        {
            const float a = hearth::dot(outward[k], triangle.a);
            const float nearest = a + std::min({0.0f, hearth::dot(outward[k], triangle.ab),
                                                hearth::dot(outward[k], triangle.ac)});
            if (nearest > limit[k])
                return true;
        }
        return false;
    };
    const auto kept = std::remove_if(found_.begin(), found_.end(), beside);
    if (kept != found_.begin())
        found_.erase(kept, found_.end());
}

void NearestBound::keepNearest(const Corners& piece, TriangleBoxes& index)
{
    const Float3 middle = (piece[0] + piece[1] + piece[2]) / 3.0f;
    by_distance_.clear();
    for (const TriangleId candidate : found_)
    {
        const DistanceTriangle triangle = index.triangle(candidate);
        const Float3 away = triangle.a + (triangle.ab + triangle.ac) / 3.0f - middle;
        by_distance_.push_back({hearth::dot(away, away), candidate});
    }
    std::nth_element(by_distance_.begin(), by_distance_.begin() + kMaxCandidates, by_distance_.end());
    found_.clear();
    for (size_t i = 0; i < kMaxCandidates; ++i)
        found_.push_back(by_distance_[i].second);
    std::sort(found_.begin(), found_.end());
}

} // namespace hearth::clusters
