// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/vertex_bounds.h"

#include <algorithm>

namespace hearth::import
{

namespace
{

void addJoints(VertexBounds& vertices, const mesh::Joints4& joints, Float4 weights, Double3 position)
{
    const std::array<float, 4> weight{weights.x, weights.y, weights.z, weights.w};
    for (size_t i = 0; i < weight.size(); ++i)
    {
        if (!(weight[i] > 0))
            continue;
        if (vertices.joint_boxes.size() <= joints.joint[i])
            vertices.joint_boxes.resize(size_t{joints.joint[i]} + 1);
        animation_bounds::add(vertices.joint_boxes[joints.joint[i]], position);
    }
}

void mergeBox(animation_bounds::Box3d& box, const animation_bounds::Box3d& other)
{
    for (size_t i = 0; i < box.size(); ++i)
    {
        box[i].low = std::min(box[i].low, other[i].low);
        box[i].high = std::max(box[i].high, other[i].high);
    }
}

} // namespace

VertexBounds computeVertexBounds(const mesh::SourceMesh& mesh)
{
    VertexBounds vertices;
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
    {
        const Double3 position = widen(mesh.positions[v]);
        animation_bounds::add(vertices.box, position);
        for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
            addJoints(vertices, mesh.joint_sets[set][v], mesh.weight_sets[set][v], position);
    }
    for (const mesh::MorphTarget& target : mesh.morph_targets)
    {
        double farthest = 0;
        for (const Float3 delta : target.positions)
            farthest = std::max(farthest, length(widen(delta)));
        vertices.morph_distances.push_back(farthest);
    }
    return vertices;
}

void add(VertexBounds& vertices, const VertexBounds& level_bounds)
{
    mergeBox(vertices.box, level_bounds.box);
    vertices.joint_boxes.resize(std::max(vertices.joint_boxes.size(), level_bounds.joint_boxes.size()));
    for (size_t joint = 0; joint < level_bounds.joint_boxes.size(); ++joint)
        mergeBox(vertices.joint_boxes[joint], level_bounds.joint_boxes[joint]);
    vertices.morph_distances.resize(
        std::max(vertices.morph_distances.size(), level_bounds.morph_distances.size()));
    for (size_t target = 0; target < level_bounds.morph_distances.size(); ++target)
        vertices.morph_distances[target] =
            std::max(vertices.morph_distances[target], level_bounds.morph_distances[target]);
}

} // namespace hearth::import
