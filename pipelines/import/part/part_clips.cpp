// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/part_clips.h"

#include "cook/animation_bounds/node_motion.h"
#include "formats/base/assert.h"

namespace hearth::import
{

using namespace formats;
using clips::Carried;
using motion::Box3d;

namespace
{

MotionTables tablesOf(const PartBuilder& part)
{
    return {part.nodes,    part.skins, part.joints,        part.animations,
            part.channels, part.keys,  part.morph_weights, part.key_bits};
}

/// Return the transform that instancing puts between a node and its instance, derived as in the runtime.
Affine3d nodeFromObject(const InstanceRecord& instance, const Affine3d& world_from_node)
{
    const auto narrow = narrowed(world_from_node);
    if (narrow && *narrow == instance.world_from_object)
        return {};
    const auto node_from_world = inverted(world_from_node);
    return node_from_world ? *node_from_world * widened(instance.world_from_object) : Affine3d{};
}

/// Return the longest displacement of a vertex by morph targets, over all weights that clips give the node.
double morphDistance(const MotionTables& tables, uint32_t node, const MovedVertices& vertices)
{
    const size_t targets = vertices.morph_distances.size();
    const std::vector<motion::Interval> weights = motion::morphWeightRanges(tables, node, targets);
    double distance = 0;
    for (size_t target = 0; target < targets; ++target)
        distance += weights[target].magnitude() * vertices.morph_distances[target];
    return distance;
}

Box3d grown(Box3d box, double by)
{
    for (motion::Interval& axis : box)
        axis.grow(by);
    return box;
}

std::vector<Carried> carriedVertices(const PartBuilder& part, const MotionTables& tables)
{
    std::vector<Affine3d> world_from_node(tables.nodes.size());
    poseNodes(tables, restPose(tables), parentsFirst(tables.nodes), world_from_node);
    std::vector<Carried> carried;
    for (const InstanceRecord& instance : part.instances)
    {
        const NodeRecord& node = part.nodes[instance.node];
        const MovedVertices& vertices = part.movedVerticesOf(instance.mesh);
        const double morph = morphDistance(tables, instance.node, vertices);
        if (node.skin == kNone || vertices.of_joint.empty())
        {
            if (!vertices.box[0].empty())
                carried.push_back({instance.node, nodeFromObject(instance, world_from_node[instance.node]),
                                   grown(vertices.box, morph)});
            continue;
        }
        const Range joints = part.skins[node.skin].joints;
        HEARTH_ASSERT(vertices.of_joint.size() <= joints.count);
        for (uint32_t i = 0; i < vertices.of_joint.size(); ++i)
        {
            const JointRecord& joint = part.joints[joints.first + i];
            if (!vertices.of_joint[i][0].empty())
                carried.push_back(
                    {joint.node, widened(joint.joint_from_bind), grown(vertices.of_joint[i], morph)});
        }
    }
    return carried;
}

} // namespace

void compressClips(PartBuilder& part, const clips::StatedError& stated)
{
    if (part.animations.empty())
        return;
    const MotionTables tables = tablesOf(part);
    clips::CompressedClips compressed = clips::compressClips(tables, carriedVertices(part, tables), stated);
    part.animations = std::move(compressed.animations);
    part.channels = std::move(compressed.tables.channels);
    part.keys = std::move(compressed.tables.keys);
    part.key_bits = std::move(compressed.tables.key_bits);
    part.clip_statistics = std::move(compressed.statistics);
}

} // namespace hearth::import
