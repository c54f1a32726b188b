// Joints as one of them sees them while poses stay in a region: transforms around a middle one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/motion/matrix_set.h"
#include "cook/motion/pose_regions.h"

#include <vector>

namespace hearth::motion
{

/// The nodes between a main bone and other joints, each behind the one that it hangs on as the main bone sees it.
class RegionChain
{
public:
    /// joints  nodes of the joints
    RegionChain(std::span<const formats::NodeRecord> nodes, uint32_t main, std::span<const uint32_t> joints);

    /// Nodes whose poses count.
    std::span<const uint32_t> nodes() const { return moving_; }

    /// Transforms from each joint's node to the main bone's; false where one has no bounds.
    /// balls  one for each joint, in the order of the constructor
    bool place(const PoseRegions& regions, const PoseRegion& region, std::vector<MatrixBall>& balls) const;

private:
    struct Link
    {
        uint32_t node;  ///< that poses
        uint32_t after; ///< link that it hangs on
        bool up;        ///< to the node's parent, else from the node
    };

    std::vector<Link> links_; ///< link 0 is the main bone's node itself
    std::vector<uint32_t> link_of_joint_;
    std::vector<uint32_t> moving_;
};

} // namespace hearth::motion
