// Moves a cluster's box with all joints that move every vertex alike, so that the box needs to contain only
// the motion in which its vertices differ.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"

#include <optional>

namespace hearth::skinning
{

/// Share of a joint in a cluster's frame.
struct FrameShare
{
    uint32_t joint;
    uint16_t share; ///< in 1/65536

    double value() const { return share / 65536.0; }
};

/// Space of a cluster's box in a pose: the transform sum_j s_j palette[j], where the main bone's share makes
/// the sum of all shares 1. A vertex x with weights w is at F (x + d), where d is the motion of the joints
/// relative to the main bone by the weights w_j - s_j.
class ClusterFrame
{
public:
    /// Make the frame of the main bone alone.
    explicit ClusterFrame(uint32_t main) : main_(main) {}

    /// Make the frame of the weights that all vertices have in common. Joints that turn far relative to the
    /// main bone have no share: the frame would shrink, and could be singular.
    ClusterFrame(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation);

    uint32_t main() const { return main_; }

    /// Return the shares besides the main bone's, which is the rest.
    std::span<const FrameShare> shares() const { return shares_; }

    /// Return the cluster with the weights that move it relative to the frame. They sum to 1: what the frame
    /// does is the main bone's.
    DeformedCluster remainder(const DeformedCluster& cluster) const;

    /// Return upper bounds, by axis, for the distance of a vertex in the frame from the same vertex of
    /// `remainder` in the main bone's space.
    /// position  in the bind pose
    /// places    box of the remainder's positions
    Double3 distance(Double3 position, const animation_bounds::Box3d& places) const;

private:
    uint32_t main_;
    std::vector<FrameShare> shares_;
    /// bounds of the elements of the frame's linear part, seen from the main bone, minus the unit matrix
    animation_bounds::Matrix3 deviation_{};
};

} // namespace hearth::skinning
