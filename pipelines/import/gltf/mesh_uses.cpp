// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/mesh_uses.h"

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

/// Return the nodes in an order with parents before children; the model has no cycles.
std::vector<uint32_t> orderParentsFirst(const GltfModel& model)
{
    std::vector<uint32_t> order;
    order.reserve(model.nodes.size());
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
        if (model.nodes[node].parent == kInvalidIndex)
            order.push_back(node);
    for (size_t i = 0; i < order.size(); ++i)
    {
        const std::vector<uint32_t>& children = model.nodes[order[i]].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    return order;
}

/// True if the transform takes every point of the box to a position in the range of floats.
bool fitsFloats(const Transform& t, const Box3& box)
{
    for (const auto& row : t.m)
    {
        double most = std::abs(row[3]);
        for (int axis = 0; axis < 3; ++axis)
            most += std::abs(row[axis]) *
                    std::max(std::abs(double{box.min[axis]}), std::abs(double{box.max[axis]}));
        if (!(most <= double{std::numeric_limits<float>::max()}))
            return false;
    }
    return true;
}

} // namespace

uint32_t MeshUses::find(uint32_t mesh, uint32_t skin) const
{
    const auto found = std::find_if(uses.begin(), uses.end(),
                                    [&](const MeshUse& use) { return use.mesh == mesh && use.skin == skin; });
    return found == uses.end() ? kInvalidIndex : static_cast<uint32_t>(found - uses.begin());
}

MeshUses findMeshUses(const GltfModel& model)
{
    MeshUses uses;
    uses.uses.resize(model.meshes.size());
    uses.of_node.assign(model.nodes.size(), kInvalidIndex);
    std::vector<bool> seen(model.meshes.size());
    for (uint32_t mesh = 0; mesh < model.meshes.size(); ++mesh)
        uses.uses[mesh].mesh = mesh;
    for (uint32_t node = 0; node < model.nodes.size(); ++node)
    {
        const auto [mesh, skin] = MeshUse{model.nodes[node].mesh, model.nodes[node].skin};
        if (mesh == kInvalidIndex)
            continue;
        if (!seen[mesh])
        {
            seen[mesh] = true;
            uses.uses[mesh].skin = skin;
        }
        if (uses.find(mesh, skin) == kInvalidIndex)
            uses.uses.push_back({mesh, skin});
        uses.of_node[node] = uses.find(mesh, skin);
    }
    return uses;
}

std::vector<Transform> worldTransforms(const GltfModel& model)
{
    std::vector<Transform> world_from_node(model.nodes.size());
    for (const uint32_t node : orderParentsFirst(model))
    {
        const GltfNode& n = model.nodes[node];
        world_from_node[node] =
            n.parent == kInvalidIndex ? n.parent_from_node : world_from_node[n.parent] * n.parent_from_node;
    }
    return world_from_node;
}

SkinState skinState(const mesh::SourceMesh& mesh, const std::vector<bool>& used, const GltfSkin& skin,
                    const InverseBinds& inverse_binds, std::span<const Transform> world_from_node)
{
    HEARTH_ASSERT(used.size() <= skin.joints.size());
    Box3 box;
    for (const Float3 position : mesh.positions)
        box.add(position);
    bool moves = false;
    for (size_t joint = 0; joint < used.size(); ++joint)
    {
        if (!used[joint])
            continue;
        const Transform world_from_bind = world_from_node[skin.joints[joint]] * inverse_binds[joint];
        const std::optional<Affine3> narrow = narrowed(world_from_bind);
        if (!narrow || !narrowed(inverse_binds[joint]) || !fitsFloats(world_from_bind, box))
            return SkinState::too_large;
        moves = moves || determinant(*narrow) != 0;
    }
    return moves ? SkinState::usable : SkinState::idle;
}

bool skinMirrors(const std::vector<bool>& used, const GltfSkin& skin, const InverseBinds& inverse_binds,
                 std::span<const Transform> world_from_node)
{
    HEARTH_ASSERT(used.size() <= skin.joints.size());
    ptrdiff_t mirroring = 0;
    for (size_t joint = 0; joint < used.size(); ++joint)
        if (used[joint])
        {
            const double turned = determinant(world_from_node[skin.joints[joint]] * inverse_binds[joint]);
            mirroring += turned < 0 ? 1 : turned > 0 ? -1 : 0;
        }
    return mirroring > 0;
}

} // namespace hearth::import
