// Which meshes a part has: each mesh of the source with the skin that moves it, and whether a skin can.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/skins.h"

#include <vector>

namespace hearth::import
{

/// A mesh of the part: one of the source, with the skin of the nodes that have it.
struct MeshUse
{
    uint32_t mesh = formats::kNone; ///< of the source
    uint32_t skin = formats::kNone;
};

struct MeshUses
{
    std::vector<MeshUse>
        uses; ///< the source's meshes, each as its first node has it; then those of other skins
    std::vector<uint32_t> of_node; ///< the part's mesh of each node, or kNone

    /// The part's mesh that is mesh `mesh` of the source with this skin, or kNone.
    uint32_t find(uint32_t mesh, uint32_t skin) const;
};

/// A mesh of the part has at most one skin: where nodes give a mesh several, or none beside one, the further ones get
/// copies of it behind all others.
MeshUses findMeshUses(const GltfModel& model);

/// The transform of every node to the space of the scene.
std::vector<Transform> worldTransforms(const GltfModel& model);

enum class SkinState
{
    usable,
    idle,     ///< it moves no vertex, or all its joints shrink the mesh to nothing in the rest pose
    too_large ///< the rest pose does not fit 32-bit numbers
};

/// Whether a skin can carry a mesh, by the joints that it uses. `used` may not be longer than the skin (asserted).
SkinState skinState(const mesh::SourceMesh& mesh, const std::vector<bool>& used, const GltfSkin& skin,
                    const InverseBinds& inverse_binds, std::span<const Transform> world_from_node);

/// Whether most of the joints that are used turn the mesh into its mirror image in the rest pose, which turns its
/// triangles over. `used` may not be longer than the skin (asserted).
bool skinMirrors(const std::vector<bool>& used, const GltfSkin& skin, const InverseBinds& inverse_binds,
                 std::span<const Transform> world_from_node);

} // namespace hearth::import
