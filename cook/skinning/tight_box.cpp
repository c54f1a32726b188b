// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/tight_box.h"

#include "cook/motion/region_chain.h"
#include "cook/motion/symmetric.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace hearth::skinning
{

using motion::Box3d;
using motion::Interval;
using motion::MatrixBall;
using motion::PoseRegion;

namespace
{

// A box is good enough when no side is more than this share of it beyond what the cluster reaches in poses that were
// looked at: 1.08^3 = 1.26 of the smallest box's volume.
constexpr double kGoodEnough = 0.04;

// Boxes of less than this times the volume of what was looked at stay as they are.
constexpr double kLooseVolume = 1.5;

// Poses that are looked at before.
constexpr size_t kSamples = 24;

// A node's span costs as much as so many influences of vertices.
constexpr size_t kWorkOfNode = 25;

using ActiveVertices = std::vector<uint16_t>;

/// Where the vertices of a cluster are while poses stay in a region.
class RegionPlaces
{
public:
    RegionPlaces(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                 std::span<const MorphedVertex> vertices)
        : regions_(*deformation.regions),
          skin_(*deformation.skin),
          main_(main),
          joints_(jointsOf(main, cluster)),
          chain_(skin_.regionChain(main, joints_)),
          bind_norm_(motion::operatorNorm(*skin_.bindFromJoint(main)))
    {
        for (size_t v = 0; v < vertices.size(); ++v)
            addVertex(main, cluster, vertices[v], v);
    }

    std::span<const uint32_t> nodes() const { return chain_.nodes(); }

    /// Of placing all vertices.
    size_t workOfAll() const { return kWorkOfNode * chain_.nodes().size() + influences_.size(); }

    ActiveVertices all() const
    {
        ActiveVertices vertices(owns_.size());
        std::iota(vertices.begin(), vertices.end(), uint16_t{0});
        return vertices;
    }

    /// Where vertices can be in a region, one box for each; false where there are no bounds.
    /// reached  grows by where the middle of the region puts them
    bool place(const PoseRegion& region, std::span<const uint16_t> vertices, Box3d& reached,
               std::vector<Box3d>& boxes, size_t& work)
    {
        work += kWorkOfNode * chain_.nodes().size();
        if (!chain_.place(regions_, region, balls_))
            return false;
        centers_.clear();
        for (const MatrixBall& ball : balls_)
            centers_.push_back(*skin_.bindFromJoint(main_) * ball.center);
        boxes.clear();
        for (const uint16_t v : vertices)
        {
            const Own& own = owns_[v];
            Double3 place = own.place;
            double slack = own.slack;
            for (size_t i = own.first; i < own.end; ++i)
            {
                const Influence& influence = influences_[i];
                place = place + transformPoint(centers_[influence.joint], influence.place) * influence.weight;
                slack += bind_norm_ * influence.weight * balls_[influence.joint].slackAt(influence.place);
            }
            work += own.end - own.first;
            add(reached, place);
            Box3d box;
            add(box, place - Double3{slack, slack, slack});
            add(box, place + Double3{slack, slack, slack});
            boxes.push_back(box);
        }
        return true;
    }

private:
    /// A joint that moves a vertex besides the main bone.
    struct Influence
    {
        size_t joint; ///< of joints_
        double weight;
        Double3 place; ///< of the vertex, in the joint
    };
    /// What the main bone does to a vertex.
    struct Own
    {
        Double3 place;
        double slack; ///< of morph targets
        size_t first; ///< of its influences
        size_t end;
    };

    static std::vector<uint32_t> jointsOf(uint32_t main, const DeformedCluster& cluster)
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
        const double own_weight = weightOf(cluster, v, main);
        const size_t first = influences_.size();
        double stretch = own_weight;
        for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
        {
            const uint32_t joint = cluster.joints[i];
            if (!(cluster.weights[i] > 0) || joint == main)
                continue;
            const auto at = std::lower_bound(joints_.begin(), joints_.end(), joint);
            influences_.push_back({static_cast<size_t>(at - joints_.begin()), cluster.weights[i],
                                   transformPoint(skin_.jointFromBind(joint), vertex.middle)});
            stretch += cluster.weights[i] * skin_.relative(main, joint)->set().norm;
        }
        owns_.push_back(
            {vertex.middle * own_weight, length(vertex.half) * stretch, first, influences_.size()});
    }

    const motion::PoseRegions& regions_;
    const motion::SkinMotion& skin_;
    uint32_t main_;
    std::vector<uint32_t> joints_;
    motion::RegionChain chain_;
    double bind_norm_;
    std::vector<Influence> influences_;
    std::vector<Own> owns_;
    std::vector<MatrixBall> balls_;
    std::vector<Affine3d> centers_;
};

void join(Box3d& box, const Box3d& other)
{
    for (size_t axis = 0; axis < 3; ++axis)
    {
        box[axis].add(other[axis].low);
        box[axis].add(other[axis].high);
    }
}

Box3d common(const Box3d& a, const Box3d& b)
{
    Box3d box;
    for (size_t axis = 0; axis < 3; ++axis)
        box[axis] = {std::max(a[axis].low, b[axis].low), std::min(a[axis].high, b[axis].high)};
    return box;
}

/// The largest share of a side by which `box` is outside of `reached`.
double beyond(const Box3d& box, const Box3d& reached)
{
    double share = 0;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        const double side = 2 * reached[axis].half() + 1e-6 * reached[axis].magnitude() + 1e-30;
        share = std::max({share, (reached[axis].low - box[axis].low) / side,
                          (box[axis].high - reached[axis].high) / side});
    }
    return share;
}

/// What was looked at and a little more: vertices inside are good enough.
Box3d grown(const Box3d& reached)
{
    Box3d box = reached;
    for (Interval& axis : box)
        axis.grow(kGoodEnough * (2 * axis.half() + 1e-6 * axis.magnitude()));
    return box;
}

double volume(const Box3d& box)
{
    // flat ones are a thousandth thick
    const Double3 h = half(box);
    const double least = 1e-3 * std::max({h.x, h.y, h.z});
    return std::max(h.x, least) * std::max(h.y, least) * std::max(h.z, least);
}

/// A region, and the vertices that may get beyond what was looked at there.
struct Open
{
    PoseRegion region;
    ActiveVertices vertices;
    Box3d box;
    double beyond = 0;

    friend bool operator<(const Open& a, const Open& b) { return a.beyond < b.beyond; }
};

/// Looks for the smallest box, the worst region first.
class Search
{
public:
    Search(RegionPlaces& places, const motion::PoseRegions& regions, const Box3d& box)
        : places_(places), regions_(regions), box_(box)
    {
    }

    const Box3d& reached() const { return reached_; }

    /// Look at a pose in each of a few small regions.
    void sample()
    {
        const ActiveVertices all = places_.all();
        size_t work = 0;
        for (size_t i = 0; i < kSamples; ++i)
            places_.place(regions_.sample(i), all, reached_, boxes_, work);
    }

    Box3d run(size_t most_work)
    {
        size_t work = 0;
        const std::vector<PoseRegion> all = regions_.all();
        // looking at each once already costs too much: many clips, or many clusters that ask
        if (all.size() * places_.workOfAll() > most_work / 2)
            return box_;
        for (const PoseRegion& region : all)
            look({region, places_.all(), box_, 0}, work);
        Box3d rest; // of regions that cannot be cut
        while (!open_.empty() && work < most_work)
        {
            const Open worst = open_.top();
            open_.pop();
            if (const auto halves = regions_.halves(worst.region, places_.nodes()))
                for (const PoseRegion& half : *halves)
                    look({half, worst.vertices, worst.box, 0}, work);
            else
                join(rest, worst.box);
        }
        Box3d result = grown(reached_);
        if (!rest[0].empty())
            join(result, rest);
        for (; !open_.empty(); open_.pop())
            join(result, open_.top().box);
        return common(result, box_);
    }

private:
    /// Put a region among the open ones, unless all of its vertices stay where others were.
    void look(Open region, size_t& work)
    {
        if (places_.place(region.region, region.vertices, reached_, boxes_, work))
        {
            const Box3d enough = grown(reached_);
            ActiveVertices still;
            Box3d box;
            for (size_t i = 0; i < boxes_.size(); ++i)
                if (beyond(boxes_[i], enough) > 0)
                {
                    still.push_back(region.vertices[i]);
                    join(box, boxes_[i]);
                }
            if (still.empty())
                return;
            region.vertices = std::move(still);
            region.box = common(region.box, box);
        }
        region.beyond = beyond(region.box, reached_);
        open_.push(std::move(region));
    }

    RegionPlaces& places_;
    const motion::PoseRegions& regions_;
    Box3d box_;
    Box3d reached_;
    std::vector<Box3d> boxes_;
    std::priority_queue<Open> open_;
};

} // namespace

bool isLoose(const Box3d& box, uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
             std::span<const MorphedVertex> vertices)
{
    RegionPlaces places(main, cluster, deformation, vertices);
    Search search(places, *deformation.regions, box);
    search.sample();
    return search.reached()[0].empty() || volume(box) > kLooseVolume * volume(search.reached());
}

Box3d tightened(const Box3d& box, uint32_t main, const DeformedCluster& cluster,
                const Deformation& deformation, std::span<const MorphedVertex> vertices, size_t work)
{
    RegionPlaces places(main, cluster, deformation, vertices);
    Search search(places, *deformation.regions, box);
    search.sample();
    return search.run(work);
}

} // namespace hearth::skinning
