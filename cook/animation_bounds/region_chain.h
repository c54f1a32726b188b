// Joints as one of them sees them while poses stay in a region: transforms that depend on where in it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/transform_model.h"

#include <vector>

namespace hearth::motion
{

/// The nodes between a main bone and other joints, each behind the one that it hangs on as the main bone sees it.
class RegionChain
{
public:
    /// joints  nodes of the joints
    RegionChain(std::span<const formats::NodeRecord> nodes, uint32_t main, std::span<const uint32_t> joints);

    /// The links between the main bone and some of the joints, each behind the one that it hangs on.
    /// joints  by the order of the constructor
    std::vector<uint32_t> linksTo(std::span<const uint32_t> joints) const;

    /// The node whose pose makes a link.
    uint32_t nodeOf(uint32_t link) const { return links_[link].node; }

    /// Where `place` puts the model of a joint.
    uint32_t linkOf(uint32_t joint) const { return link_of_joint_[joint]; }

    /// Transforms from joints' nodes to the main bone's; false where one has no bounds.
    /// links   of linksTo
    /// models  by link
    bool place(const PoseRegions& regions, const PoseRegion& region, std::span<const uint32_t> links,
               std::vector<TransformModel>& models) const;

    /// The transforms in the middle of the region alone.
    /// transforms  one for each joint, in the order of the constructor
    bool middle(const PoseRegions& regions, const PoseRegion& region,
                std::vector<Affine3d>& transforms) const;

private:
    struct Link
    {
        uint32_t node;  ///< that poses
        uint32_t after; ///< link that it hangs on
        bool up;        ///< to the node's parent, else from the node
    };

    std::vector<Link> links_; ///< link 0 is the main bone's node itself
    std::vector<uint32_t> link_of_joint_;
};

} // namespace hearth::motion
