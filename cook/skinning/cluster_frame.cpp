// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_frame.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace hearth::skinning
{

using animation_bounds::Box3d;
using animation_bounds::JointMotion;
using animation_bounds::Matrix3;

namespace
{

// Maximum sum of a row of a frame's deviation: the frame's inverse enlarges motion by at most
// 1 / (1 - this), and a larger one would hardly ever give a smaller box.
constexpr double kMaxDeviation = 0.6;

// Number of terms of the series for the inverse: 0.6^40 is 1e-9.
constexpr int kSeriesTerms = 40;

/// Return the smallest weight that each joint has at any vertex, without those that do not move all vertices.
std::map<uint32_t, double> commonWeights(const DeformedCluster& cluster)
{
    std::map<uint32_t, double> common;
    for (size_t v = 0; v < cluster.positions.size(); ++v)
    {
        std::map<uint32_t, double> weights;
        for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
            if (cluster.weights[i] > 0)
                weights[cluster.joints[i]] += cluster.weights[i];
        if (v == 0)
            common = weights;
        std::erase_if(common, [&](const auto& joint) { return !weights.contains(joint.first); });
        for (auto& [joint, weight] : common)
            weight = std::min(weight, weights.at(joint));
    }
    return common;
}

Matrix3 added(const Matrix3& a, const Matrix3& b, double times)
{
    Matrix3 sum = a;
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column)
            sum[row][column] += times * b[row][column];
    return sum;
}

double maxRowSum(const Matrix3& matrix)
{
    double largest = 0;
    for (const auto& row : matrix)
        largest = std::max(largest, row[0] + row[1] + row[2]);
    return largest;
}

} // namespace

ClusterFrame::ClusterFrame(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation)
    : main_(main)
{
    if (deformation.skin == nullptr || !cluster.morphs.empty())
        return;
    struct Candidate
    {
        FrameShare share;
        const JointMotion* motion;
        double deviation;
    };
    std::vector<Candidate> candidates;
    for (const auto& [joint, weight] : commonWeights(cluster))
    {
        const FrameShare share{joint, static_cast<uint16_t>(std::min(65535.0, std::floor(weight * 65536)))};
        const JointMotion* const motion = joint == main ? nullptr : deformation.skin->relative(main, joint);
        if (motion != nullptr && share.share > 0)
            candidates.push_back({share, motion, share.value() * maxRowSum(motion->deviation())});
    }
    // those that turn least leave most room for others
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) {
                  return a.deviation != b.deviation ? a.deviation < b.deviation
                                                    : a.share.joint < b.share.joint;
              });
    for (const Candidate& candidate : candidates)
        if (const Matrix3 sum = added(deviation_, candidate.motion->deviation(), candidate.share.value());
            maxRowSum(sum) <= kMaxDeviation)
        {
            deviation_ = sum;
            shares_.push_back(candidate.share);
        }
    std::sort(shares_.begin(), shares_.end(),
              [](const FrameShare& a, const FrameShare& b) { return a.joint < b.joint; });
}

DeformedCluster ClusterFrame::remainder(const DeformedCluster& cluster) const
{
    if (shares_.empty())
        return cluster;
    double shared = 0;
    for (const FrameShare& share : shares_)
        shared += share.value();
    DeformedCluster rest = cluster;
    rest.influences = cluster.influences + 1;
    rest.joints.clear();
    rest.weights.clear();
    for (size_t v = 0; v < cluster.positions.size(); ++v)
    {
        std::vector<FrameShare> open = shares_; // a joint may have several weights
        std::vector<double> taken(open.size());
        for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
        {
            double weight = cluster.weights[i];
            for (size_t s = 0; s < open.size(); ++s)
                if (open[s].joint == cluster.joints[i] && weight > 0)
                {
                    const double part = std::min(weight, open[s].value() - taken[s]);
                    taken[s] += part;
                    weight -= part;
                }
            rest.joints.push_back(cluster.joints[i]);
            rest.weights.push_back(weight);
        }
        rest.joints.push_back(static_cast<uint16_t>(main_));
        rest.weights.push_back(shared);
    }
    return rest;
}

Double3 ClusterFrame::distance(Double3 position, const Box3d& places) const
{
    if (shares_.empty())
        return {};
    // In the frame I + M, seen from the main bone, a vertex that the remainder moves by d is at
    // x + (I + M)^-1 d, and the difference to x + d is M (I + M)^-1 d: at most M + M^2 + ... of the absolute
    // values.
    const double at[3] = {position.x, position.y, position.z};
    std::array<double, 3> term{}, sum{};
    for (size_t axis = 0; axis < 3; ++axis)
        term[axis] = std::max(std::abs(places[axis].low - at[axis]), std::abs(places[axis].high - at[axis]));
    for (int i = 0; i < kSeriesTerms; ++i)
    {
        std::array<double, 3> next{};
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 3; ++column)
                next[row] += deviation_[row][column] * term[column];
        term = next;
        for (size_t axis = 0; axis < 3; ++axis)
            sum[axis] += term[axis];
    }
    // terms that are left out
    const double rest = std::max({term[0], term[1], term[2]}) * kMaxDeviation / (1 - kMaxDeviation);
    return {sum[0] + rest, sum[1] + rest, sum[2] + rest};
}

} // namespace hearth::skinning
