// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/box_search.h"

#include "cook/animation_bounds/region_chain.h"
#include "cook/animation_bounds/symmetric.h"

#include <algorithm>
#include <numeric>

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

// Cost of a node's time span, in influences of vertices.
constexpr size_t kNodeWork = 25;

using ActiveVertices = std::vector<uint16_t>;

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
    std::vector<uint32_t> movingNodes(std::span<const uint16_t> vertices) const
    {
        std::vector<uint32_t> nodes = chain_.linksTo(otherJoints(vertices));
        for (uint32_t& link : nodes)
            link = chain_.linkNode(link);
        return nodes;
    }

    /// Return the work of bounding all vertices.
    size_t fullWork() const { return kNodeWork * movingNodes(all()).size() + influences_.size(); }

    ActiveVertices all() const
    {
        ActiveVertices vertices(main_bone_terms_.size());
        std::iota(vertices.begin(), vertices.end(), uint16_t{0});
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

    /// Compute one box for each vertex over a region; false if there are no bounds.
    /// sampled  grows by positions that vertices certainly have in some pose
    bool place(const PoseRegion& region, std::span<const uint16_t> vertices, Box3d& sampled,
               std::vector<Box3d>& boxes, size_t& work)
    {
        const std::vector<uint32_t> joints = otherJoints(vertices), links = chain_.linksTo(joints);
        work += kNodeWork * links.size();
        if (!chain_.place(regions_, region, links, models_))
            return false;
        affine_.resize(joints_.size());
        for (const uint32_t joint : joints)
            affine_[joint] = inMain(models_[chain_.linkIndex(joint)]);
        boxes.clear();
        for (const uint16_t v : vertices)
        {
            const MainBoneTerm& own = main_bone_terms_[v];
            std::array<std::array<double, animation_bounds::kTerms>, 3> terms{};
            terms[0][0] = own.place.x;
            terms[1][0] = own.place.y;
            terms[2][0] = own.place.z;
            double slack = own.slack;
            for (size_t i = own.first; i < own.end; ++i)
            {
                const Influence& influence = influences_[i];
                addPosition(affine_[influence.joint], influence.place, influence.weight, terms);
                slack += bind_norm_ * influence.weight *
                         models_[chain_.linkIndex(influence.joint)].slackAt(influence.place);
            }
            work += own.end - own.first;
            Box3d box;
            for (size_t axis = 0; axis < 3; ++axis)
            {
                box[axis] = animation_bounds::polynomialRange(terms[axis]);
                box[axis].grow(slack);
                addCorners(terms[axis], slack, sampled[axis]);
            }
            boxes.push_back(box);
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

    /// Polynomials for the elements of an affine transform.
    using AffineTerms = std::array<std::array<std::array<double, animation_bounds::kTerms>, 4>, 3>;

    AffineTerms inMain(const TransformModel& model) const
    {
        const Affine3d& bind_from_main = *skin_.bindFromJoint(main_);
        AffineTerms affine;
        for (size_t term = 0; term < animation_bounds::kTerms; ++term)
        {
            const std::array<double, 9>& m = model.linear.terms[term];
            const std::array<double, 3>& place = model.place.terms[term];
            Affine3d transform;
            for (size_t row = 0; row < 3; ++row)
            {
                std::copy_n(&m[row * 3], 3, transform.m[row]);
                transform.m[row][3] = 0;
            }
            const Double3 shift =
                Double3{place[0], place[1], place[2]} - transformVector(transform, model.pivot);
            transform.m[0][3] = shift.x;
            transform.m[1][3] = shift.y;
            transform.m[2][3] = shift.z;
            for (size_t row = 0; row < 3; ++row)
                for (size_t column = 0; column < 4; ++column)
                {
                    double sum = term == 0 && column == 3 ? bind_from_main.m[row][3] : 0;
                    for (size_t k = 0; k < 3; ++k)
                        sum += bind_from_main.m[row][k] * transform.m[k][column];
                    affine[row][column][term] = sum;
                }
        }
        return affine;
    }

    static void addPosition(const AffineTerms& affine, Double3 point, double weight,
                            std::array<std::array<double, animation_bounds::kTerms>, 3>& terms)
    {
        const double x = point.x * weight, y = point.y * weight, z = point.z * weight;
        for (size_t axis = 0; axis < 3; ++axis)
            for (size_t term = 0; term < animation_bounds::kTerms; ++term)
                terms[axis][term] += affine[axis][0][term] * x + affine[axis][1][term] * y +
                                     affine[axis][2][term] * z + affine[axis][3][term] * weight;
    }

    /// Add the values of a polynomial, minus the slack, at the two corners where its linear part is largest
    /// and smallest.
    static void addCorners(const std::array<double, animation_bounds::kTerms>& terms, double slack,
                           Interval& sampled)
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
    std::vector<uint32_t> otherJoints(std::span<const uint16_t> vertices) const
    {
        std::vector<bool> moves(joints_.size());
        for (const uint16_t v : vertices)
            for (size_t i = main_bone_terms_[v].first; i < main_bone_terms_[v].end; ++i)
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
    std::vector<AffineTerms> affine_;
    std::vector<Affine3d> middles_;
};

void join(Box3d& box, const Box3d& other)
{
    for (size_t axis = 0; axis < 3; ++axis)
    {
        box[axis].add(other[axis].low);
        box[axis].add(other[axis].high);
    }
}

Box3d intersection(const Box3d& a, const Box3d& b)
{
    Box3d box;
    for (size_t axis = 0; axis < 3; ++axis)
        box[axis] = {std::max(a[axis].low, b[axis].low), std::min(a[axis].high, b[axis].high)};
    return box;
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

/// Unresolved region, with the vertices that may leave the box of the sampled poses there.
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
            const OpenRegion worst = std::move(open_.back());
            open_.pop_back();
            if (excess(worst.box, withTolerance(sampled_)) <= 0)
                continue;
            if (const auto split = regions_.split(worst.region, places_.movingNodes(worst.vertices)))
                for (const PoseRegion& half : *split)
                    examine({half, worst.vertices, worst.box, 0}, work);
            else
                join(sampled_, worst.box); // treat it as sampled: the region cannot be split further
        }
        return work;
    }

    Box3d box() const
    {
        if (!started_)
            return box_;
        Box3d result = withTolerance(sampled_);
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
        if (all.size() * places_.fullWork() > max_work / 2)
            return false;
        started_ = true;
        for (const PoseRegion& region : all)
            examine({region, places_.all(), box_, 0}, work);
        return true;
    }

    /// Queue a region, unless all of its vertices stay in the box of the sampled poses.
    void examine(OpenRegion region, size_t& work)
    {
        if (places_.place(region.region, region.vertices, sampled_, boxes_, work))
        {
            const Box3d enough = withTolerance(sampled_);
            ActiveVertices remaining;
            Box3d box;
            for (size_t i = 0; i < boxes_.size(); ++i)
                if (excess(boxes_[i], enough) > 0)
                {
                    remaining.push_back(region.vertices[i]);
                    join(box, boxes_[i]);
                }
            if (remaining.empty())
                return;
            region.vertices = std::move(remaining);
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
