// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/box_search.h"

#include "cook/animation_bounds/region_chain.h"
#include "cook/animation_bounds/symmetric.h"

#include <algorithm>
#include <bit>

namespace hearth::skinning
{

using animation_bounds::Box3d;
using animation_bounds::Interval;
using animation_bounds::PoseRegion;
using animation_bounds::TransformModel;

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

// Cost of a node's time span, in influences of vertices along one axis.
constexpr size_t kNodeWork = 75;

/// Vertex with the axes along which it may leave the box of the sampled poses, a bit each.
struct ActiveVertex
{
    uint16_t vertex;
    uint8_t axes;

    bool isActive(size_t axis) const { return (axes >> axis & 1) != 0; }
};
using ActiveVertices = std::vector<ActiveVertex>;
constexpr uint8_t kAllAxes = 7;

/// Bounds of the positions of a cluster's vertices while poses stay in a region.
class RegionPositions
{
public:
    RegionPositions(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                    std::span<const MorphedVertex> vertices)
        : regions_(*deformation.regions),
          skin_(*deformation.skin),
          main_(main),
          joints_(otherJoints(main, cluster)),
          chain_(skin_.regionChain(main, joints_)),
          bind_norm_(animation_bounds::operatorNorm(*skin_.bindFromJoint(main)))
    {
        for (size_t v = 0; v < vertices.size(); ++v)
            addVertex(main, cluster, vertices[v], v);
    }

    /// Return the nodes that move some of the vertices.
    std::vector<uint32_t> movingNodes(std::span<const ActiveVertex> vertices) const
    {
        std::vector<uint32_t> nodes = chain_.linksTo(otherJoints(vertices));
        for (uint32_t& link : nodes)
            link = chain_.linkNode(link);
        return nodes;
    }

    /// Return the work of bounding all vertices.
    size_t fullWork() const { return kNodeWork * movingNodes(all()).size() + 3 * influences_.size(); }

    ActiveVertices all() const
    {
        ActiveVertices vertices;
        for (size_t v = 0; v < main_bone_terms_.size(); ++v)
            vertices.push_back({static_cast<uint16_t>(v), kAllAxes});
        return vertices;
    }

    /// Add the positions of the vertices in the middle of a region to `sampled`.
    void addMiddle(const PoseRegion& region, Box3d& sampled)
    {
        if (!chain_.middle(regions_, region, middles_))
            return;
        for (Affine3d& middle : middles_)
            middle = *skin_.bindFromJoint(main_) * middle;
        for (const MainBoneTerm& own : main_bone_terms_)
        {
            Double3 place = own.place;
            for (size_t i = own.first; i < own.end; ++i)
                place = place + transformPoint(middles_[influences_[i].joint], influences_[i].place) *
                                    influences_[i].weight;
            add(sampled, place);
        }
    }

    /// Compute one box for each vertex over a region, empty along axes that are not active; false if there
    /// are no bounds.
    /// sampled  grows by positions that vertices certainly have in some pose
    bool place(const PoseRegion& region, std::span<const ActiveVertex> vertices, Box3d& sampled,
               std::vector<Box3d>& boxes, size_t& work)
    {
        const std::vector<uint32_t> joints = otherJoints(vertices), links = chain_.linksTo(joints);
        work += kNodeWork * links.size();
        if (!chain_.place(regions_, region, links, models_))
            return false;
        motions_.resize(joints_.size());
        for (const uint32_t joint : joints)
            motions_[joint] = inMain(models_[chain_.linkIndex(joint)]);
        boxes.clear();
        for (const ActiveVertex& active : vertices)
        {
            boxes.push_back(boxAround(active, sampled));
            const MainBoneTerm& own = main_bone_terms_[active.vertex];
            work += (own.end - own.first) * static_cast<size_t>(std::popcount(active.axes));
        }
        return true;
    }

private:
    /// Joint that moves a vertex besides the main bone.
    struct Influence
    {
        uint32_t joint; ///< index into joints_
        double weight;
        Double3 place; ///< position of the vertex in the joint's space
    };
    /// Contribution of the main bone to a vertex.
    struct MainBoneTerm
    {
        Double3 place;
        double slack; ///< of morph targets
        size_t first; ///< index of its first influence
        size_t end;
    };

    using Polynomial = std::array<double, animation_bounds::kTerms>;

    /// Transform from a joint to the main bone's bind space.
    struct Motion
    {
        std::array<std::array<Polynomial, 4>, 3> elements; ///< of the affine transform
        Double3 pivot;
        double linear_slack; ///< distance from the polynomials, by distance from the pivot
        double point_slack;
    };

    Motion inMain(const TransformModel& model) const
    {
        const Affine3d& bind_from_main = *skin_.bindFromJoint(main_);
        std::array<std::array<Polynomial, 4>, 3> elements; // in the main bone's node
        for (size_t term = 0; term < animation_bounds::kTerms; ++term)
            for (size_t row = 0; row < 3; ++row)
            {
                const double* const m = &model.linear.terms[term][row * 3];
                for (size_t column = 0; column < 3; ++column)
                    elements[row][column][term] = m[column];
                elements[row][3][term] = model.place.terms[term][row] -
                                         (m[0] * model.pivot.x + m[1] * model.pivot.y + m[2] * model.pivot.z);
            }
        Motion motion{
            {}, model.pivot, bind_norm_ * model.linear.remainder, bind_norm_ * model.place.remainder};
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 4; ++column)
            {
                const double(&m)[4] = bind_from_main.m[row];
                for (size_t term = 0; term < animation_bounds::kTerms; ++term)
                    motion.elements[row][column][term] = m[0] * elements[0][column][term] +
                                                         m[1] * elements[1][column][term] +
                                                         m[2] * elements[2][column][term];
            }
        for (size_t row = 0; row < 3; ++row)
            motion.elements[row][3][0] += bind_from_main.m[row][3];
        return motion;
    }

    Box3d boxAround(const ActiveVertex& active, Box3d& sampled) const
    {
        const MainBoneTerm& own = main_bone_terms_[active.vertex];
        const std::span<const Influence> influences =
            std::span(influences_).subspan(own.first, own.end - own.first);
        double slack = own.slack;
        for (const Influence& influence : influences)
        {
            const Motion& motion = motions_[influence.joint];
            slack += influence.weight *
                     (motion.linear_slack * length(influence.place - motion.pivot) + motion.point_slack);
        }
        const double places[3] = {own.place.x, own.place.y, own.place.z};
        Box3d box;
        for (size_t axis = 0; axis < 3; ++axis)
        {
            if (!active.isActive(axis))
                continue;
            Polynomial terms{places[axis]};
            for (const Influence& influence : influences)
                addPosition(motions_[influence.joint].elements[axis], influence, terms);
            box[axis] = animation_bounds::polynomialRange(terms);
            box[axis].grow(slack);
            addCorners(terms, slack, sampled[axis]);
        }
        return box;
    }

    /// Add the coordinate of a vertex along one axis, times its weight.
    static void addPosition(const std::array<Polynomial, 4>& row, const Influence& influence,
                            Polynomial& terms)
    {
        const double weight = influence.weight;
        const Double3 point = influence.place * weight;
        for (size_t term = 0; term < animation_bounds::kTerms; ++term)
            terms[term] += row[0][term] * point.x + row[1][term] * point.y + row[2][term] * point.z +
                           row[3][term] * weight;
    }

    /// Add the values of a polynomial, minus the slack, at the two corners where its linear part is largest
    /// and smallest.
    static void addCorners(const Polynomial& terms, double slack, Interval& sampled)
    {
        const auto side = [&](size_t a)
        { return terms[animation_bounds::kFirstLinear + a] < 0 ? -1.0 : 1.0; };
        double even = terms[0] + terms[4] + terms[5] + terms[6];
        for (size_t a = 0; a < 3; ++a)
            for (size_t b = a + 1; b < 3; ++b)
                even += side(a) * side(b) * terms[animation_bounds::termIndex(a, b)];
        const double linear = std::abs(terms[1]) + std::abs(terms[2]) + std::abs(terms[3]);
        sampled.high = std::max(sampled.high, even + linear - slack);
        sampled.low = std::min(sampled.low, even - linear + slack);
    }

    /// Return the indices of the joints_ that move some of the vertices.
    std::vector<uint32_t> otherJoints(std::span<const ActiveVertex> vertices) const
    {
        std::vector<bool> moves(joints_.size());
        for (const ActiveVertex& active : vertices)
            for (size_t i = main_bone_terms_[active.vertex].first; i < main_bone_terms_[active.vertex].end;
                 ++i)
                moves[influences_[i].joint] = true;
        std::vector<uint32_t> joints;
        for (uint32_t joint = 0; joint < joints_.size(); ++joint)
            if (moves[joint])
                joints.push_back(joint);
        return joints;
    }

    static std::vector<uint32_t> otherJoints(uint32_t main, const DeformedCluster& cluster)
    {
        std::vector<uint32_t> joints;
        for (size_t i = 0; i < cluster.joints.size(); ++i)
            if (cluster.weights[i] > 0 && cluster.joints[i] != main)
                joints.push_back(cluster.joints[i]);
        std::sort(joints.begin(), joints.end());
        joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
        return joints;
    }

    void addVertex(uint32_t main, const DeformedCluster& cluster, const MorphedVertex& vertex, size_t v)
    {
        const double own_weight = jointWeight(cluster, v, main);
        const size_t first = influences_.size();
        double stretch = own_weight;
        for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
        {
            const uint32_t joint = cluster.joints[i];
            if (!(cluster.weights[i] > 0) || joint == main)
                continue;
            const auto at = std::lower_bound(joints_.begin(), joints_.end(), joint);
            influences_.push_back({static_cast<uint32_t>(at - joints_.begin()), cluster.weights[i],
                                   transformPoint(skin_.jointFromBind(joint), vertex.middle)});
            stretch += cluster.weights[i] * skin_.relative(main, joint)->set().norm;
        }
        main_bone_terms_.push_back(
            {vertex.middle * own_weight, length(vertex.half) * stretch, first, influences_.size()});
    }

    const animation_bounds::PoseRegions& regions_;
    const animation_bounds::SkinMotion& skin_;
    uint32_t main_;
    std::vector<uint32_t> joints_;
    animation_bounds::RegionChain chain_;
    double bind_norm_;
    std::vector<Influence> influences_;
    std::vector<MainBoneTerm> main_bone_terms_;
    std::vector<TransformModel> models_;
    std::vector<Motion> motions_; ///< by index into joints_
    std::vector<Affine3d> middles_;
};

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

    bool done() const { return started_ && (open_.empty() || tight_); }

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
        const std::vector<uint32_t> nodes = places_.movingNodes(whole.vertices);
        const auto halves = regions_.split(whole.region, nodes);
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

    /// Queue a region, unless all of its vertices stay in the box of the sampled poses.
    void examine(OpenRegion region, size_t& work)
    {
        if (regions_.isMirrored(region.region))
            return;
        if (places_.place(region.region, region.vertices, sampled_, boxes_, work))
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
    size_t regions_since_check_ = 0;
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

size_t BoxSearch::run(size_t max_work)
{
    return regions_->run(max_work);
}

Box3d BoxSearch::box() const
{
    return regions_->box();
}

} // namespace hearth::skinning
