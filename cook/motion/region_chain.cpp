// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/motion/region_chain.h"

#include "cook/motion/symmetric.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace hearth::motion
{

using namespace formats;

namespace
{

/// A ball with what is needed to put another one behind it.
struct ChainBall
{
    MatrixBall ball;
    double center_norm = 1; ///< at least the operator norm of the center
    double norm = 1;        ///< and of each transform in the ball that is to be held
};

ChainBall exactly(const Affine3d& transform)
{
    const double norm = operatorNorm(transform);
    return {{transform, {}, 0, 0}, norm, norm};
}

Affine3d withoutLinear(const Affine3d& transform, Double3 kept)
{
    const Double3 place = transformPoint(transform, kept);
    return {{{0, 0, 0, place.x}, {0, 0, 0, place.y}, {0, 0, 0, place.z}}};
}

/// As composed() does for sets of one matrix.
ChainBall behind(const ChainBall& second, const ChainBall& first)
{
    ChainBall result;
    const double away = length(transformPoint(first.ball.center, first.ball.pivot) - second.ball.pivot);
    result.ball.center = second.ball.center * first.ball.center;
    result.ball.pivot = first.ball.pivot;
    result.ball.linear_slack =
        second.ball.linear_slack * first.center_norm + second.norm * first.ball.linear_slack;
    result.ball.point_slack =
        second.ball.linear_slack * away + second.ball.point_slack + second.norm * first.ball.point_slack;
    result.center_norm = second.center_norm * first.center_norm;
    result.norm = second.norm * first.norm;
    if (result.ball.linear_slack > result.norm)
    {
        result.ball.center = withoutLinear(result.ball.center, result.ball.pivot);
        result.ball.linear_slack = result.norm;
        result.center_norm = 0;
    }
    return result;
}

double largest(Double3 v)
{
    return std::max({v.x, v.y, v.z});
}

/// The rotation of a span and how far from it, in the operator norm, it can be.
struct RotationBall
{
    Affine3d center;
    double norm;
    double slack;
};

RotationBall rotationOf(const NodeSpan& span)
{
    const double slack = 2 * std::sin(std::min(span.angle, std::numbers::pi / 2));
    if (slack < 1)
        return {affineFromTrs({}, span.rotation, {1, 1, 1}), 1, slack};
    // any rotation is within 1 of the matrix 0
    return {withoutLinear(Affine3d{}, {}), 0, 1};
}

ChainBall parentFromNode(const NodeSpan& span)
{
    const RotationBall rotation = rotationOf(span);
    const Double3 scale = middle(span.scales), away = half(span.scales);
    const Double3 translation = middle(span.translations);
    const double most =
        std::max({span.scales[0].magnitude(), span.scales[1].magnitude(), span.scales[2].magnitude()});
    ChainBall result;
    const double scales[3] = {scale.x, scale.y, scale.z};
    const double translations[3] = {translation.x, translation.y, translation.z};
    for (size_t row = 0; row < 3; ++row)
    {
        for (size_t column = 0; column < 3; ++column)
            result.ball.center.m[row][column] = rotation.center.m[row][column] * scales[column];
        result.ball.center.m[row][3] = translations[row];
    }
    result.ball.linear_slack = rotation.slack * most + rotation.norm * largest(away);
    result.ball.point_slack = length(half(span.translations));
    result.center_norm = rotation.norm * most;
    result.norm = most;
    return result;
}

/// Nothing where a scale can be 0.
std::optional<ChainBall> nodeFromParent(const NodeSpan& span)
{
    Box3d inverses;
    for (size_t i = 0; i < 3; ++i)
    {
        if (span.scales[i].low <= 1e-6 * span.scales[i].magnitude() &&
            span.scales[i].high >= -1e-6 * span.scales[i].magnitude())
            return std::nullopt;
        inverses[i] = {1 / span.scales[i].high, 1 / span.scales[i].low};
    }
    const RotationBall rotation = rotationOf(span);
    const Double3 scale = middle(inverses);
    const double most = std::max({inverses[0].magnitude(), inverses[1].magnitude(), inverses[2].magnitude()});
    const double scales[3] = {scale.x, scale.y, scale.z};
    ChainBall result;
    for (size_t row = 0; row < 3; ++row)
    {
        for (size_t column = 0; column < 3; ++column)
            result.ball.center.m[row][column] = scales[row] * rotation.center.m[column][row];
        result.ball.center.m[row][3] = 0;
    }
    result.ball.pivot = middle(span.translations);
    const Double3 shift = transformVector(result.ball.center, result.ball.pivot);
    result.ball.center.m[0][3] = -shift.x;
    result.ball.center.m[1][3] = -shift.y;
    result.ball.center.m[2][3] = -shift.z;
    result.ball.linear_slack = rotation.slack * most + rotation.norm * largest(half(inverses));
    result.ball.point_slack = (result.ball.linear_slack + most) * length(half(span.translations));
    result.center_norm = rotation.norm * most;
    result.norm = most;
    return result;
}

} // namespace

RegionChain::RegionChain(std::span<const NodeRecord> nodes, uint32_t main, std::span<const uint32_t> joints)
{
    // the last is none: the world, which all trees hang on
    std::vector<uint32_t> ancestors{main};
    while (ancestors.back() != kNone)
        ancestors.push_back(nodes[ancestors.back()].parent);
    links_.push_back({main, 0, false});
    std::unordered_map<uint32_t, uint32_t> link_of_node{{main, 0}};
    const auto addLink = [&](uint32_t reached, Link link)
    {
        link_of_node[reached] = static_cast<uint32_t>(links_.size());
        links_.push_back(link);
        moving_.push_back(link.node);
    };
    size_t climbed = 0; // the highest ancestor with a link
    for (const uint32_t joint : joints)
    {
        std::vector<uint32_t> below;
        uint32_t node = joint;
        while (!link_of_node.contains(node))
        {
            const auto ancestor = std::find(ancestors.begin(), ancestors.end(), node) - ancestors.begin();
            if (static_cast<size_t>(ancestor) < ancestors.size())
                for (; climbed < static_cast<size_t>(ancestor); ++climbed)
                    addLink(ancestors[climbed + 1],
                            {ancestors[climbed], link_of_node.at(ancestors[climbed]), true});
            else
            {
                below.push_back(node);
                node = nodes[node].parent;
            }
        }
        for (size_t i = below.size(); i-- > 0;)
            addLink(below[i], {below[i], link_of_node.at(nodes[below[i]].parent), false});
        link_of_joint_.push_back(link_of_node.at(joint));
    }
}

bool RegionChain::place(const PoseRegions& regions, const PoseRegion& region,
                        std::vector<MatrixBall>& balls) const
{
    std::vector<ChainBall> chain{exactly(Affine3d{})};
    for (size_t i = 1; i < links_.size(); ++i)
    {
        const Link& link = links_[i];
        const std::optional<Affine3d>& fixed = regions.fixed(link.node);
        std::optional<ChainBall> step;
        if (fixed)
        {
            const std::optional<Affine3d> transform = link.up ? inverted(*fixed) : fixed;
            step = transform ? std::optional(exactly(*transform)) : std::nullopt;
        }
        else
            step = link.up ? nodeFromParent(regions.spanOf(region, link.node))
                           : parentFromNode(regions.spanOf(region, link.node));
        if (!step)
            return false;
        chain.push_back(behind(chain[link.after], *step));
    }
    balls.clear();
    for (const uint32_t link : link_of_joint_)
        balls.push_back(chain[link].ball);
    return true;
}

} // namespace hearth::motion
