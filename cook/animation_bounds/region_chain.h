// Transforms between joints as functions of the parameters of a pose region.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/transform_model.h"

#include <vector>

namespace hearth::animation_bounds
{

/// Nodes between a main bone and other joints. Each link follows the link that it is attached to, seen from
/// the main bone.
class RegionChain
{
public:
    /// Construct the chain.
    /// joints  nodes of the joints
    RegionChain(std::span<const formats::NodeRecord> nodes, uint32_t main, std::span<const uint32_t> joints);

    /// Return the links between the main bone and some of the joints, in order of dependency.
    /// joints  indices into the constructor's joints
    std::vector<uint32_t> linksTo(std::span<const uint32_t> joints) const;

    /// Return the node whose pose defines a link.
    uint32_t linkNode(uint32_t link) const { return links_[link].node; }

    /// Return the index at which `place` stores the model of a joint.
    uint32_t linkIndex(uint32_t joint) const { return link_of_joint_[joint]; }

    /// Compute the transforms from the joints' nodes to the main bone's node. Return false if a transform has
    /// no bounds.
    /// links   result of linksTo
    /// models  by link
    bool place(const PoseRegions& regions, const PoseRegion& region, std::span<const uint32_t> links,
               std::vector<TransformModel>& models) const;

    /// Compute the transforms at the middle of the region only.
    /// transforms  one for each joint, in the order of the constructor
    bool middle(const PoseRegions& regions, const PoseRegion& region,
                std::vector<Affine3d>& transforms) const;

private:
    struct Link
    {
        uint32_t node;  ///< node whose pose defines the link
        uint32_t after; ///< link that it is attached to
        bool up;        ///< true: the link leads to the node's parent; false: to the node itself
    };

    std::vector<Link> links_; ///< link 0 is the main bone's node itself
    std::vector<uint32_t> link_of_joint_;
};

} // namespace hearth::animation_bounds
