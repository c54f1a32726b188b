// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/region_positions.h"

#include "cook/animation_bounds/symmetric.h"

#include <algorithm>
#include <bit>

namespace hearth::skinning
{

using namespace animation_bounds;

namespace
{

// Cost of a node's time span, in influences of vertices along one axis.
constexpr size_t kNodeWork = 75;

constexpr uint8_t kAllAxes = 7;

std::vector<uint32_t> otherJoints(uint32_t main, const DeformedCluster& cluster)
{
    std::vector<uint32_t> joints;
    for (size_t i = 0; i < cluster.joints.size(); ++i)
        if (cluster.weights[i] > 0 && cluster.joints[i] != main)
            joints.push_back(cluster.joints[i]);
    std::sort(joints.begin(), joints.end());
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
    return joints;
}

/// Ranges of four polynomials, with slack, and values that they certainly have.
struct FourRanges
{
    Four low, high;
    Four certain_low, certain_high;
};

/// Return the largest value of c + l x + m01 x0 x1 + m02 x0 x2 + m12 x1 x2, which is at a corner.
HEARTH_INLINE inline void addCornerRange(const Four (&l)[3], const Four (&m)[3], double sign, Four& result)
{
    Four best{};
    for (size_t corner = 0; corner < 4; ++corner)
    {
        const double s0 = corner == 3 ? -1 : 1, s1 = corner == 2 ? -1 : 1, s2 = corner == 1 ? -1 : 1;
        const Four odd = s0 * l[0] + s1 * l[1] + s2 * l[2];
        Four size;
        setAbsolute(odd, size);
        const Four value = sign * (s0 * s1 * m[0] + s0 * s2 * m[1] + s1 * s2 * m[2]) + size;
        best = corner == 0 || value > best ? value : best;
    }
    result += sign * best;
}

HEARTH_INLINE inline void computeRanges(const Four* terms, const Four& slack, FourRanges& ranges)
{
    const Four zero{}, one = zero + 1;
    Four low = terms[0], high = terms[0], sides[3], sizes[3], low_slopes[3], high_slopes[3];
    for (size_t i = 0; i < 3; ++i)
    {
        const Four linear = terms[kFirstLinear + i], square = terms[kFirstQuadratic + i];
        Four steepness;
        setAbsolute(linear, sizes[i]);
        setAbsolute(square, steepness);
        sides[i] = linear < zero ? -one : one;
        // tangent at the peak in [-1, 1], on the side where the square bends inwards
        const auto has_peak = 2.0 * steepness > sizes[i];
        const Four peak =
            has_peak ? -0.5 * linear / (has_peak ? square : one) : (square < zero ? sides[i] : -sides[i]);
        const Four tangent_slope = has_peak ? zero : linear + 2.0 * square * peak;
        const Four tangent_constant = -square * peak * peak;
        const auto is_concave = square < zero;
        high += is_concave ? tangent_constant : square;
        high_slopes[i] = is_concave ? tangent_slope : linear;
        low += is_concave ? square : tangent_constant;
        low_slopes[i] = is_concave ? linear : tangent_slope;
    }
    const Four mixed[3] = {terms[7], terms[8], terms[9]};
    addCornerRange(high_slopes, mixed, 1, high);
    addCornerRange(low_slopes, mixed, -1, low);
    ranges.low = low - slack;
    ranges.high = high + slack;
    Four even = terms[0] + terms[4] + terms[5] + terms[6];
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = a + 1; b < 3; ++b)
            even += sides[a] * sides[b] * terms[termIndex(a, b)];
    const Four linear_sum = sizes[0] + sizes[1] + sizes[2];
    ranges.certain_low = even - linear_sum + slack;
    ranges.certain_high = even + linear_sum - slack;
}

} // namespace

/// Loops over vertices and joints that are worth wide vectors.
struct RegionPositions::Kernels
{
    /// Add the coordinates of a vertex along one axis by all its influences.
    HEARTH_INLINE static void addPositions(std::span<const Influence> influences, const Motion* motions,
                                           size_t axis, Polynomial& sum)
    {
        Four sum0 = sum[0], sum1 = sum[1], sum2 = sum[2];
        for (const Influence& influence : influences)
        {
            const std::array<Polynomial, 4>& row = motions[influence.joint].elements[axis];
            const auto& [x, y, z, weight] = influence.point;
            sum0 += row[0][0] * x + row[1][0] * y + row[2][0] * z + row[3][0] * weight;
            sum1 += row[0][1] * x + row[1][1] * y + row[2][1] * z + row[3][1] * weight;
            sum2 += row[0][2] * x + row[1][2] * y + row[2][2] * z + row[3][2] * weight;
        }
        sum = {sum0, sum1, sum2};
    }

    /// Compute the elements of a motion along some axes.
    HEARTH_INLINE static void setElements(const Affine3d& bind_from_main, const TransformModel& model,
                                          uint8_t axes, Motion& motion)
    {
        std::array<std::array<Polynomial, 4>, 3> elements{}; // in the main bone's node
        for (size_t term = 0; term < kTerms; ++term)
            for (size_t row = 0; row < 3; ++row)
            {
                const double* const m = &model.linear.terms[term][row * 3];
                for (size_t column = 0; column < 3; ++column)
                    elements[row][column][term / 4][term % 4] = m[column];
                elements[row][3][term / 4][term % 4] =
                    model.place.terms[term][row] -
                    (m[0] * model.pivot.x + m[1] * model.pivot.y + m[2] * model.pivot.z);
            }
        for (size_t row = 0; row < 3; ++row)
        {
            if ((axes >> row & 1) == 0)
                continue;
            const double(&m)[4] = bind_from_main.m[row];
            for (size_t column = 0; column < 4; ++column)
                for (size_t part = 0; part < 3; ++part)
                    motion.elements[row][column][part] = m[0] * elements[0][column][part] +
                                                         m[1] * elements[1][column][part] +
                                                         m[2] * elements[2][column][part];
            motion.elements[row][3][0][0] += m[3];
        }
    }

    /// Compute the boxes of vertices along one axis.
    /// slacks  by active vertex
    HEARTH_INLINE static void bound(const RegionPositions& positions, std::span<const ActiveVertex> vertices,
                                    size_t axis, Interval& sampled, std::span<Box3d> boxes)
    {
        Polynomial sums[4] = {};
        Four slacks{};
        size_t group[4], count = 0; // vertices that are waiting
        for (size_t i = 0; i <= vertices.size(); ++i)
        {
            if (i < vertices.size())
            {
                if (!vertices[i].isActive(axis))
                    continue;
                const MainBoneTerm& own = positions.main_bone_terms_[vertices[i].vertex];
                sums[count] = {Four{own.place[axis], 0, 0, 0}};
                addPositions(std::span(positions.influences_).subspan(own.first, own.end - own.first),
                             positions.motions_.data(), axis, sums[count]);
                slacks[count] = positions.slacks_[i];
                group[count++] = i;
                if (count < 4)
                    continue;
            }
            Four terms[12];
            for (size_t part = 0; part < 3; ++part)
                transpose(sums[0][part], sums[1][part], sums[2][part], sums[3][part], &terms[4 * part]);
            FourRanges ranges;
            computeRanges(terms, slacks, ranges);
            for (size_t k = 0; k < count; ++k)
            {
                boxes[group[k]][axis] = {ranges.low[k], ranges.high[k]};
                sampled.low = std::min(sampled.low, ranges.certain_low[k]);
                sampled.high = std::max(sampled.high, ranges.certain_high[k]);
            }
            count = 0;
        }
    }
};

RegionPositions::RegionPositions(uint32_t main, const DeformedCluster& cluster,
                                 const Deformation& deformation, std::span<const MorphedVertex> vertices)
    : regions_(*deformation.regions),
      skin_(*deformation.skin),
      main_(main),
      joints_(otherJoints(main, cluster)),
      chain_(skin_.regionChain(main, joints_)),
      bind_norm_(operatorNorm(*skin_.bindFromJoint(main))),
      influences_of_joints_(joints_.size()),
      pivots_(joints_.size()),
      joint_set_words_((joints_.size() + 63) / 64)
{
    for (size_t v = 0; v < vertices.size(); ++v)
        addVertex(main, cluster, vertices[v], v);
}

void RegionPositions::addVertex(uint32_t main, const DeformedCluster& cluster, const MorphedVertex& vertex,
                                size_t v)
{
    const double own_weight = jointWeight(cluster, v, main);
    const size_t first = influences_.size(), first_word = joint_sets_.size();
    joint_sets_.resize(first_word + joint_set_words_);
    double stretch = own_weight;
    for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
    {
        const uint32_t joint = cluster.joints[i];
        const double weight = cluster.weights[i];
        if (!(weight > 0) || joint == main)
            continue;
        const auto at =
            static_cast<uint32_t>(std::lower_bound(joints_.begin(), joints_.end(), joint) - joints_.begin());
        const Double3 place = transformPoint(skin_.jointFromBind(joint), vertex.middle);
        influences_of_joints_[at].push_back(static_cast<uint32_t>(influences_.size()));
        influences_.push_back(
            {{place.x * weight, place.y * weight, place.z * weight, weight}, length(place), at});
        places_.push_back(place);
        joint_sets_[first_word + at / 64] |= uint64_t{1} << at % 64;
        stretch += weight * skin_.relative(main, joint)->set().norm;
    }
    const Double3 place = vertex.middle * own_weight;
    main_bone_terms_.push_back(
        {{place.x, place.y, place.z}, length(vertex.half) * stretch, first, influences_.size()});
}

void RegionPositions::findMovers(std::span<const ActiveVertex> vertices, Movers& movers) const
{
    movers.joints.clear();
    for (size_t word = 0; word < joint_set_words_; ++word)
    {
        uint64_t set = 0;
        for (const ActiveVertex& active : vertices)
            set |= joint_sets_[active.vertex * joint_set_words_ + word];
        for (; set != 0; set &= set - 1)
            movers.joints.push_back(static_cast<uint32_t>(64 * word) +
                                    static_cast<uint32_t>(std::countr_zero(set)));
    }
    movers.links = chain_.linksTo(movers.joints);
    movers.nodes.clear();
    for (const uint32_t link : movers.links)
        movers.nodes.push_back(chain_.linkNode(link));
}

size_t RegionPositions::fullWork() const
{
    Movers movers;
    findMovers(all(), movers);
    return kNodeWork * movers.links.size() + 3 * influences_.size();
}

ActiveVertices RegionPositions::all() const
{
    ActiveVertices vertices;
    for (size_t v = 0; v < main_bone_terms_.size(); ++v)
        vertices.push_back({static_cast<uint16_t>(v), kAllAxes});
    return vertices;
}

void RegionPositions::addMiddle(const PoseRegion& region, Box3d& sampled)
{
    if (!chain_.middle(regions_, region, middles_))
        return;
    for (Affine3d& middle : middles_)
        middle = *skin_.bindFromJoint(main_) * middle;
    for (const MainBoneTerm& own : main_bone_terms_)
    {
        Double3 place{own.place[0], own.place[1], own.place[2]};
        for (size_t i = own.first; i < own.end; ++i)
            place =
                place + transformPoint(middles_[influences_[i].joint], places_[i]) * influences_[i].point[3];
        add(sampled, place);
    }
}

void RegionPositions::setPivot(uint32_t joint, Double3 pivot)
{
    Double3& known = pivots_[joint];
    if (pivot.x == known.x && pivot.y == known.y && pivot.z == known.z)
        return;
    known = pivot;
    for (const uint32_t i : influences_of_joints_[joint])
        influences_[i].distance = length(places_[i] - pivot);
}

bool RegionPositions::place(const PoseRegion& region, std::span<const ActiveVertex> vertices,
                            const Movers& movers, Box3d& sampled, std::vector<Box3d>& boxes, size_t& work)
{
    work += kNodeWork * movers.links.size();
    if (!chain_.place(regions_, region, movers.links, models_))
        return false;
    uint8_t axes = 0;
    for (const ActiveVertex& active : vertices)
        axes |= active.axes;
    motions_.resize(joints_.size());
    for (const uint32_t joint : movers.joints)
    {
        const TransformModel& model = models_[chain_.linkIndex(joint)];
        motions_[joint].linear_slack = bind_norm_ * model.linear.remainder;
        motions_[joint].point_slack = bind_norm_ * model.place.remainder;
        setPivot(joint, model.pivot);
    }
    slacks_.clear();
    for (const ActiveVertex& active : vertices)
    {
        const MainBoneTerm& own = main_bone_terms_[active.vertex];
        double slack = own.slack;
        for (size_t i = own.first; i < own.end; ++i)
        {
            const Influence& influence = influences_[i];
            const Motion& motion = motions_[influence.joint];
            slack += influence.point[3] * (motion.linear_slack * influence.distance + motion.point_slack);
        }
        slacks_.push_back(slack);
        work += (own.end - own.first) * static_cast<size_t>(std::popcount(active.axes));
    }
    boxes.assign(vertices.size(), {});
    callWithWideVectors(
        [&]() HEARTH_INLINE
        {
            for (const uint32_t joint : movers.joints)
                Kernels::setElements(*skin_.bindFromJoint(main_), models_[chain_.linkIndex(joint)], axes,
                                     motions_[joint]);
            for (size_t axis = 0; axis < 3; ++axis)
                if ((axes >> axis & 1) != 0)
                    Kernels::bound(*this, vertices, axis, sampled[axis], boxes);
        });
    return true;
}

} // namespace hearth::skinning
