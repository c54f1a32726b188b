// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/deviation.h"

#include "cook/clusters/nearest_bound.h"
#include "cook/clusters/overlay.h"
#include "cook/clusters/surface.h"
#include "formats/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::clusters
{

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Rounding of a distance between points in [-1, 1]^3: a few times 2^-23, with room.
constexpr float kRounding = 2e-6f;

// A search that the surfaces' order starts takes so many likely facets.
constexpr size_t kMaxLikely = 5 * kLanes;
constexpr size_t kNeighbours = 2 * kLanes;

// A distance below this part of a triangle's size is mostly rounding.
constexpr float kFlat = 1e-4f;

// Of an error that is carried on, this part may be added to a distance without a closer look.
constexpr float kSlackOfCarried = kSlack - 1;

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
            add(facet);
    }

    void add(uint32_t facet)
    {
        if (list_of_facet_[facet] == list_ || facets_.size() == kMaxLikely)
            return;
        list_of_facet_[facet] = list_;
        facets_.push_back(facet);
    }

    std::span<const uint32_t> facets() const { return facets_; }

private:
    std::vector<uint32_t> list_of_facet_; ///< number of the last list that it was in
    uint32_t list_ = 0;
    std::vector<uint32_t> facets_;
};

std::vector<uint32_t> positionsOf(const GroupMesh& group, std::span<const uint32_t> wedges)
{
    std::vector<uint32_t> positions;
    positions.reserve(wedges.size());
    for (const uint32_t wedge : wedges)
        positions.push_back(group.position_of_wedge[wedge]);
    return positions;
}

/// The largest error of the facets at each position.
std::vector<float> errorsAtPositions(const Surface& surface, std::span<const float> errors)
{
    std::vector<float> largest(surface.place_of_position.size(), 0);
    for (size_t corner = 0; corner < surface.positions.size(); ++corner)
    {
        float& at = largest[surface.positions[corner]];
        at = std::max(at, errors[corner / 3]);
    }
    return largest;
}

/// An upper bound of what a triangle adds up to: the error that is carried, and its distance.
struct Total
{
    float upper;
    uint32_t triangle;
    bool before;

    bool operator<(const Total& b) const
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
    GroupMeasure(const GroupMesh& group, const Simplified& simplified)
        : group_(group),
          simplified_(simplified),
          before_(positionsOf(group, group.corners), group.positions),
          after_(positionsOf(group, simplified.corners), simplified.placement.places),
          sources_(NumberLists::byKey<1>(group.positions.size(), simplified.target_of_position)),
          open_(openPositions(group)),
          over_before_(before_, open_, errorsAtPositions(before_, group.errors)),
          over_after_(after_, open_, std::vector<float>(group.positions.size(), 0)),
          likely_before_(before_.facetCount()),
          likely_after_(after_.facetCount()),
          errors_(after_.facetCount(), 0),
          errors_at_(group.positions.size(), 0)
    {
    }

    Deviation run()
    {
        std::vector<uint8_t> unchanged(before_.facetCount(), 0);
        for (uint32_t t = 0; t < after_.facetCount(); ++t)
        {
            const uint32_t source = simplified_.source_triangle[t];
            if (movedCorner(source))
            {
                totals_.push_back({totalAfter(t), t, false});
                continue;
            }
            unchanged[source] = 1;
            errors_[t] = group_.errors[source];
        }
        for (uint32_t t = 0; t < before_.facetCount(); ++t)
            if (unchanged[t] == 0)
                totals_.push_back({totalBefore(t), t, true});
        takeTotals();
        for (size_t t = 0; t < errors_.size(); ++t)
        {
            for (size_t corner = t * 3; corner < t * 3 + 3; ++corner)
                give(static_cast<uint32_t>(t), errors_at_[after_.positions[corner]]);
            errors_[t] += kRounding;
        }
        return {std::move(errors_), std::move(after_), nearest_.loosePieces()};
    }

private:
    uint32_t targetOf(size_t corner) const
    {
        return simplified_.target_of_position[before_.positions[corner]];
    }

    bool movedCorner(size_t triangle) const
    {
        return moved(triangle * 3) || moved(triangle * 3 + 1) || moved(triangle * 3 + 2);
    }

    bool moved(size_t corner) const
    {
        const uint32_t target = targetOf(corner);
        return target != before_.positions[corner] || simplified_.placement.remade[target] != 0;
    }

    /// Largest first: once one needs no closer look, neither do the others. The largest of all rules most of them out.
    void takeTotals()
    {
        if (totals_.empty())
            return;
        std::iter_swap(std::max_element(totals_.begin(), totals_.end()), totals_.end() - 1);
        settle(totals_.back());
        totals_.pop_back();
        auto last =
            std::partition(totals_.begin(), totals_.end(), [&](const Total& t) { return t.upper > worst_; });
        for (const Total& total : std::span(last, totals_.end()))
            take(total);
        std::make_heap(totals_.begin(), last);
        for (; last != totals_.begin() && totals_.front().upper > worst_; --last)
        {
            settle(totals_.front());
            std::pop_heap(totals_.begin(), last);
        }
        for (const Total& total : std::span(totals_.begin(), last))
            take(total);
    }

    void settle(const Total& total)
    {
        if (isRounding(total))
            take(total);
        else
            total.before ? searchBefore(total.triangle) : searchAfter(total.triangle);
    }

    void take(const Total& total)
    {
        total.before ? giveTargets(total.triangle, total.upper) : give(total.triangle, total.upper);
        worst_ = std::max(worst_, total.upper);
    }

    /// On a plane there is nothing to search for: all distances are rounding.
    bool isRounding(const Total& total) const
    {
        const Surface& surface = total.before ? before_ : after_;
        const Corners corners = surface.cornersOf(total.triangle);
        const Float3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
        const float carried = total.before ? group_.errors[total.triangle] : 0.0f;
        return total.upper - carried <= kFlat * std::sqrt(std::max(dot(e1, e1), dot(e2, e2)));
    }

    void give(uint32_t facet, float error) { errors_[facet] = std::max(errors_[facet], error); }

    /// What the triangle stood for is beside the stars of its targets now.
    void giveTargets(uint32_t triangle, float error)
    {
        for (size_t corner = size_t{triangle} * 3; corner < size_t{triangle} * 3 + 3; ++corner)
        {
            float& at = errors_at_[targetOf(corner)];
            at = std::max(at, error);
        }
    }

    float totalBefore(size_t t)
    {
        over_after_.clear();
        for (size_t corner = t * 3; corner < t * 3 + 3; ++corner)
        {
            if (targetOf(corner) == kPruned)
                return kInfinity;
            over_after_.addCenter(targetOf(corner));
        }
        return group_.errors[t] + over_after_.heightOver(before_.cornersOf(t));
    }

    /// What lies over most triangles is beside the corners that they had and those that they have. For the others, all
    /// positions that went to a corner are looked around.
    float totalAfter(size_t t)
    {
        const size_t source = size_t{simplified_.source_triangle[t]} * 3;
        over_before_.clear();
        for (size_t k = 0; k < 3; ++k)
        {
            over_before_.addCenter(before_.positions[source + k]);
            over_before_.addCenter(after_.positions[t * 3 + k]);
        }
        const float total = over_before_.heightOver(after_.cornersOf(t));
        if (total < kInfinity)
            return total;
        over_before_.clear();
        for (size_t corner = t * 3; corner < t * 3 + 3; ++corner)
            for (const uint32_t position : sources_.of(after_.positions[corner]))
                over_before_.addCenter(position);
        return over_before_.heightOver(after_.cornersOf(t));
    }

    void searchBefore(uint32_t t)
    {
        const float carried = group_.errors[t];
        likely_after_.clear();
        for (size_t corner = size_t{t} * 3; corner < size_t{t} * 3 + 3; ++corner)
            if (const uint32_t target = targetOf(corner); target != kPruned && moved(corner))
                likely_after_.addAround(after_, target);
        if (likely_after_.facets().empty())
            addNeighboursInOrder(t);
        const float total = carried + nearest_.bound(before_.cornersOf(t), after_.index,
                                                     likely_after_.facets(), allowance(carried));
        for (const uint32_t facet : nearest_.used())
            give(facet, total);
        worst_ = std::max(worst_, total);
    }

    void searchAfter(uint32_t t)
    {
        float carried = 0;
        likely_before_.clear();
        const size_t source = simplified_.source_triangle[t];
        for (size_t corner = source * 3; corner < source * 3 + 3; ++corner)
            if (moved(corner))
                likely_before_.addAround(before_, before_.positions[corner]);
        for (const uint32_t facet : likely_before_.facets())
            carried = std::max(carried, group_.errors[facet]);
        const float distance =
            nearest_.bound(after_.cornersOf(t), before_.index, likely_before_.facets(), allowance(carried));
        carried = 0;
        for (const uint32_t facet : nearest_.used())
            carried = std::max(carried, group_.errors[facet]);
        give(t, carried + distance);
        worst_ = std::max(worst_, carried + distance);
    }

    /// Nothing is gained below the largest total that there is.
    Allowance allowance(float carried) const { return {worst_ - carried, carried * kSlackOfCarried}; }

    /// New triangles that were near an old one in the clusters' order: a fair guess for those of islands that are gone.
    void addNeighboursInOrder(size_t source)
    {
        const auto& left = simplified_.source_triangle;
        const auto after =
            static_cast<size_t>(std::lower_bound(left.begin(), left.end(), source) - left.begin());
        const size_t last_start = left.size() - std::min(left.size(), kNeighbours);
        const size_t start = std::min(after - std::min(after, kNeighbours / 2), last_start);
        for (size_t i = start; i < std::min(start + kNeighbours, left.size()); ++i)
            likely_after_.add(static_cast<uint32_t>(i));
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
    std::vector<Total> totals_;
    NearestBound nearest_;
    float worst_ = 0;              ///< the largest total so far, as far as it was searched
    std::vector<float> errors_;    ///< for each triangle after
    std::vector<float> errors_at_; ///< for each position after: what all triangles around it have at least
};

} // namespace

Deviation boundDeviation(const GroupMesh& group, const Simplified& simplified)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return GroupMeasure(group, simplified).run();
}

} // namespace hearth::clusters
