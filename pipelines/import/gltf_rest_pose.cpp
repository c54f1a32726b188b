// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf_rest_pose.h"

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

// one part in a thousand of the transform: what exporters lose by writing two products of floats
constexpr double kAgreement = 1e-3;

/// Roots first: the model has no cycles.
std::vector<uint32_t> parentsFirst(const GltfModel& model)
{
    std::vector<uint32_t> order;
    order.reserve(model.nodes.size());
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
        if (model.nodes[node].parent == formats::kNone)
            order.push_back(node);
    for (size_t i = 0; i < order.size(); ++i)
    {
        const std::vector<uint32_t>& children = model.nodes[order[i]].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    return order;
}

double largestEntry(const Transform& t)
{
    double largest = 0;
    for (const auto& row : t.m)
        for (const double value : row)
            largest = std::max(largest, std::abs(value));
    return largest;
}

bool isFlat(const Transform& t)
{
    const std::optional<Affine3> narrow = narrowed(t);
    return !narrow || determinant(*narrow) == 0.0f;
}

/// The joints' transforms of one vertex, added up by weight.
Transform blended(const mesh::SourceMesh& mesh, size_t vertex, std::span<const Transform> world_from_bind)
{
    Transform sum;
    for (auto& row : sum.m)
        std::fill(std::begin(row), std::end(row), 0.0);
    for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
    {
        const Float4 w = mesh.weight_sets[set][vertex];
        const double weights[4] = {w.x, w.y, w.z, w.w};
        for (size_t k = 0; k < 4; ++k)
            if (weights[k] != 0.0)
                for (size_t i = 0; i < 3; ++i)
                    for (size_t j = 0; j < 4; ++j)
                        sum.m[i][j] +=
                            weights[k] * world_from_bind[mesh.joint_sets[set][vertex].joint[k]].m[i][j];
    }
    return sum;
}

std::array<double, 3> applied(const Transform& t, Float3 v, double w)
{
    std::array<double, 3> result{};
    for (size_t i = 0; i < 3; ++i)
        result[i] =
            t.m[i][0] * double{v.x} + t.m[i][1] * double{v.y} + t.m[i][2] * double{v.z} + t.m[i][3] * w;
    return result;
}

/// The cofactors of the linear part: they turn normals as it turns surfaces.
Transform cofactors(const Transform& t)
{
    Transform c;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
        {
            const size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c.m[i][j] = t.m[i1][j1] * t.m[i2][j2] - t.m[i1][j2] * t.m[i2][j1];
        }
    return c;
}

double determinantOf(const Transform& t, const Transform& its_cofactors)
{
    return t.m[0][0] * its_cofactors.m[0][0] + t.m[0][1] * its_cofactors.m[0][1] +
           t.m[0][2] * its_cofactors.m[0][2];
}

Float3 unitOr(const std::array<double, 3>& v, double sign, Float3 otherwise)
{
    const double length = std::hypot(v[0], v[1], v[2]);
    if (!(length > 0.0) || !std::isfinite(length))
        return otherwise;
    const double scale = sign / length;
    return {static_cast<float>(v[0] * scale), static_cast<float>(v[1] * scale),
            static_cast<float>(v[2] * scale)};
}

} // namespace

std::vector<Transform> worldTransforms(const GltfModel& model)
{
    std::vector<Transform> world_from_node(model.nodes.size());
    for (const uint32_t node : parentsFirst(model))
    {
        const GltfNode& n = model.nodes[node];
        world_from_node[node] =
            n.parent == formats::kNone ? n.parent_from_node : world_from_node[n.parent] * n.parent_from_node;
    }
    return world_from_node;
}

std::optional<SkinnedRestPose> skinnedRestPose(const GltfSkin& skin, const InverseBinds& inverse_binds,
                                               const std::vector<bool>& used,
                                               std::span<const Transform> world_from_node)
{
    HEARTH_ASSERT(used.size() <= skin.joints.size());
    std::optional<SkinnedRestPose> pose;
    for (size_t joint = 0; joint < used.size(); ++joint)
    {
        if (!used[joint])
            continue;
        const Transform world_from_bind = world_from_node[skin.joints[joint]] * inverse_binds[joint];
        if (isFlat(world_from_bind))
            continue;
        if (!pose)
            pose = SkinnedRestPose{world_from_bind, true};
        else if (distance(world_from_bind, pose->world_from_object) >
                 kAgreement * std::max(largestEntry(pose->world_from_object), 1e-6))
            pose->rigid = false;
    }
    return pose;
}

bool applyRestPose(mesh::SourceMesh& mesh, const GltfSkin& skin, const InverseBinds& inverse_binds,
                   std::span<const Transform> world_from_node)
{
    std::vector<Transform> world_from_bind;
    for (size_t joint = 0; joint < skin.joints.size(); ++joint)
        world_from_bind.push_back(world_from_node[skin.joints[joint]] * inverse_binds[joint]);

    mesh::BindPose posed{mesh.positions, mesh.normals, mesh.tangents};
    std::vector<bool> mirrored(mesh.vertexCount());
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
    {
        const Transform world_from_vertex = blended(mesh, v, world_from_bind);
        const std::array<double, 3> place = applied(world_from_vertex, mesh.positions[v], 1);
        for (const double coordinate : place)
            if (!(std::abs(coordinate) <= double{std::numeric_limits<float>::max()}))
                return false;
        posed.positions[v] = {static_cast<float>(place[0]), static_cast<float>(place[1]),
                              static_cast<float>(place[2])};
        const Transform world_from_normal = cofactors(world_from_vertex);
        mirrored[v] = determinantOf(world_from_vertex, world_from_normal) < 0;
        const double sign = mirrored[v] ? -1 : 1;
        if (!mesh.normals.empty())
            posed.normals[v] = unitOr(applied(world_from_normal, mesh.normals[v], 0), sign, mesh.normals[v]);
        if (!mesh.tangents.empty())
        {
            const Float4 t = mesh.tangents[v];
            const Float3 turned = unitOr(applied(world_from_vertex, {t.x, t.y, t.z}, 0), 1, {t.x, t.y, t.z});
            posed.tangents[v] = {turned.x, turned.y, turned.z, mirrored[v] ? -t.w : t.w};
        }
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        if (mirrored[mesh.indices[i]])
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    mesh.bind_pose = {std::move(mesh.positions), std::move(mesh.normals), std::move(mesh.tangents)};
    mesh.positions = std::move(posed.positions);
    mesh.normals = std::move(posed.normals);
    mesh.tangents = std::move(posed.tangents);
    return true;
}

} // namespace hearth::import
