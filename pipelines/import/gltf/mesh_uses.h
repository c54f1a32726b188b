// Finds the meshes of a part: each mesh of the source with the skin that moves it, and checks if a skin can
// move it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/skins.h"

#include <vector>

namespace hearth::import
{

/// Mesh of the part: a mesh of the source with the skin of its nodes.
struct MeshUse
{
    uint32_t mesh = kInvalidIndex; ///< of the source
    uint32_t skin = kInvalidIndex;
};

struct MeshUses
{
    /// the source's meshes, each with the skin of its first node; then copies for other skins
    std::vector<MeshUse> uses;
    std::vector<uint32_t> of_node; ///< mesh of the part for each node, or kInvalidIndex

    /// Return the part's mesh for mesh `mesh` of the source with this skin, or kInvalidIndex.
    uint32_t find(uint32_t mesh, uint32_t skin) const;
};

/// Find the meshes of the part. A mesh of the part has at most one skin: if nodes give a mesh several skins,
/// or a skin and none, each further one gets a copy of the mesh, after all others.
MeshUses findMeshUses(const GltfModel& model);

/// Return the transform of every node to scene space.
std::vector<Transform> worldTransforms(const GltfModel& model);

enum class SkinState
{
    usable,
    idle,     ///< moves no vertex, or all its joints shrink the mesh to nothing in the rest pose
    too_large ///< the rest pose does not fit 32-bit numbers
};

/// Classify a skin by the joints that the mesh uses. `used` may not be longer than the skin (asserted).
SkinState skinState(const mesh::SourceMesh& mesh, const std::vector<bool>& used, const GltfSkin& skin,
                    const InverseBinds& inverse_binds, std::span<const Transform> world_from_node);

/// True if most of the used joints mirror the mesh in the rest pose, which reverses the winding of its
/// triangles. `used` may not be longer than the skin (asserted).
bool skinMirrors(const std::vector<bool>& used, const GltfSkin& skin, const InverseBinds& inverse_binds,
                 std::span<const Transform> world_from_node);

} // namespace hearth::import
