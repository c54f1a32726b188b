// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/deviation.h"

#include "cook/clusters/facet_grid.h"
#include "formats/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hearth::clusters
{

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Pieces are cut until they are this close to the largest distance that the group has anyway.
constexpr float kSlack2 = 1.1f * 1.1f;

// And not below this part of the size of their triangle: on a plane all distances are rounding.
constexpr float kFinest2 = 1.0f / (512.0f * 512.0f);

// Rounding of a distance between points in [-1, 1]^3: a few times 2^-23, with room.
constexpr double kRounding = 2e-6;

constexpr size_t kMaxBlocks = 8;
constexpr size_t kMaxCandidates = kLanes * kMaxBlocks;
constexpr size_t kMaxPoints = 28;

// Facets within this part of a triangle's size are looked at first.
constexpr float kTouching = 0.1f;

// The first try with a few likely facets ends early; it serves for nine triangles of ten.
constexpr size_t kQuickPoints = 9;
constexpr size_t kMaxLikely = 2 * kLanes;

// A triangle is searched in at most so many parts before its bound is taken as it is.
constexpr size_t kMaxParts = 64;

using Corners = std::array<Float3, 3>;

/// The facets that a piece is held against, at most kMaxCandidates.
class Candidates
{
public:
    void load(const FacetGrid& grid, std::span<const uint32_t> facets)
    {
        HEARTH_ASSERT(!facets.empty() && facets.size() <= kMaxCandidates);
        block_count_ = (facets.size() + kLanes - 1) / kLanes;
        for (size_t b = 0; b < block_count_; ++b)
        {
            // lanes that are left over repeat the first facet
            std::array<const Facet*, kLanes> lanes;
            for (size_t lane = 0; lane < kLanes; ++lane)
                lanes[lane] = &grid.facet(facets[b * kLanes + lane < facets.size() ? b * kLanes + lane : 0]);
            blocks_[b] = makeBlock(lanes);
        }
    }

    std::span<const FacetBlock> blocks() const { return std::span(blocks_).first(block_count_); }

private:
    std::array<FacetBlock, kMaxBlocks> blocks_;
    size_t block_count_ = 0;
};

/// A point of the piece: where it is in the piece's plane, and its squared distance to each candidate.
struct Probe
{
    Float3 place;
    Float2 plane; ///< multiples of the piece's edges from corner 0
    std::array<Lanes, kMaxBlocks> distance2;
};

/// Twice the signed area of a triangle in the plane.
float area2(Float2 a, Float2 b, Float2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct Bound
{
    float upper2; ///< the whole piece is within this of the candidates, squared
    float found2; ///< some point of it is so far from these candidates
    float sure2;  ///< and so far from all facets
    bool closed;  ///< upper2 is as good as is worth searching for
};

/// Bounds the distance of one piece of a triangle to a few facets.
class Bounder
{
public:
    /// Cut the piece where the nearest candidate changes, until every part is within allowed2 of one candidate (or
    /// within 10 % of a distance that is there), or the points run out. Parts are cut at corners of candidates that
    /// lie over them, else where an edge leaves the candidate that it starts on: on a plane that is the common
    /// refinement of both surfaces.
    ///
    /// blocks    all facets that are within `radius` of the piece, and perhaps others
    Bound bound(const Corners& piece, std::span<const FacetBlock> blocks, float allowed2, float radius,
                size_t max_points = kMaxPoints)
    {
        blocks_ = blocks;
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
            // a true distance beyond what these facets can prove ends the search among them
            if (lower2_ > std::max(allowed2, radius2_ * kSlack2))
                return {kInfinity, lower2_, std::min(lower2_, radius2_), false};
            const Part part = stack_[--stack_size];
            const float best2 = common(part);
            if (best2 <= std::max(tolerance2(), upper2) || point_count_ >= max_points)
            {
                upper2 = std::max(upper2, best2);
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

private:
    using Part = std::array<uint8_t, 3>;
    static constexpr uint8_t kNoPoint = 0xFF;

    /// Closer than this need not be searched for.
    float tolerance2() const { return std::max(allowed2_, std::min(lower2_, radius2_) * kSlack2); }

    uint8_t addPoint(Float3 place, Float2 plane)
    {
        Probe& probe = points_[point_count_];
        probe.place = place;
        probe.plane = plane;
        Lanes least = allLanes(kInfinity);
        for (size_t b = 0; b < blocks_.size(); ++b)
        {
            probe.distance2[b] = blocks_[b].distance2(place);
            least = minimum(least, probe.distance2[b]);
        }
        lower2_ = std::max(lower2_, leastLane(least));
        return static_cast<uint8_t>(point_count_++);
    }

    /// Squared distance within which one candidate holds all the named points.
    template <size_t N>
    float common(const std::array<uint8_t, N>& names) const
    {
        Lanes least = allLanes(kInfinity);
        for (size_t b = 0; b < blocks_.size(); ++b)
        {
            Lanes worst = points_[names[0]].distance2[b];
            for (size_t i = 1; i < N; ++i)
                worst = maximum(worst, points_[names[i]].distance2[b]);
            least = minimum(least, worst);
        }
        return leastLane(least);
    }

    /// The corners of candidates that project into the piece.
    void findCorners()
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
        const LaneVector f1 = allLanes((e1 * d22 - e2 * d12) / det);
        const LaneVector f2 = allLanes((e2 * d11 - e1 * d12) / det);
        for (const FacetBlock& block : blocks_)
        {
            const LaneVector corner_a = block.a - allLanes(origin);
            const Lanes a1 = dot(corner_a, f1), a2 = dot(corner_a, f2);
            keepInside(a1, a2);
            keepInside(a1 + dot(block.ab, f1), a2 + dot(block.ab, f2));
            keepInside(a1 + dot(block.ac, f1), a2 + dot(block.ac, f2));
        }
    }

    void keepInside(Lanes x, Lanes y)
    {
        const Lanes margin = allLanes(kCornerMargin);
        const Lanes inside = minimum(minimum(x, y), allLanes(1) - x - y) - margin;
        for (size_t lane = 0; lane < kLanes; ++lane)
        {
            if (!(inside[lane] > 0) || corner_count_ == corners_.size())
                continue;
            const Float2 corner{x[lane], y[lane]};
            // each corner comes once for each of its facets
            const bool known = std::any_of(corners_.begin(), corners_.begin() + corner_count_,
                                           [&](Float2 other) {
                                               return std::abs(other.x - corner.x) < kCornerMargin &&
                                                      std::abs(other.y - corner.y) < kCornerMargin;
                                           });
            if (!known)
                corners_[corner_count_++] = corner;
        }
    }

    Float3 placeAt(Float2 plane) const
    {
        return points_[0].place + (points_[1].place - points_[0].place) * plane.x +
               (points_[2].place - points_[0].place) * plane.y;
    }

    /// A new point at a candidate's corner over the part, or kNoPoint.
    uint8_t cornerInside(const Part& part)
    {
        const Float2 a = points_[part[0]].plane, b = points_[part[1]].plane, c = points_[part[2]].plane;
        const float least = kCornerMargin * std::abs(area2(a, b, c));
        for (uint32_t i = 0; i < corner_count_; ++i)
        {
            const Float2 corner = corners_[i];
            if (area2(a, b, corner) > least && area2(b, c, corner) > least && area2(c, a, corner) > least)
                return addPoint(placeAt(corner), corner);
        }
        return kNoPoint;
    }

    /// The edge whose ends agree least on a candidate.
    size_t worstEdge(const Part& part) const
    {
        size_t edge = 0;
        float edge_value = -1;
        float edge_length2 = -1;
        for (size_t k = 0; k < 3; ++k)
        {
            const std::array<uint8_t, 2> ends{part[k], part[(k + 1) % 3]};
            const float value = common(ends);
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

    /// A new point between two, where the edge has left every candidate that it starts on; the middle if none serves.
    uint8_t cutEdge(uint8_t p, uint8_t q)
    {
        const Lanes near2 = allLanes(tolerance2());
        const LaneVector place_p = allLanes(points_[p].place);
        const LaneVector place_q = allLanes(points_[q].place);
        Lanes farthest = allLanes(0);
        for (size_t b = 0; b < blocks_.size(); ++b)
        {
            const FacetBlock::Coordinates at_p = blocks_[b].project(place_p);
            const FacetBlock::Coordinates at_q = blocks_[b].project(place_q);
            const Lanes leaves =
                minimum(minimum(leavesAt(at_p.v, at_q.v), leavesAt(at_p.w, at_q.w)),
                        leavesAt(allLanes(1) - at_p.v - at_p.w, allLanes(1) - at_q.v - at_q.w));
            const LaneMask starts_here =
                (points_[p].distance2[b] <= near2) & (blocks_[b].inverse_det > allLanes(0));
            farthest = maximum(farthest, starts_here ? leaves : allLanes(0));
        }
        const float t = greatestLane(farthest);
        const float s = t > kShortest && t < 1 - kShortest ? t : 0.5f;
        return addPoint(points_[p].place * (1 - s) + points_[q].place * s,
                        points_[p].plane * (1 - s) + points_[q].plane * s);
    }

    /// Where a coordinate that runs from x to y becomes negative, in [0, 1].
    static Lanes leavesAt(Lanes x, Lanes y)
    {
        const Lanes start = maximum(x, allLanes(0));
        return y < allLanes(0) ? start / (start - y) : allLanes(1);
    }

    static constexpr float kCornerMargin =
        0.01f; ///< corners this near to an edge of the piece are left to its cuts
    static constexpr float kShortest = 0.01f; ///< part of an edge that is worth cutting off

    std::span<const FacetBlock> blocks_;
    float allowed2_ = 0;
    float radius2_ = 0;
    float lower2_ = 0; ///< largest distance of a point to the candidates; true up to radius2_
    std::array<Probe, kMaxPoints> points_;
    size_t point_count_ = 0;
    std::array<Part, 3 * kMaxPoints> stack_;
    std::array<Float2, 12> corners_;
    uint32_t corner_count_ = 0;
    bool corners_found_ = false;
};

Box3 boxAround(const Corners& corners, float radius)
{
    Box3 box;
    for (const Float3 corner : corners)
        box.add(corner);
    box.min -= Float3{radius, radius, radius};
    box.max += Float3{radius, radius, radius};
    return box;
}

float sizeOf(const Corners& corners)
{
    return std::max(
        {length(corners[1] - corners[0]), length(corners[2] - corners[1]), length(corners[0] - corners[2])});
}

/// Halves the longest edge.
std::pair<Corners, Corners> halve(const Corners& c)
{
    size_t longest = 0;
    for (size_t k = 1; k < 3; ++k)
        if (length(c[(k + 1) % 3] - c[k]) > length(c[(longest + 1) % 3] - c[longest]))
            longest = k;
    const Float3 p = c[longest], q = c[(longest + 1) % 3], apex = c[(longest + 2) % 3];
    const Float3 middle = (p + q) * 0.5f;
    return {{p, middle, apex}, {middle, q, apex}};
}

/// Measures triangles against one surface and keeps the largest bound.
class Measure
{
public:
    float worst2() const { return worst2_; }
    uint64_t loosePieces() const { return loose_pieces_; }

    /// Raise the bound until it holds for the triangle.
    /// likely  facets that probably lie beside it: if they bound it well enough, no others are searched
    void add(const Corners& triangle, FacetGrid& grid, std::span<const uint32_t> likely)
    {
        const float size = sizeOf(triangle);
        const float floor2 = size * size * kFinest2;
        float found2 = 0;
        if (!likely.empty())
        {
            candidates_.load(grid, likely);
            const Bound bound =
                bounder_.bound(triangle, candidates_.blocks(), allowed2(floor2), 0, kQuickPoints);
            if (bound.closed)
            {
                worst2_ = std::max(worst2_, bound.upper2);
                return;
            }
            found2 = bound.found2;
        }
        stack_.assign(1, triangle);
        for (size_t parts = 1; !stack_.empty(); ++parts)
        {
            const Corners piece = stack_.back();
            stack_.pop_back();
            // the facets that touch the piece do for most; the rest needs all that could be the nearest
            Bound bound{kInfinity, found2, 0, false};
            if (found2 <= allowed2(floor2))
                bound = boundPiece(piece, grid, allowed2(floor2), size * kTouching);
            if (!bound.closed)
                bound = boundPiece(piece, grid, allowed2(floor2), std::sqrt(bound.found2) * 1.01f);
            sure2_ = std::max(sure2_, bound.sure2);
            found2 = 0;
            if (!bound.closed && parts < kMaxParts)
            {
                const auto [first, second] = halve(piece);
                stack_.push_back(first);
                stack_.push_back(second);
                continue;
            }
            if (!bound.closed)
            {
                ++loose_pieces_;
                bound = boundPiece(piece, grid, kInfinity, std::sqrt(bound.found2));
            }
            worst2_ = std::max(worst2_, bound.upper2);
        }
    }

private:
    /// What need not be searched for: as far as any found so far, or 10 % more than what is sure.
    float allowed2(float floor2) const { return std::max({worst2_, sure2_ * kSlack2, floor2}); }

    /// Bound the distance to the facets within `radius`; if there are none, to those within a larger one. Where there
    /// are more than fit, those with the nearest centers serve.
    Bound boundPiece(const Corners& piece, FacetGrid& grid, float allowed2, float radius)
    {
        grid.query(boxAround(piece, radius), found_);
        for (float wider = std::max(radius, 1e-3f); found_.empty(); wider *= 2)
            grid.query(boxAround(piece, wider), found_);
        if (found_.size() > kMaxCandidates)
        {
            keepNearest(piece, grid);
            radius = 0;
        }
        candidates_.load(grid, found_);
        return bounder_.bound(piece, candidates_.blocks(), allowed2, radius);
    }

    void keepNearest(const Corners& piece, const FacetGrid& grid)
    {
        const Float3 middle = (piece[0] + piece[1] + piece[2]) / 3.0f;
        by_distance_.clear();
        for (const uint32_t f : found_)
        {
            const Float3 away = grid.facet(f).a + (grid.facet(f).ab + grid.facet(f).ac) / 3.0f - middle;
            by_distance_.push_back({hearth::dot(away, away), f});
        }
        std::nth_element(by_distance_.begin(), by_distance_.begin() + kMaxCandidates, by_distance_.end());
        std::sort(by_distance_.begin(), by_distance_.begin() + kMaxCandidates);
        found_.resize(kMaxCandidates);
        for (size_t i = 0; i < kMaxCandidates; ++i)
            found_[i] = by_distance_[i].second;
    }

    std::vector<std::pair<float, uint32_t>> by_distance_;
    float worst2_ = 0; ///< no point is farther away, squared
    float sure2_ = 0;  ///< some point is as far away
    uint64_t loose_pieces_ = 0;
    std::vector<Corners> stack_;
    std::vector<uint32_t> found_;
    Candidates candidates_;
    Bounder bounder_;
};

std::vector<Float3> placesOf(const GroupMesh& group, std::span<const uint32_t> corners)
{
    std::vector<Float3> places;
    places.reserve(corners.size());
    for (const uint32_t wedge : corners)
        places.push_back(group.positions[group.position_of_wedge[wedge]]);
    return places;
}

/// The triangles around each position.
class Stars
{
public:
    Stars(const GroupMesh& group, std::span<const uint32_t> corners) : offsets_(group.positions.size() + 1, 0)
    {
        for (const uint32_t wedge : corners)
            ++offsets_[group.position_of_wedge[wedge] + 1];
        for (size_t i = 1; i < offsets_.size(); ++i)
            offsets_[i] += offsets_[i - 1];
        items_.resize(corners.size());
        std::vector<uint32_t> next(offsets_.begin(), offsets_.end() - 1);
        for (size_t corner = 0; corner < corners.size(); ++corner)
            items_[next[group.position_of_wedge[corners[corner]]]++] = static_cast<uint32_t>(corner / 3);
    }

    std::span<const uint32_t> of(uint32_t position) const
    {
        return std::span(items_).subspan(offsets_[position], offsets_[position + 1] - offsets_[position]);
    }

private:
    std::vector<uint32_t> offsets_;
    std::vector<uint32_t> items_;
};

void addLikely(std::span<const uint32_t> star, std::vector<uint32_t>& likely)
{
    for (const uint32_t triangle : star)
        if (likely.size() < kMaxLikely && std::find(likely.begin(), likely.end(), triangle) == likely.end())
            likely.push_back(triangle);
}

/// Bound the triangles from before that are gone or changed, and those that are new. What a collapse moved lies
/// beside the star of the position that it moved to, and the new star beside that of the position that moved.
class GroupMeasure
{
public:
    GroupMeasure(const GroupMesh& group, const Simplified& simplified)
        : group_(group),
          simplified_(simplified),
          before_(placesOf(group, group.corners)),
          after_(placesOf(group, simplified.corners)),
          before_grid_(before_),
          after_grid_(after_),
          before_stars_(group, group.corners),
          after_stars_(group, simplified.corners)
    {
    }

    Deviation run()
    {
        std::vector<uint8_t> unchanged(group_.triangleCount(), 0);
        for (size_t t = 0; t < simplified_.triangleCount(); ++t)
            unchanged[simplified_.source_triangle[t]] = movedCorner(simplified_.source_triangle[t]) ? 0 : 1;
        for (size_t t = 0; t < unchanged.size(); ++t)
            if (unchanged[t] == 0)
                addBefore(t);
        for (size_t t = 0; t < simplified_.triangleCount(); ++t)
            if (unchanged[simplified_.source_triangle[t]] == 0)
                addAfter(t);
        return {static_cast<double>(std::sqrt(measure_.worst2())) + kRounding, measure_.loosePieces()};
    }

private:
    uint32_t targetOf(size_t corner) const
    {
        return simplified_.target_of_position[group_.positionAt(corner)];
    }

    bool movedCorner(size_t triangle) const
    {
        for (size_t k = 0; k < 3; ++k)
            if (targetOf(triangle * 3 + k) != group_.positionAt(triangle * 3 + k))
                return true;
        return false;
    }

    void addBefore(size_t t)
    {
        likely_.clear();
        for (size_t corner = t * 3; corner < t * 3 + 3; ++corner)
            if (const uint32_t target = targetOf(corner);
                target != kPruned && target != group_.positionAt(corner))
                addLikely(after_stars_.of(target), likely_);
        measure_.add({before_[t * 3], before_[t * 3 + 1], before_[t * 3 + 2]}, after_grid_, likely_);
    }

    void addAfter(size_t t)
    {
        likely_.clear();
        const size_t source = simplified_.source_triangle[t];
        for (size_t corner = source * 3; corner < source * 3 + 3; ++corner)
            if (targetOf(corner) != group_.positionAt(corner))
                addLikely(before_stars_.of(group_.positionAt(corner)), likely_);
        measure_.add({after_[t * 3], after_[t * 3 + 1], after_[t * 3 + 2]}, before_grid_, likely_);
    }

    const GroupMesh& group_;
    const Simplified& simplified_;
    std::vector<Float3> before_;
    std::vector<Float3> after_;
    FacetGrid before_grid_;
    FacetGrid after_grid_;
    Stars before_stars_;
    Stars after_stars_;
    std::vector<uint32_t> likely_;
    Measure measure_;
};

} // namespace

Deviation boundDeviation(const GroupMesh& group, const Simplified& simplified)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return GroupMeasure(group, simplified).run();
}

} // namespace hearth::clusters
