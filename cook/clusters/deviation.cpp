// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/deviation.h"

#include "cook/clusters/facet_index.h"
#include "cook/clusters/overlay.h"
#include "cook/clusters/piece_bound.h"
#include "cook/clusters/set_hash.h"
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

// A triangle this close in parts of its own size is not searched further: on a plane all distances are rounding.
constexpr float kFinest2 = 1.0f / (512.0f * 512.0f);

// Rounding of a distance between points in [-1, 1]^3: a few times 2^-23, with room.
constexpr double kRounding = 2e-6;

// Facets within this part of a triangle's size are looked at first.
constexpr float kTouching = 0.1f;

// The first tries take so many likely facets and points.
constexpr size_t kFewLikely = 2 * kLanes;
constexpr size_t kFewPoints = 6;
constexpr size_t kMaxLikely = 5 * kLanes;
constexpr size_t kQuickPoints = 16;

// Rounding of planes' distances between points in [-1, 1]^3.
constexpr float kSideMargin = 1e-5f;

// A triangle is searched in at most so many parts before its bound is taken as it is.
constexpr size_t kMaxParts = 64;

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

/// Measures triangles against surfaces and keeps the largest bound.
class Measure
{
public:
    /// carried  the error that the distance will be added to
    explicit Measure(float carried) : slack_of_carried_(carried * (kSlack - 1)) {}

    float worst2() const { return worst2_; }
    uint64_t loosePieces() const { return loose_pieces_; }

    /// Whether a few facets show that the bound holds for the triangle.
    bool holds(const Corners& triangle, const FacetIndex& index, std::span<const uint32_t> guess)
    {
        candidates_.load(index.facets(), guess);
        return bounder_.bound(triangle, candidates_.blocks(), worst2_, 0, kFewPoints).upper2 <= worst2_;
    }

    /// Whether a triangle within `upper` need not be looked at more closely.
    bool isNear(float upper) const { return upper * upper <= allowed2(0); }

    void addBound(float upper) { worst2_ = std::max(worst2_, upper * upper); }

    /// Raise the bound until it holds for the triangle.
    /// likely  facets that probably lie beside it, likeliest first: if they bound it well enough, no others are
    ///         searched; may be empty
    void add(const Corners& triangle, const FacetIndex& index, std::span<const uint32_t> likely)
    {
        const float size = sizeOf(triangle);
        const float floor2 = size * size * kFinest2;
        if (!likely.empty())
            if (const Bound quick = boundByLikely(triangle, index, likely, allowed2(floor2)); quick.closed)
            {
                worst2_ = std::max(worst2_, quick.upper2);
                return;
            }
        stack_.assign(1, triangle);
        for (size_t parts = 1; !stack_.empty(); ++parts)
        {
            const Corners piece = stack_.back();
            stack_.pop_back();
            // the facets that touch the piece do for most; the rest needs all that could be the nearest
            Bound bound = boundPiece(piece, index, allowed2(floor2), size * kTouching);
            if (!bound.closed)
                bound = boundPiece(piece, index, allowed2(floor2), std::sqrt(bound.found2) * 1.01f);
            sure2_ = std::max(sure2_, bound.sure2);
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
                bound = boundPiece(piece, index, kInfinity, std::sqrt(bound.found2));
            }
            worst2_ = std::max(worst2_, bound.upper2);
        }
    }

private:
    Bound boundByLikely(const Corners& triangle, const FacetIndex& index, std::span<const uint32_t> likely,
                        float allowed2)
    {
        const auto few = likely.first(std::min(likely.size(), kFewLikely));
        candidates_.load(index.facets(), few);
        const Bound bound = bounder_.bound(triangle, candidates_.blocks(), allowed2, 0, kFewPoints);
        if (bound.closed || few.size() == likely.size())
            return bound;
        candidates_.load(index.facets(), likely);
        return bounder_.bound(triangle, candidates_.blocks(), allowed2, 0, kQuickPoints);
    }

    /// What need not be searched for: as far as any found so far, or what raises the sum of both errors by 10 % of
    /// what is sure.
    float allowed2(float floor2) const
    {
        const float allowed = std::sqrt(sure2_) * kSlack + slack_of_carried_;
        return std::max({worst2_, allowed * allowed, floor2});
    }

    /// Bound the distance to the facets within `radius`; if there are none, to those within a larger one. Where there
    /// are more than fit, those with the nearest centers serve.
    Bound boundPiece(const Corners& piece, const FacetIndex& index, float allowed2, float radius)
    {
        index.query(boxAround(piece, radius), found_);
        for (float wider = std::max(radius, 1e-3f); found_.empty(); wider *= 2)
            index.query(boxAround(piece, wider), found_);
        if (found_.size() > kLanes)
            dropBesides(piece, index, radius);
        if (found_.size() > kMaxCandidates)
        {
            keepNearest(piece, index);
            radius = 0;
        }
        candidates_.load(index.facets(), found_);
        return bounder_.bound(piece, candidates_.blocks(), allowed2, radius);
    }

    /// Drop facets that lie beyond an edge of the piece by more than `radius`: the index knows them by their boxes only.
    /// Keeps all if none would be left.
    void dropBesides(const Corners& piece, const FacetIndex& index, float radius)
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
        const auto beside = [&](uint32_t f)
        {
            const Facet& facet = index.facets()[f];
            for (size_t k = 0; k < 3; ++k)
            {
                const float a = hearth::dot(outward[k], facet.a);
                const float nearest = a + std::min({0.0f, hearth::dot(outward[k], facet.ab),
                                                    hearth::dot(outward[k], facet.ac)});
                if (nearest > limit[k])
                    return true;
            }
            return false;
        };
        const auto kept = std::remove_if(found_.begin(), found_.end(), beside);
        if (kept != found_.begin())
            found_.erase(kept, found_.end());
    }

    void keepNearest(const Corners& piece, const FacetIndex& index)
    {
        const Float3 middle = (piece[0] + piece[1] + piece[2]) / 3.0f;
        by_distance_.clear();
        for (const uint32_t f : found_)
        {
            const Facet& facet = index.facets()[f];
            const Float3 away = facet.a + (facet.ab + facet.ac) / 3.0f - middle;
            by_distance_.push_back({hearth::dot(away, away), f});
        }
        std::nth_element(by_distance_.begin(), by_distance_.begin() + kMaxCandidates, by_distance_.end());
        found_.clear();
        for (size_t i = 0; i < kMaxCandidates; ++i)
            found_.push_back(by_distance_[i].second);
        std::sort(found_.begin(), found_.end());
    }

    std::vector<std::pair<float, uint32_t>> by_distance_;
    float worst2_ = 0; ///< no point is farther away, squared
    float slack_of_carried_;
    float sure2_ = 0; ///< some point is as far away
    uint64_t loose_pieces_ = 0;
    std::vector<Corners> stack_;
    std::vector<uint32_t> found_;
    Candidates candidates_;
    Bounder bounder_;
};

/// A short list of facets, each once.
class Likely
{
public:
    explicit Likely(size_t facet_count) : list_of_facet_(facet_count, 0) {}

    void clear()
    {
        ++list_;
        facets_.clear();
    }

    void addAround(const Surface& surface, uint32_t position)
    {
        for (const uint32_t facet : surface.facets_at.of(position))
            if (list_of_facet_[facet] != list_ && facets_.size() < kMaxLikely)
            {
                list_of_facet_[facet] = list_;
                facets_.push_back(facet);
            }
    }

    std::span<const uint32_t> facets() const { return facets_; }

private:
    std::vector<uint32_t> list_of_facet_; ///< number of the last list that it was in
    uint32_t list_ = 0;
    std::vector<uint32_t> facets_;
};

/// Where triangles do not close around a position. Both surfaces are open at the same ones: collapses keep borders.
std::vector<uint8_t> openPositions(const GroupMesh& group)
{
    std::vector<uint64_t> difference(group.positions.size(), 0);
    for (size_t t = 0; t < group.corners.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
            difference[group.positionAt(t + k)] +=
                hashOf(group.positionAt(t + (k + 1) % 3)) - hashOf(group.positionAt(t + (k + 2) % 3));
    std::vector<uint8_t> open(difference.size());
    for (size_t p = 0; p < open.size(); ++p)
        open[p] = difference[p] != 0 ? 1 : 0;
    return open;
}

std::vector<uint32_t> positionsOf(const GroupMesh& group, std::span<const uint32_t> wedges)
{
    std::vector<uint32_t> positions;
    positions.reserve(wedges.size());
    for (const uint32_t wedge : wedges)
        positions.push_back(group.position_of_wedge[wedge]);
    return positions;
}

/// An upper bound of a triangle's distance.
struct Height
{
    float upper;
    uint32_t triangle;
    bool before;

    bool operator<(const Height& b) const
    {
        return upper != b.upper     ? upper < b.upper
               : before != b.before ? before < b.before
                                    : triangle < b.triangle;
    }
};

/// Bounds the triangles from before that are gone or changed, and those that are new. What a collapse moved lies beside
/// the star of the position that it moved to, and the new star beside that of the position that moved.
class GroupMeasure
{
public:
    GroupMeasure(const GroupMesh& group, const Simplified& simplified, float carried)
        : group_(group),
          simplified_(simplified),
          before_(positionsOf(group, group.corners), group.positions),
          after_(positionsOf(group, simplified.corners), simplified.placement.places),
          sources_(NumberLists::byKey<1>(group.positions.size(), simplified.target_of_position)),
          open_(openPositions(group)),
          over_before_(before_, open_),
          over_after_(after_, open_),
          likely_before_(before_.facetCount()),
          likely_after_(after_.facetCount()),
          measure_(carried)
    {
    }

    Deviation run()
    {
        std::vector<uint8_t> unchanged(group_.triangleCount(), 0);
        for (size_t t = 0; t < simplified_.triangleCount(); ++t)
            unchanged[simplified_.source_triangle[t]] = movedCorner(simplified_.source_triangle[t]) ? 0 : 1;
        for (uint32_t t = 0; t < unchanged.size(); ++t)
            if (unchanged[t] == 0)
                heights_.push_back({heightBefore(t), t, true});
        for (uint32_t t = 0; t < simplified_.triangleCount(); ++t)
            if (unchanged[simplified_.source_triangle[t]] == 0)
                heights_.push_back({heightAfter(t), t, false});
        addHeights();
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
            if (moved(triangle * 3 + k))
                return true;
        return false;
    }

    bool moved(size_t corner) const
    {
        const uint32_t target = targetOf(corner);
        return target != group_.positionAt(corner) || simplified_.placement.remade[target] != 0;
    }

    /// Largest first: once one needs no closer look, neither do the others.
    void addHeights()
    {
        std::make_heap(heights_.begin(), heights_.end());
        while (!heights_.empty())
        {
            const Height height = heights_.front();
            if (measure_.isNear(height.upper))
            {
                measure_.addBound(height.upper);
                return;
            }
            height.before ? addBefore(height.triangle) : addAfter(height.triangle);
            std::pop_heap(heights_.begin(), heights_.end());
            heights_.pop_back();
        }
    }

    float heightBefore(size_t t)
    {
        over_after_.clear();
        for (size_t corner = t * 3; corner < t * 3 + 3; ++corner)
        {
            if (targetOf(corner) == kPruned)
                return kInfinity;
            over_after_.addCenter(targetOf(corner));
        }
        return over_after_.heightOver(before_.cornersOf(t));
    }

    float heightAfter(size_t t)
    {
        over_before_.clear();
        for (size_t corner = t * 3; corner < t * 3 + 3; ++corner)
            for (const uint32_t position : sources_.of(after_.positions[corner]))
                over_before_.addCenter(position);
        return over_before_.heightOver(after_.cornersOf(t));
    }

    void addBefore(size_t t)
    {
        likely_after_.clear();
        for (size_t corner = t * 3; corner < t * 3 + 3; ++corner)
            if (const uint32_t target = targetOf(corner); target != kPruned && moved(corner))
                likely_after_.addAround(after_, target);
        const Corners corners = before_.cornersOf(t);
        if (!likely_after_.facets().empty() || !measure_.holds(corners, after_.index, neighboursInOrder(t)))
            measure_.add(corners, after_.index, likely_after_.facets());
    }

    void addAfter(size_t t)
    {
        likely_before_.clear();
        const size_t source = simplified_.source_triangle[t];
        for (size_t corner = source * 3; corner < source * 3 + 3; ++corner)
            if (moved(corner))
                likely_before_.addAround(before_, group_.positionAt(corner));
        measure_.add(after_.cornersOf(t), before_.index, likely_before_.facets());
    }

    /// New triangles that were near an old one in the clusters' order: a fair guess for those of islands that are gone.
    std::array<uint32_t, kFewLikely> neighboursInOrder(size_t source) const
    {
        const auto& left = simplified_.source_triangle;
        const auto after =
            static_cast<size_t>(std::lower_bound(left.begin(), left.end(), source) - left.begin());
        const size_t last_start = left.size() - std::min(left.size(), kFewLikely);
        const size_t start = std::min(after - std::min(after, kFewLikely / 2), last_start);
        std::array<uint32_t, kFewLikely> neighbours;
        for (size_t i = 0; i < kFewLikely; ++i)
            neighbours[i] = static_cast<uint32_t>(std::min(start + i, left.size() - 1));
        return neighbours;
    }

    const GroupMesh& group_;
    const Simplified& simplified_;
    Surface before_;
    Surface after_;
    NumberLists sources_;       ///< positions that went to each
    std::vector<uint8_t> open_; ///< for each position
    Overlay over_before_;
    Overlay over_after_;
    Likely likely_before_;
    Likely likely_after_;
    std::vector<Height> heights_;
    Measure measure_;
};

} // namespace

Deviation boundDeviation(const GroupMesh& group, const Simplified& simplified, double carried)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return GroupMeasure(group, simplified, static_cast<float>(carried)).run();
}

} // namespace hearth::clusters
