// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/rest_transforms.h"

#include <algorithm>
#include <cmath>

namespace hearth::pack
{

Affine3d parentFromNode(const formats::NodeRecord& node)
{
    if (node.has_trs == 0)
        return widened(node.parent_from_node);
    // unit to within the rounding of floats
    const double x = node.rotation.x, y = node.rotation.y, z = node.rotation.z, w = node.rotation.w;
    const double norm = std::sqrt(x * x + y * y + z * z + w * w);
    return makeAffineFromTrs(widen(node.translation), {x / norm, y / norm, z / norm, w / norm},
                             widen(node.scale));
}

Affine3d worldFromNode(std::span<const formats::NodeRecord> nodes, uint32_t node)
{
    Affine3d up_from_node = parentFromNode(nodes[node]);
    for (uint32_t up = nodes[node].parent; up != kInvalidIndex; up = nodes[up].parent)
        up_from_node = parentFromNode(nodes[up]) * up_from_node;
    return up_from_node;
}

uint32_t findParentJoint(const formats::PackView& pack, uint32_t joint)
{
    const auto holds = [&](const formats::SkinRecord& skin)
    { return joint >= skin.joints.first && joint - skin.joints.first < skin.joints.count; };
    const auto skin = std::find_if(pack.skins().begin(), pack.skins().end(), holds);
    if (skin == pack.skins().end())
        return kInvalidIndex;
    const auto joints = recordsInRange(pack.joints(), skin->joints);
    for (uint32_t up = pack.nodes()[pack.joints()[joint].node].parent; up != kInvalidIndex;
         up = pack.nodes()[up].parent)
    {
        const auto found = std::find_if(joints.begin(), joints.end(),
                                        [&](const formats::JointRecord& above) { return above.node == up; });
        if (found != joints.end())
            return skin->joints.first + static_cast<uint32_t>(found - joints.begin());
    }
    return kInvalidIndex;
}

} // namespace hearth::pack
