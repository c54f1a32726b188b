// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface_points.h"

#include "cook/clusters/facet.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

namespace hearth::clusters
{

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class PointFinder
{
public:
    PointFinder(const GroupMesh& group, const Simplified& simplified, const Surface& after)
        : group_(group), simplified_(simplified), after_(after), facets_(after.facets)
    {
        points_.of_position.resize(group.positions.size());
        points_.of_wedge.resize(group.vertex_of_wedge.size());
    }

    SurfacePoints run()
    {
        findSeams();
        // wedges by where they went, in chains
        std::vector<uint32_t> head(group_.positions.size(), kNoWedge);
        std::vector<uint32_t> behind(points_.of_wedge.size());
        for (uint32_t wedge = 0; wedge < behind.size(); ++wedge)
        {
            const uint32_t position = group_.position_of_wedge[wedge];
            const uint32_t target = simplified_.target_of_position[position];
            if (target != kPruned && (position != target || simplified_.placement.remade[target] != 0))
                behind[wedge] = std::exchange(head[target], wedge);
        }
        for (uint32_t target = 0; target < head.size(); ++target)
        {
            if (head[target] == kNoWedge || after_.facets_at.of(target).empty())
                continue;
            load(after_.facets_at.of(target));
            for (uint32_t wedge = head[target]; wedge != kNoWedge; wedge = behind[wedge])
                locate(wedge, on_seam_[target] != 0);
        }
        return std::move(points_);
    }

private:
    static constexpr uint32_t kNoWedge = 0xFFFFFFFFu;

    void findSeams()
    {
        on_seam_.assign(group_.positions.size(), 0);
        if (group_.positions.size() == group_.vertex_of_wedge.size())
            return;
        std::vector<uint32_t> wedge_at(group_.positions.size(), kNoWedge);
        for (const uint32_t wedge : simplified_.corners)
        {
            uint32_t& first = wedge_at[group_.position_of_wedge[wedge]];
            if (first == kNoWedge)
                first = wedge;
            else if (first != wedge)
                on_seam_[group_.position_of_wedge[wedge]] = 1;
        }
    }

    void locate(uint32_t wedge, bool on_seam)
    {
        FacetPoint& nearest = points_.of_position[group_.position_of_wedge[wedge]];
        if (nearest.facet == kNoFacet)
            nearest = nearestPoint(group_.positions[group_.position_of_wedge[wedge]]);
        // inside a chart all of the fan goes on from facet to facet
        points_.of_wedge[wedge] = on_seam ? likeliestPoint(wedge) : nearest;
    }

    /// Four facets of the fan in a block; behind the last, that again.
    void load(std::span<const uint32_t> fan)
    {
        fan_ = fan;
        blocks_.clear();
        for (size_t first = 0; first < fan.size(); first += kLanes)
        {
            std::array<const Facet*, kLanes> block;
            for (size_t i = 0; i < kLanes; ++i)
                block[i] = &facets_[fan[std::min(first + i, fan.size() - 1)]];
            blocks_.push_back(makeBlock(block));
        }
    }

    FacetPoint nearestPoint(Float3 place) const
    {
        Lanes least = allLanes(kInfinity);
        Lanes v{}, w{};
        LaneMask blocks{};
        for (size_t block = 0; block < blocks_.size(); ++block)
        {
            const FacetBlock::Nearest nearest = blocks_[block].nearest(place);
            const LaneMask nearer = nearest.distance2 < least;
            least = nearer ? nearest.distance2 : least;
            v = nearer ? nearest.v : v;
            w = nearer ? nearest.w : w;
            blocks = nearer ? LaneMask{} + static_cast<int32_t>(block) : blocks;
        }
        size_t lane = 0;
        for (size_t i = 1; i < kLanes; ++i)
            if (least[i] < least[lane])
                lane = i;
        const size_t found = static_cast<size_t>(blocks[lane]) * kLanes + lane;
        return {fan_[std::min(found, fan_.size() - 1)], v[lane], w[lane], least[lane]};
    }

    /// The nearest point on each of the facets, and of these the nearest one with regard to the attributes as well: at a
    /// seam, that is on the wedge's own side.
    FacetPoint likeliestPoint(uint32_t wedge) const
    {
        const Float3 place = group_.positions[group_.position_of_wedge[wedge]];
        FacetPoint best{fan_.front()};
        float least = kInfinity;
        for (size_t block = 0; block < blocks_.size(); ++block)
        {
            const FacetBlock::Nearest nearest = blocks_[block].nearest(place);
            for (size_t i = 0; i < std::min(kLanes, fan_.size() - block * kLanes); ++i)
            {
                const FacetPoint point{fan_[block * kLanes + i], nearest.v[i], nearest.w[i],
                                       nearest.distance2[i]};
                const float cost = point.distance2 + attributeDistance2(wedge, point);
                if (cost < least)
                {
                    least = cost;
                    best = point;
                }
            }
        }
        return best;
    }

    float attributeDistance2(uint32_t wedge, const FacetPoint& point) const
    {
        const Lanes* before = group_.attributesOf(wedge);
        const Lanes* rows[3];
        for (size_t k = 0; k < 3; ++k)
            rows[k] = simplified_.placement.attributes.data() +
                      size_t{simplified_.corners[point.facet * 3 + k]} * group_.attribute_rows;
        const Lanes v = allLanes(point.v), w = allLanes(point.w), u = allLanes(1 - point.v - point.w);
        Lanes sum{};
        for (size_t row = 0; row < group_.attribute_rows; ++row)
        {
            const Lanes away = rows[0][row] * u + rows[1][row] * v + rows[2][row] * w - before[row];
            sum += away * away;
        }
        return sumOfLanes(sum);
    }

    const GroupMesh& group_;
    const Simplified& simplified_;
    const Surface& after_;
    std::span<const Facet> facets_;
    SurfacePoints points_;
    std::vector<uint8_t> on_seam_; ///< for each position: several wedges are left at it

    // around one position
    std::span<const uint32_t> fan_;
    std::vector<FacetBlock> blocks_;
};

} // namespace

SurfacePoints findPoints(const GroupMesh& group, const Simplified& simplified, const Surface& after)
{
    return PointFinder(group, simplified, after).run();
}

} // namespace hearth::clusters
