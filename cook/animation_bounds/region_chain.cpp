// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/region_chain.h"

#include <algorithm>
#include <unordered_map>

namespace hearth::animation_bounds
{

using namespace formats;

RegionChain::RegionChain(std::span<const NodeRecord> nodes, uint32_t main, std::span<const uint32_t> joints)
{
    // the last entry is none: the world, the common root of all trees
    std::vector<uint32_t> ancestors{main};
    while (ancestors.back() != kInvalidIndex)
        ancestors.push_back(nodes[ancestors.back()].parent);
    links_.push_back({main, 0, false});
    std::unordered_map<uint32_t, uint32_t> link_of_node{{main, 0}};
    const auto addLink = [&](uint32_t reached, Link link)
    {
        link_of_node[reached] = static_cast<uint32_t>(links_.size());
        links_.push_back(link);
    };
    size_t climbed = 0; // index of the highest ancestor with a link
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

std::vector<uint32_t> RegionChain::linksTo(std::span<const uint32_t> joints) const
{
    std::vector<bool> is_on_way(links_.size());
    for (const uint32_t joint : joints)
        for (uint32_t link = link_of_joint_[joint]; link != 0 && !is_on_way[link]; link = links_[link].after)
            is_on_way[link] = true;
    std::vector<uint32_t> links;
    for (uint32_t link = 1; link < links_.size(); ++link)
        if (is_on_way[link])
            links.push_back(link);
    return links;
}

bool RegionChain::place(const PoseRegions& regions, const PoseRegion& region, std::span<const uint32_t> links,
                        std::vector<TransformModel>& models) const
{
    models.resize(links_.size());
    models[0] = identityModel();
    BlendWeights& weights = blendWeights(region.weights());
    NodeModel node;
    TransformModel step;
    for (const uint32_t i : links)
    {
        const Link& link = links_[i];
        if (const std::optional<Affine3d>& fixed = regions.fixed(link.node))
        {
            const std::optional<Affine3d> transform = link.up ? inverted(*fixed) : fixed;
            if (!transform)
                return false;
            step = constantModel(*transform);
        }
        else
        {
            regions.setNodeModel(region, link.node, weights, node);
            if (!link.up)
                setParentFromNode(node, step);
            else if (!setNodeFromParent(node, step))
                return false;
        }
        compose(models[link.after], step, models[i]);
    }
    return true;
}

bool RegionChain::middle(const PoseRegions& regions, const PoseRegion& region,
                         std::vector<Affine3d>& transforms) const
{
    std::vector<Affine3d> chain{Affine3d{}};
    for (size_t i = 1; i < links_.size(); ++i)
    {
        const Link& link = links_[i];
        const std::optional<Affine3d>& fixed = regions.fixed(link.node);
        const NodePose pose = regions.middlePose(region, link.node);
        const Affine3d down = fixed ? *fixed : makeAffineFromTrs(pose.translation, pose.rotation, pose.scale);
        const std::optional<Affine3d> step = link.up ? inverted(down) : down;
        if (!step)
            return false;
        chain.push_back(chain[link.after] * *step);
    }
    transforms.clear();
    for (const uint32_t link : link_of_joint_)
        transforms.push_back(chain[link]);
    return true;
}

} // namespace hearth::animation_bounds
