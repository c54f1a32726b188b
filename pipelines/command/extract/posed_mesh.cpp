// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/posed_mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace hearth::command
{

using namespace formats;

namespace
{

/// Find an animation by its name, or one without a name by its index. errors: usage, with a list of all.
Result<const AnimationRecord*> findAnimation(const PackView& pack, const std::string& name)
{
    uint32_t index = kInvalidIndex;
    std::from_chars(name.data(), name.data() + name.size(), index);
    std::string names;
    for (uint32_t i = 0; i < pack.animations().size(); ++i)
    {
        const AnimationRecord& animation = pack.animations()[i];
        const std::string_view text = pack.text(animation.name);
        if (text.empty() ? index == i : text == name)
            return &animation;
        names +=
            fmt::format("{}{}", i == 0 ? "" : ", ", text.empty() ? std::to_string(i) : std::string(text));
    }
    return Error{Issue::usage, pack.name(), "",
                 names.empty() ? "there are no animations"
                               : fmt::format("there is no animation \"{}\": there are {}", name, names)};
}

/// Placement of one copy of a mesh.
struct MeshPlacement
{
    uint32_t node = kInvalidIndex;
    const InstanceRecord* instance = nullptr; ///< null if the scene does not draw it
};

MeshPlacement findPlacement(const PackView& pack, uint32_t mesh)
{
    for (const InstanceRecord& instance : pack.instances())
        if (instance.mesh == mesh)
            return {instance.node, &instance};
    for (uint32_t node = 0; node < pack.nodes().size(); ++node)
        if (pack.nodes()[node].mesh == mesh)
            return {node, nullptr};
    return {};
}

/// Return the transform of a copy in the pose. If a node has several instances, each moves from its rest
/// transform by the same motion as the node.
Affine3d worldFromObject(const MeshPlacement& copy, const Affine3d& rest, const Affine3d& posed)
{
    if (copy.instance == nullptr || narrowed(rest) == copy.instance->world_from_object)
        return posed;
    const Affine3d world_from_object = widened(copy.instance->world_from_object);
    const std::optional<Affine3d> node_from_world = inverted(rest);
    return node_from_world ? posed * (*node_from_world * world_from_object) : world_from_object;
}

Double3 column(const Affine3d& t, size_t i)
{
    return {t.m[0][i], t.m[1][i], t.m[2][i]};
}

/// Turn a vector at a vertex with the pose: the part along the normal stays along it, the part along the
/// surface turns with the surface, and both keep their lengths.
Float3 turnVector(const Affine3d& world_from_vertex, Double3 vector, Double3 normal, Double3 posed_normal)
{
    const double along = dot(vector, normal);
    const Double3 across = vector - normal * along;
    Double3 turned = transformPoint(world_from_vertex, across) - transformPoint(world_from_vertex, {});
    turned = turned - posed_normal * dot(turned, posed_normal);
    const double size = length(turned);
    const double scale = size > 0 && std::isfinite(size) ? length(across) / size : 0;
    return narrow(posed_normal * along + turned * scale);
}

} // namespace

Result<PosedMesh> PosedMesh::make(const PackView& pack, uint32_t mesh, const std::optional<ClipTime>& clip)
{
    const AnimationTables tables = animationTables(pack);
    ScenePose pose = restPose(tables);
    const std::vector<uint32_t> order = nodesParentsFirst(tables.nodes);
    std::vector<Affine3d> rest(tables.nodes.size()), posed(tables.nodes.size());
    poseNodes(tables, pose, order, rest);
    if (clip)
    {
        HEARTH_ASSIGN_OR_RETURN(const AnimationRecord* animation, findAnimation(pack, clip->animation));
        sampleAnimation(tables, *animation, clip->time_s, pose);
    }
    poseNodes(tables, pose, order, posed);

    PosedMesh result;
    const MeshPlacement copy = findPlacement(pack, mesh);
    if (copy.node == kInvalidIndex)
    {
        result.palette_ = {Affine3d{}};
        return result;
    }
    const NodeRecord& node = pack.nodes()[copy.node];
    for (const double weight :
         recordsInRange(std::span<const double>(pose.morph_weights), node.morph_weights))
        result.morph_weights_.push_back(weight);
    if (node.skin == kInvalidIndex)
        result.palette_ = {worldFromObject(copy, rest[copy.node], posed[copy.node])};
    else
    {
        const SkinRecord& skin = pack.skins()[node.skin];
        result.palette_.resize(skin.joints.count);
        skinPalette(tables, skin, posed, result.palette_);
    }
    return result;
}

Affine3d PosedMesh::worldFromVertex(const ClusterGeometry& geometry, uint32_t vertex) const
{
    if (geometry.influenceCount() == 0)
        return palette_.front();
    const std::array<uint32_t, 8> joints = geometry.joints(vertex);
    const std::array<uint32_t, 8> codes = geometry.weightCodes(vertex);
    Affine3d sum;
    for (auto& row : sum.m)
        std::fill(std::begin(row), std::end(row), 0.0);
    for (size_t i = 0; i < joints.size(); ++i)
    {
        if (codes[i] == 0 || joints[i] >= palette_.size())
            continue;
        for (size_t r = 0; r < 3; ++r)
            for (size_t c = 0; c < 4; ++c)
                sum.m[r][c] += codes[i] / 65535.0 * palette_[joints[i]].m[r][c];
    }
    return sum;
}

PosedVertex PosedMesh::vertex(const ClusterGeometry& geometry, uint32_t vertex) const
{
    Double3 position = widen(geometry.position(vertex));
    Double3 normal = geometry.has(kVertexNormal) ? widen(geometry.normal(vertex)) : Double3{};
    for (uint32_t i = 0; i < geometry.morphCount(); ++i)
    {
        const uint32_t target = geometry.morphTarget(i);
        const double weight = target < morph_weights_.size() ? morph_weights_[target] : 0;
        position = position + widen(geometry.morphPosition(i, vertex)) * weight;
        normal = normal + widen(geometry.morphNormal(i, vertex)) * weight;
    }
    const Affine3d world_from_vertex = worldFromVertex(geometry, vertex);
    PosedVertex posed;
    posed.position = narrow(transformPoint(world_from_vertex, position));
    // normals are transformed by the cofactors of the linear part
    const Double3 x = column(world_from_vertex, 0), y = column(world_from_vertex, 1),
                  z = column(world_from_vertex, 2);
    posed.mirrored = dot(cross(x, y), z) < 0;
    const Double3 turned = cross(y, z) * normal.x + cross(z, x) * normal.y + cross(x, y) * normal.z;
    const double size = length(turned) * (posed.mirrored ? -1 : 1);
    posed.normal = size != 0 && std::isfinite(size) ? narrow(turned * (1 / size)) : narrow(normal);
    if (geometry.has(kVertexVisibility))
        posed.m1 = turnVector(world_from_vertex, widen(geometry.visibility(vertex).m1),
                              widen(geometry.normal(vertex)), widen(posed.normal));
    return posed;
}

} // namespace hearth::command
