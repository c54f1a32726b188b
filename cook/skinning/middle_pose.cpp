// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/middle_pose.h"

#include <algorithm>
#include <cmath>

namespace hearth::skinning
{

std::optional<MiddlePose> MiddlePose::in(uint32_t main, const DeformedCluster& cluster,
                                         const Deformation& deformation,
                                         std::span<const MorphedVertex> vertices)
{
    MiddlePose pose(cluster, vertices);
    for (size_t i = 0; i < cluster.joints.size(); ++i)
        if (cluster.weights[i] > 0 && cluster.joints[i] != main &&
            !pose.addPart(deformation, main, cluster.joints[i]))
            return std::nullopt;
    for (size_t v = 0; v < vertices.size(); ++v)
        pose.addPosition(v, deformation.skin == nullptr ? 1.0 : jointWeight(cluster, v, main));
    return pose;
}

bool MiddlePose::addPart(const Deformation& deformation, uint32_t main, uint32_t joint)
{
    if (std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.joint == joint; }))
        return true;
    const animation_bounds::JointMotion* motion = deformation.skin->relative(main, joint);
    if (motion == nullptr)
        return false;
    parts_.push_back({joint, motion});
    return true;
}

void MiddlePose::addPosition(size_t vertex, double own_weight)
{
    const Double3 bound = vertices_[vertex].middle;
    Double3 place = bound * own_weight;
    double stretch = own_weight;
    for (const Part& part : parts_)
        if (const double weight = jointWeight(*cluster_, vertex, part.joint); weight > 0)
        {
            place = place + transformPoint(part.motion->ball().center, bound) * weight;
            stretch += weight * part.motion->set().norm;
        }
    places_.push_back(place);
    morph_slack_.push_back(length(vertices_[vertex].half) * stretch);
}

double MiddlePose::slack(size_t vertex) const
{
    double slack = morph_slack_[vertex];
    for (const Part& part : parts_)
        if (const double weight = jointWeight(*cluster_, vertex, part.joint); weight > 0)
            slack += weight * part.motion->ball().slackAt(vertices_[vertex].middle);
    return slack;
}

double MiddlePose::edgeSlack(size_t a, size_t b) const
{
    double slack = morph_slack_[a] + morph_slack_[b];
    for (const Part& part : parts_)
    {
        const animation_bounds::MatrixBall& ball = part.motion->ball();
        const double weight_a = jointWeight(*cluster_, a, part.joint);
        const double weight_b = jointWeight(*cluster_, b, part.joint);
        const Double3 arm =
            (vertices_[a].middle - ball.pivot) * weight_a - (vertices_[b].middle - ball.pivot) * weight_b;
        slack += ball.linear_slack * length(arm) + ball.point_slack * std::abs(weight_a - weight_b);
    }
    return slack;
}

} // namespace hearth::skinning
