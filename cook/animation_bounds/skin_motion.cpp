// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/skin_motion.h"

#include "cook/animation_bounds/symmetric.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

// Maximum number of matrices of a joint's motion. More matrices give tighter bounds and slower queries: with
// four times as many, boxes of moving clusters shrink by less than a hundredth.
constexpr size_t kMaxMatrices = 256;

// Initial tolerance, as a share of the size of the points that the joint moves. It grows until the matrices
// are few enough.
constexpr double kFirstTolerance = 0.004;
constexpr double kToleranceGrowth = 1.4;

} // namespace

JointMotion::JointMotion(MatrixSet set) : set_(std::move(set)), ball_(boundingBall(set_))
{
    const std::vector<Affine3d>& hull = set_.hull;
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column)
        {
            double& largest = deviation_[row][column];
            for (const Affine3d& matrix : hull)
                largest = std::max(largest, std::abs(matrix.m[row][column] - (row == column ? 1 : 0)));
            // no element exceeds the norm
            largest = std::min(largest + set_.linear_slack, set_.norm + (row == column ? 1 : 0));
        }
    for (size_t axis = 0; axis < 3; ++axis)
        for (size_t i = 0; i < hull.size(); i += 2)
        {
            // repeat the last matrix of an odd number
            const double(&a)[4] = hull[i].m[axis];
            const double(&b)[4] = hull[std::min(i + 1, hull.size() - 1)].m[axis];
            rows_[axis].push_back(
                RowPair{Lanes{a[0], b[0]}, Lanes{a[1], b[1]}, Lanes{a[2], b[2]}, Lanes{a[3], b[3]}});
        }
}

void JointMotion::addPositionBox(Double3 point, Double3 half, double weight, Box3d& box) const
{
    const double slack = set_.linear_slack * (length(point - set_.pivot) + length(half)) + set_.point_slack;
    const bool is_point = half.x == 0 && half.y == 0 && half.z == 0;
    const auto absolute = [](Lanes v) { return v < 0 ? -v : v; };
    for (size_t axis = 0; axis < 3; ++axis)
    {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        Lanes low{kFar, kFar}, high{-kFar, -kFar};
        for (const RowPair& row : rows_[axis])
        {
            const Lanes place = row.x * point.x + row.y * point.y + row.z * point.z + row.w;
            Lanes reach{};
            if (!is_point)
                reach = absolute(row.x) * half.x + absolute(row.y) * half.y + absolute(row.z) * half.z;
            const Lanes from = place - reach, to = place + reach;
            low = from < low ? from : low;
            high = to > high ? to : high;
        }
        box[axis].low += weight * (std::min(low[0], low[1]) - slack);
        box[axis].high += weight * (std::max(high[0], high[1]) + slack);
    }
}

SkinMotion::SkinMotion(const AnimationTables& tables, std::span<const NodeMotion> nodes, uint32_t skin,
                       std::span<const Box3d> reach)
    : records_(tables.nodes), nodes_(nodes)
{
    const ScenePose rest = restPose(tables);
    for (size_t i = 0; i < nodes.size(); ++i)
        parent_from_node_.push_back(
            nodes[i].fixed
                ? *nodes[i].fixed
                : makeAffineFromTrs(rest.nodes[i].translation, rest.nodes[i].rotation, rest.nodes[i].scale));
    const Range range = tables.skins[skin].joints;
    HEARTH_ASSERT(reach.size() == range.count);
    for (uint32_t i = 0; i < range.count; ++i)
    {
        const JointRecord& record = tables.joints[range.first + i];
        Joint joint;
        joint.joint_from_bind = widened(record.joint_from_bind);
        joint.bind_from_joint = inverted(joint.joint_from_bind);
        for (uint32_t node = record.node; node != kInvalidIndex; node = tables.nodes[node].parent)
            joint.nodes.push_back(node);
        joint.reach = reach[i];
        joints_.push_back(std::move(joint));
    }
}

std::optional<std::vector<SkinMotion::Step>> SkinMotion::pathBetween(uint32_t main, uint32_t joint) const
{
    const std::vector<uint32_t>& to = joints_[main].nodes;
    const std::vector<uint32_t>& from = joints_[joint].nodes;
    if (!joints_[main].bind_from_joint)
        return std::nullopt;
    // ignore common ancestors: they move both joints alike
    size_t shared = 0;
    while (shared < std::min(to.size(), from.size()) &&
           to[to.size() - 1 - shared] == from[from.size() - 1 - shared])
        ++shared;
    std::vector<Step> steps;
    for (size_t i = 0; i + shared < from.size(); ++i)
        steps.push_back({from[i], false});
    for (size_t i = to.size() - shared; i-- > 0;)
    {
        if (nodes_[to[i]].canBeSingular())
            return std::nullopt;
        steps.push_back({to[i], true});
    }
    return steps;
}

std::vector<Tolerance> SkinMotion::tolerances(std::span<const Step> steps, uint32_t main,
                                              uint32_t joint) const
{
    // lever of each node: distance of the points that it moves from the node's origin in the rest pose
    const Joint& from = joints_[joint];
    const Box3d& reach = from.reach;
    Double3 place = transformPoint(from.joint_from_bind, reach[0].empty() ? Double3{} : middle(reach));
    double radius = (reach[0].empty() ? 0 : length(half(reach))) * operatorNorm(from.joint_from_bind);
    std::vector<double> levers, norms;
    for (const Step& step : steps)
    {
        const NodeMotion& node = nodes_[step.node];
        const Affine3d& parent_from_node = parent_from_node_[step.node];
        const Double3 origin = transformPoint(parent_from_node, {});
        levers.push_back(length(step.down ? place - origin : place) + radius);
        norms.push_back(step.down ? node.inverseNorm() : node.norm());
        const std::optional<Affine3d> inverse =
            step.down ? inverted(parent_from_node) : std::optional(parent_from_node);
        place = transformPoint(inverse.value_or(Affine3d{}), place);
        radius *= norms.back();
    }
    // convert an error of a metre behind each step to metres in the main bone
    std::vector<Tolerance> shares(steps.size());
    double main_scale = operatorNorm(*joints_[main].bind_from_joint);
    for (size_t i = steps.size(); i-- > 0;)
    {
        const double shift = main_scale * (steps[i].down ? norms[i] : 1.0);
        shares[i] = {1 / std::max(main_scale * levers[i], 1e-30), 1 / std::max(shift, 1e-30)};
        main_scale *= norms[i];
    }
    return shares;
}

std::unique_ptr<JointMotion> SkinMotion::computeMotion(uint32_t main, uint32_t joint) const
{
    const std::optional<std::vector<Step>> steps = pathBetween(main, joint);
    if (!steps)
        return nullptr;
    const std::vector<Tolerance> shares = tolerances(*steps, main, joint);
    const Joint& from = joints_[joint];
    const double size = from.reach[0].empty() ? 1 : length(half(from.reach));
    const auto scaled = [&](size_t i, double metres) {
        return Tolerance{shares[i].linear * metres, shares[i].shift * metres};
    };
    double tolerance = kFirstTolerance * std::max(size, 1e-6);
    const auto matrices = [&]
    {
        double count = 1;
        for (size_t i = 0; i < steps->size(); ++i)
            count *= hullSize(nodes_[(*steps)[i].node], scaled(i, tolerance));
        return count;
    };
    while (matrices() > static_cast<double>(kMaxMatrices))
        tolerance *= kToleranceGrowth;

    MatrixSet set = singletonSet(from.joint_from_bind);
    // rotations about the joint leave its origin unmoved
    set.pivot = from.bind_from_joint ? transformPoint(*from.bind_from_joint, {}) : Double3{};
    for (size_t i = 0; i < steps->size(); ++i)
    {
        const NodeMotion& node = nodes_[(*steps)[i].node];
        set = composeSets((*steps)[i].down ? nodeFromParent(node, scaled(i, tolerance))
                                           : parentFromNode(node, scaled(i, tolerance)),
                          set);
    }
    return std::make_unique<JointMotion>(composeSets(singletonSet(*joints_[main].bind_from_joint), set));
}

SkinMotion::Entry& SkinMotion::entry(uint32_t main, uint32_t joint) const
{
    const std::lock_guard lock(mutex_);
    return entries_[uint64_t{main} << 32 | joint];
}

const JointMotion* SkinMotion::relative(uint32_t main, uint32_t joint) const
{
    HEARTH_ASSERT(main < joints_.size() && joint < joints_.size());
    Entry& found = entry(main, joint);
    std::call_once(found.once, [&] { found.motion = computeMotion(main, joint); });
    return found.motion.get();
}

RegionChain SkinMotion::regionChain(uint32_t main, std::span<const uint32_t> joints) const
{
    std::vector<uint32_t> nodes;
    for (const uint32_t joint : joints)
        nodes.push_back(joints_[joint].nodes.front());
    return RegionChain(records_, joints_[main].nodes.front(), nodes);
}

bool SkinMotion::canMirror(uint32_t joint) const
{
    const std::vector<uint32_t>& nodes = joints_[joint].nodes;
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](uint32_t node)
                       { return nodes_[node].canMirror() || nodes_[node].canBeSingular(); });
}

std::optional<IdentityDeviation> SkinMotion::departure(uint32_t main, uint32_t joint) const
{
    const JointMotion* motion = relative(main, joint);
    if (motion == nullptr)
        return std::nullopt;
    return computeIdentityDeviation(motion->set());
}

} // namespace hearth::animation_bounds
