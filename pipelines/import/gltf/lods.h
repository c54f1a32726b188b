// Finds authored levels of detail: MSFT_lod, and nodes or meshes called X_LOD0, X_LOD1, ...
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"

#include <vector>

namespace hearth::import
{

/// Level of detail of a mesh: another mesh, with the transform of a node.
struct GltfLod
{
    uint32_t mesh = kInvalidIndex;
    uint32_t node = kInvalidIndex; ///< kInvalidIndex: no node has it, and the finer mesh's node places it
};

/// Mesh with its levels, finest first, from the first node that lists any.
struct GltfLodChain
{
    uint32_t mesh = kInvalidIndex;
    uint32_t node = kInvalidIndex;
    std::vector<GltfLod> lods;
};

struct GltfLods
{
    std::vector<GltfLodChain> chains; ///< by mesh, ascending
    std::vector<bool> hidden;   ///< nodes that are levels of others, with all nodes below them: not drawn
    std::vector<bool> lod_only; ///< meshes that are drawn only as levels of others

    /// For each node, the world transform of its vertices as a level: relative to the finer node's parent if
    /// the node is in no scene.
    std::vector<Transform> world_from_node;
};

/// Find all levels. An unusable level is dropped, with a warning that names it.
GltfLods findLods(const GltfModel& model, const GltfContext& context);

} // namespace hearth::import
