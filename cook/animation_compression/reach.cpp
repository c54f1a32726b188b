// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/reach.h"

#include "cook/animation_bounds/key_hull.h"
#include "cook/animation_bounds/symmetric.h"
#include "formats/pack/pack_view.h"

#include <algorithm>

namespace hearth::animation_compression
{

using namespace formats;
using animation_bounds::Box3d;

namespace
{

std::array<Double3, 8> boxCorners(const Box3d& box)
{
    std::array<Double3, 8> corners;
    for (size_t i = 0; i < corners.size(); ++i)
        corners[i] = {i & 1 ? box[0].high : box[0].low, i & 2 ? box[1].high : box[1].low,
                      i & 4 ? box[2].high : box[2].low};
    return corners;
}

void join(Box3d& box, const Box3d& other)
{
    for (size_t i = 0; i < box.size(); ++i)
    {
        box[i].low = std::min(box[i].low, other[i].low);
        box[i].high = std::max(box[i].high, other[i].high);
    }
}

double longestSide(const Box3d& box)
{
    return box[0].empty() ? 0 : 2 * std::max({box[0].half(), box[1].half(), box[2].half()});
}

Double3 farthestCorner(const Box3d& box)
{
    return {box[0].magnitude(), box[1].magnitude(), box[2].magnitude()};
}

} // namespace

SceneReach computeSceneReach(const AnimationTables& tables, std::span<const AttachedVertices> carried)
{
    const size_t count = tables.nodes.size();
    SceneReach reach{nodesParentsFirst(tables.nodes), std::vector<double>(count, -1),
                     std::vector<double>(count), 0};
    std::vector<Affine3d> world_from_node(count);
    poseNodes(tables, restPose(tables), reach.parents_first, world_from_node);
    std::vector<Box3d> boxes(count);
    for (const AttachedVertices& points : carried)
        for (const Double3 corner : boxCorners(points.box))
        {
            const Double3 place = transformPoint(points.node_from_points, corner);
            reach.own[points.node] = std::max(reach.own[points.node], length(place));
            animation_bounds::add(boxes[points.node], transformPoint(world_from_node[points.node], place));
        }
    Box3d scene;
    for (auto node = reach.parents_first.rbegin(); node != reach.parents_first.rend(); ++node)
    {
        reach.size[*node] = longestSide(boxes[*node]);
        if (tables.nodes[*node].parent != kInvalidIndex)
            join(boxes[tables.nodes[*node].parent], boxes[*node]);
        else
            join(scene, boxes[*node]);
    }
    reach.scene_size = longestSide(scene);
    return reach;
}

ClipReach computeClipReach(const AnimationTables& tables, const AnimationRecord& animation,
                           const SceneReach& scene)
{
    const size_t count = tables.nodes.size();
    std::vector<Box3d> translations(count), scales(count);
    for (const AnimationChannelRecord& channel : recordsInRange(tables.channels, animation.channels))
        if (channel.path == static_cast<uint32_t>(AnimationPath::translation))
            animation_bounds::addValues(tables, channel, translations[channel.target]);
        else if (channel.path == static_cast<uint32_t>(AnimationPath::scale))
            animation_bounds::addValues(tables, channel, scales[channel.target]);

    ClipReach reach{std::vector<double>(count), scene.own};
    for (auto at = scene.parents_first.rbegin(); at != scene.parents_first.rend(); ++at)
    {
        const NodeRecord& node = tables.nodes[*at];
        double shift = 0;
        if (node.has_trs == 0)
        {
            const Affine3d matrix = widened(node.parent_from_node);
            reach.scale[*at] = animation_bounds::operatorNorm(matrix);
            shift = length(Double3{matrix.m[0][3], matrix.m[1][3], matrix.m[2][3]});
        }
        else
        {
            if (translations[*at][0].empty())
                animation_bounds::add(translations[*at], widen(node.translation));
            if (scales[*at][0].empty())
                animation_bounds::add(scales[*at], widen(node.scale));
            const Double3 scale = farthestCorner(scales[*at]);
            reach.scale[*at] = std::max({scale.x, scale.y, scale.z});
            shift = length(farthestCorner(translations[*at]));
        }
        if (node.parent != kInvalidIndex && reach.farthest[*at] >= 0)
            reach.farthest[node.parent] =
                std::max(reach.farthest[node.parent], shift + reach.scale[*at] * reach.farthest[*at]);
    }
    return reach;
}

} // namespace hearth::animation_compression
