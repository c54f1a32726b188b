// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/placement.h"

namespace hearth::reference
{

using namespace formats;

namespace
{

std::vector<Affine3d> computeWorld(const AnimationTables& tables, const ScenePose& pose)
{
    std::vector<Affine3d> world_from_node(tables.nodes.size());
    poseNodes(tables, pose, nodesParentsFirst(tables.nodes), world_from_node);
    return world_from_node;
}

/// Sum of the joints' matrices, weighted by the vertex's joint weights.
DoubleAffine blended(std::span<const Affine3d> palette, const ClusterGeometry& cluster, uint32_t vertex)
{
    if (cluster.influenceCount() == 0)
        return DoubleAffine(palette[0]);
    const auto joints = cluster.joints(vertex);
    const auto weights = cluster.weights(vertex);
    Affine3d sum;
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 4; ++column)
        {
            sum.m[row][column] = 0;
            for (size_t i = 0; i < cluster.influenceCount(); ++i)
                sum.m[row][column] += double{weights[i]} * palette[joints[i]].m[row][column];
        }
    return DoubleAffine(sum);
}

Double3 unitOr0(Double3 v)
{
    return dot(v, v) > 1e-60 ? normalize(v) : Double3{};
}

} // namespace

Placement::Placement(const PackGeometry& geometry, const ScenePose* pose) : geometry_(&geometry)
{
    const PackView& view = geometry.view();
    const AnimationTables tables = animationTables(view);
    const ScenePose rest = restPose(tables);
    const std::vector<Affine3d> at_rest = computeWorld(tables, rest);
    const std::vector<Affine3d> now = pose != nullptr ? computeWorld(tables, *pose) : at_rest;
    for (uint32_t i = 0; i < view.instances().size(); ++i)
    {
        const InstanceRecord& record = view.instances()[i];
        Instance& instance = instances_.emplace_back();
        instance.world_from_object = widened(record.world_from_object);
        // transform between node and instance, as for many instances of one node
        const auto node_from_world = pose != nullptr ? inverted(at_rest[record.node]) : std::nullopt;
        if (node_from_world)
            instance.world_from_object = now[record.node] * (*node_from_world * instance.world_from_object);
        if (!reference::isDeformed(view, i))
            continue;
        const NodeRecord& node = view.nodes()[record.node];
        instance.palette = {instance.world_from_object};
        if (view.meshes()[record.mesh].skinned != 0)
        {
            instance.palette.resize(view.skins()[node.skin].joints.count);
            skinPalette(tables, view.skins()[node.skin], now, instance.palette);
        }
        const std::vector<double>& weights = pose != nullptr ? pose->morph_weights : rest.morph_weights;
        const auto first = weights.begin() + node.morph_weights.first;
        instance.morph_weights.assign(first, first + node.morph_weights.count);
    }
}

PlacedVertex Placement::vertex(uint32_t index, const ClusterGeometry& cluster, uint32_t vertex) const
{
    const Instance& instance = instances_[index];
    Double3 position(cluster.position(vertex)), normal, tangent;
    if (cluster.has(kVertexNormal))
        normal = Double3(cluster.normal(vertex));
    if (cluster.has(kVertexTangent))
    {
        const Float4 t = cluster.tangent(vertex);
        tangent = Double3(double{t.x}, double{t.y}, double{t.z});
    }
    for (uint32_t morph = 0; morph < cluster.morphCount(); ++morph)
    {
        const double weight = instance.morph_weights[cluster.morphTarget(morph)];
        position += Double3(cluster.morphPosition(morph, vertex)) * weight;
        if (cluster.has(kVertexNormal))
            normal += Double3(cluster.morphNormal(morph, vertex)) * weight;
    }
    const bool deformed = !instance.palette.empty();
    const DoubleAffine world =
        deformed ? blended(instance.palette, cluster, vertex) : DoubleAffine(instance.world_from_object);
    const bool mirrored = world.determinant() < 0;
    const Double3 turned = world.normal(normal) * (mirrored ? -1.0 : 1.0);
    // Joints may scale differently: interpolate directions only.
    return {world.point(position), deformed ? unitOr0(turned) : turned,
            deformed ? unitOr0(world.vector(tangent)) : world.vector(tangent), mirrored};
}

} // namespace hearth::reference
