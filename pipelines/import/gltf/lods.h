// Levels of detail that the artist made: MSFT_lod, and nodes or meshes called X_LOD0, X_LOD1, ...
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"

#include <vector>

namespace hearth::import
{

/// One level of a mesh: another mesh, as it stands in a node.
struct GltfLod
{
    uint32_t mesh = formats::kNone;
    uint32_t node = formats::kNone; ///< kNone: no node has it, it stands where the finer one does
};

/// A mesh with its levels, finest first, as the first node has it that names them.
struct GltfLodChain
{
    uint32_t mesh = formats::kNone;
    uint32_t node = formats::kNone;
    std::vector<GltfLod> lods;
};

struct GltfLods
{
    std::vector<GltfLodChain> chains; ///< by mesh, ascending
    std::vector<bool> hidden;   ///< nodes that are levels of others, and what stands below them: not drawn
    std::vector<bool> lod_only; ///< meshes that are drawn as levels of others alone

    /// Where the level's vertices stand in the world: like the finer node, if it has no place of its own.
    std::vector<Transform> world_from_node;
};

/// Find all levels. What is not usable is left out, with a warning that names it.
GltfLods findLods(const GltfModel& model, const GltfContext& context);

} // namespace hearth::import
