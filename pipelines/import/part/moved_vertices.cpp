// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/moved_vertices.h"

#include <algorithm>

namespace hearth::import
{

namespace
{

void addJoints(MovedVertices& vertices, const mesh::Joints4& joints, Float4 weights, Double3 position)
{
    const std::array<float, 4> weight{weights.x, weights.y, weights.z, weights.w};
    for (size_t i = 0; i < weight.size(); ++i)
    {
        if (!(weight[i] > 0))
            continue;
        if (vertices.of_joint.size() <= joints.joint[i])
            vertices.of_joint.resize(size_t{joints.joint[i]} + 1);
        motion::add(vertices.of_joint[joints.joint[i]], position);
    }
}

void join(motion::Box3d& box, const motion::Box3d& other)
{
    for (size_t i = 0; i < box.size(); ++i)
    {
        box[i].low = std::min(box[i].low, other[i].low);
        box[i].high = std::max(box[i].high, other[i].high);
    }
}

} // namespace

MovedVertices movedVertices(const mesh::SourceMesh& mesh)
{
    MovedVertices vertices;
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
    {
        const Double3 position = widen(mesh.positions[v]);
        motion::add(vertices.box, position);
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

void add(MovedVertices& vertices, const MovedVertices& of_level)
{
    join(vertices.box, of_level.box);
    vertices.of_joint.resize(std::max(vertices.of_joint.size(), of_level.of_joint.size()));
    for (size_t joint = 0; joint < of_level.of_joint.size(); ++joint)
        join(vertices.of_joint[joint], of_level.of_joint[joint]);
    vertices.morph_distances.resize(
        std::max(vertices.morph_distances.size(), of_level.morph_distances.size()));
    for (size_t target = 0; target < of_level.morph_distances.size(); ++target)
        vertices.morph_distances[target] =
            std::max(vertices.morph_distances[target], of_level.morph_distances[target]);
}

} // namespace hearth::import
