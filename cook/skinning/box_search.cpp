// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/box_search.h"

#include "cook/skinning/region_positions.h"

#include <algorithm>

namespace hearth::skinning
{

using animation_bounds::Box3d;
using animation_bounds::Interval;
using animation_bounds::PoseRegion;

namespace
{

// Tolerance: a box is tight enough if no side exceeds the box of the sampled poses by more than this share:
// 1.08^3 = 1.26 of the smallest box's volume.
constexpr double kBoxTolerance = 0.04;

// Volume relative to the box of the sampled poses below which a box is not tightened.
constexpr double kLooseVolume = 1.5;

// Volume relative to the box of the sampled poses at which tightening ends; remaining work goes to looser
// boxes.
constexpr double kTightVolume = 1.3;

// Number of regions between two checks of the volume.
constexpr size_t kRegionsBetweenChecks = 200;

// Number of poses that are sampled before the search.
constexpr size_t kSamples = 24;

/// Extend an interval by another one; either may be empty.
void join(Interval& interval, const Interval& other)
{
    interval.low = std::min(interval.low, other.low);
    interval.high = std::max(interval.high, other.high);
}

void join(Box3d& box, const Box3d& other)
{
    for (size_t axis = 0; axis < 3; ++axis)
        join(box[axis], other[axis]);
}

Box3d intersection(const Box3d& a, const Box3d& b)
{
    Box3d box;
    for (size_t axis = 0; axis < 3; ++axis)
        box[axis] = {std::max(a[axis].low, b[axis].low), std::min(a[axis].high, b[axis].high)};
    return box;
}

bool isInside(const Interval& inner, const Interval& outer)
{
    return inner.low >= outer.low && inner.high <= outer.high;
}

/// Return the largest excess of `box` over `sampled`, as a share of the side.
double excess(const Box3d& box, const Box3d& sampled)
{
    double share = 0;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        const double side = 2 * sampled[axis].half() + 1e-6 * sampled[axis].magnitude() + 1e-30;
        share = std::max({share, (sampled[axis].low - box[axis].low) / side,
                          (box[axis].high - sampled[axis].high) / side});
    }
    return share;
}

/// Return the box of the sampled poses with the tolerance: vertices inside it need no further search.
Box3d withTolerance(const Box3d& sampled)
{
    Box3d box = sampled;
    for (Interval& axis : box)
        axis.grow(kBoxTolerance * (2 * axis.half() + 1e-6 * axis.magnitude()));
    return box;
}

double volume(const Box3d& box)
{
    // treat flat boxes as a thousandth of their size thick
    const Double3 h = half(box);
    const double least = 1e-3 * std::max({h.x, h.y, h.z});
    return std::max(h.x, least) * std::max(h.y, least) * std::max(h.z, least);
}

/// Unresolved region, with the vertices that may leave the box of the sampled poses there. The box contains
/// their positions along their active axes; other axes may be empty.
struct OpenRegion
{
    PoseRegion region;
    ActiveVertices vertices;
    Box3d box;
    double excess = 0;

    friend bool operator<(const OpenRegion& a, const OpenRegion& b) { return a.excess < b.excess; }
};

} // namespace

class BoxSearch::Regions
{
public:
    Regions(const Box3d& box, uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
            std::span<const MorphedVertex> vertices)
        : places_(main, cluster, deformation, vertices), regions_(*deformation.regions), box_(box)
    {
        for (size_t i = 0; i < kSamples; ++i)
            places_.addMiddle(regions_.sample(i), sampled_);
    }

    bool isLoose() const { return sampled_[0].empty() || volume(box_) > kLooseVolume * volume(sampled_); }

    bool done() const { return started_ && (open_.empty() || tight_ || given_up_); }

    void giveUp() { given_up_ = true; }

    double relativeVolume() const { return volume(box()) / volume(sampled_); }

    size_t run(size_t max_work)
    {
        size_t work = 0;
        if (!started_ && !start(max_work, work))
            return work;
        while (!done() && work < max_work)
        {
            if (++regions_since_check_ == kRegionsBetweenChecks)
            {
                regions_since_check_ = 0;
                tight_ = volume(box()) < kTightVolume * volume(sampled_);
            }
            std::pop_heap(open_.begin(), open_.end());
            OpenRegion worst = std::move(open_.back());
            open_.pop_back();
            resolveAxes(worst);
            if (!worst.vertices.empty())
                examineHalves(worst, work);
        }
        return work;
    }

    Box3d box() const
    {
        if (!started_)
            return box_;
        Box3d result = resolved_;
        for (const OpenRegion& open : open_)
            join(result, open.box);
        return intersection(result, box_);
    }

private:
    /// Examine each root once, unless that costs too much because of many clips or many clusters that share
    /// the work.
    bool start(size_t max_work, size_t& work)
    {
        const std::vector<PoseRegion> all = regions_.all();
        if (all.size() * places_.fullWork() > max_work)
            return false;
        started_ = true;
        places_.findMovers(places_.all(), movers_);
        for (const PoseRegion& region : all)
            examine({region, places_.all(), box_, 0}, work);
        return true;
    }

    /// Resolve the axes along which a region's vertices stay in the box of the sampled poses.
    void resolveAxes(OpenRegion& region)
    {
        const Box3d enough = withTolerance(sampled_);
        uint8_t axes = 0;
        for (size_t axis = 0; axis < 3; ++axis)
            if (isInside(region.box[axis], enough[axis]))
                join(resolved_[axis], region.box[axis]);
            else
                axes = static_cast<uint8_t>(axes | 1u << axis);
        for (ActiveVertex& active : region.vertices)
            active.axes &= axes;
        std::erase_if(region.vertices, [](const ActiveVertex& active) { return active.axes == 0; });
    }

    /// Split a region and examine its halves.
    void examineHalves(const OpenRegion& whole, size_t& work)
    {
        places_.findMovers(whole.vertices, movers_);
        const auto halves = regions_.split(whole.region, movers_.nodes);
        if (!halves)
        {
            // treat it as sampled: the region cannot be split further
            join(sampled_, whole.box);
            join(resolved_, whole.box);
            return;
        }
        for (const PoseRegion& half : *halves)
            examine({half, whole.vertices, whole.box, 0}, work);
    }

    /// Queue a region, unless all of its vertices stay in the box of the sampled poses. Its vertices are
    /// moved by movers_.
    void examine(OpenRegion region, size_t& work)
    {
        if (regions_.isMirrored(region.region))
            return;
        if (places_.place(region.region, region.vertices, movers_, sampled_, boxes_, work))
        {
            const Box3d enough = withTolerance(sampled_);
            Box3d box;
            for (size_t i = 0; i < boxes_.size(); ++i)
                for (size_t axis = 0; axis < 3; ++axis)
                {
                    const bool is_resolved = isInside(boxes_[i][axis], enough[axis]);
                    join(is_resolved ? resolved_[axis] : box[axis], boxes_[i][axis]);
                    if (is_resolved)
                        region.vertices[i].axes &= static_cast<uint8_t>(~(1u << axis));
                }
            std::erase_if(region.vertices, [](const ActiveVertex& active) { return active.axes == 0; });
            if (region.vertices.empty())
                return;
            region.box = intersection(region.box, box);
        }
        region.excess = excess(region.box, sampled_);
        open_.push_back(std::move(region));
        std::push_heap(open_.begin(), open_.end());
    }

    RegionPositions places_;
    const animation_bounds::PoseRegions& regions_;
    Box3d box_;
    Box3d sampled_;
    Box3d resolved_; ///< contains all positions outside of the open regions
    bool started_ = false;
    bool tight_ = false;
    bool given_up_ = false;
    size_t regions_since_check_ = 0;
    Movers movers_;
    std::vector<Box3d> boxes_;
    std::vector<OpenRegion> open_; ///< heap, the worst first
};

BoxSearch::BoxSearch(const Box3d& box, uint32_t main, const DeformedCluster& cluster,
                     const Deformation& deformation, std::span<const MorphedVertex> vertices)
    : regions_(std::make_unique<Regions>(box, main, cluster, deformation, vertices))
{
}
BoxSearch::BoxSearch(BoxSearch&&) noexcept = default;
BoxSearch& BoxSearch::operator=(BoxSearch&&) noexcept = default;
BoxSearch::~BoxSearch() = default;

bool BoxSearch::isLoose() const
{
    return regions_->isLoose();
}

bool BoxSearch::done() const
{
    return regions_->done();
}

void BoxSearch::giveUp()
{
    regions_->giveUp();
}

double BoxSearch::relativeVolume() const
{
    return regions_->relativeVolume();
}

size_t BoxSearch::run(size_t max_work)
{
    return regions_->run(max_work);
}

Box3d BoxSearch::box() const
{
    return regions_->box();
}

} // namespace hearth::skinning
