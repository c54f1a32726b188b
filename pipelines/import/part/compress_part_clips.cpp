// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/compress_part_clips.h"

#include "cook/animation_bounds/node_motion.h"
#include "formats/base/assert.h"

namespace hearth::import
{

using namespace formats;
using animation_bounds::Box3d;
using animation_compression::AttachedVertices;

namespace
{

AnimationTables makeMotionTables(const PartBuilder& part)
{
    return {part.nodes,    part.skins, part.joints,        part.animations,
            part.channels, part.keys,  part.morph_weights, part.key_bits};
}

/// Return the longest displacement of a vertex by morph targets, over all weights that clips give the node.
double maxMorphDistance(const AnimationTables& tables, uint32_t node, const VertexBounds& vertices)
{
    const size_t targets = vertices.morph_distances.size();
    const std::vector<animation_bounds::Interval> weights =
        animation_bounds::morphWeightRanges(tables, node, targets);
    double distance = 0;
    for (size_t target = 0; target < targets; ++target)
        distance += weights[target].magnitude() * vertices.morph_distances[target];
    return distance;
}

Box3d expandBox(Box3d box, double by)
{
    for (animation_bounds::Interval& axis : box)
        axis.grow(by);
    return box;
}

std::vector<AttachedVertices> collectCarriedBoxes(const PartBuilder& part, const AnimationTables& tables)
{
    std::vector<Affine3d> world_from_node(tables.nodes.size());
    poseNodes(tables, restPose(tables), nodesParentsFirst(tables.nodes), world_from_node);
    std::vector<AttachedVertices> carried;
    for (const InstanceRecord& instance : part.instances)
    {
        const NodeRecord& node = part.nodes[instance.node];
        const VertexBounds& vertices = part.vertexBounds(instance.mesh);
        const double morph = maxMorphDistance(tables, instance.node, vertices);
        if (node.skin == kInvalidIndex || vertices.joint_boxes.empty())
        {
            if (!vertices.box[0].empty())
                carried.push_back({instance.node,
                                   nodeFromObject(world_from_node[instance.node], instance.world_from_object),
                                   expandBox(vertices.box, morph)});
            continue;
        }
        const Range joints = part.skins[node.skin].joints;
        HEARTH_ASSERT(vertices.joint_boxes.size() <= joints.count);
        for (uint32_t i = 0; i < vertices.joint_boxes.size(); ++i)
        {
            const JointRecord& joint = part.joints[joints.first + i];
            if (!vertices.joint_boxes[i][0].empty())
                carried.push_back(
                    {joint.node, widened(joint.joint_from_bind), expandBox(vertices.joint_boxes[i], morph)});
        }
    }
    return carried;
}

} // namespace

void compressClips(PartBuilder& part, const animation_compression::StatedError& stated)
{
    if (part.animations.empty())
        return;
    const AnimationTables tables = makeMotionTables(part);
    animation_compression::CompressedClips compressed =
        animation_compression::compressClips(tables, collectCarriedBoxes(part, tables), stated);
    part.animations = std::move(compressed.animations);
    part.channels = std::move(compressed.tables.channels);
    part.keys = std::move(compressed.tables.keys);
    part.key_bits = std::move(compressed.tables.key_bits);
    part.clip_statistics = std::move(compressed.statistics);
}

} // namespace hearth::import
