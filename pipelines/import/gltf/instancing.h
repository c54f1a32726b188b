// Reads EXT_mesh_gpu_instancing: many copies of a node's mesh.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/accessors.h"
#include "pipelines/import/gltf/vertices.h"

namespace hearth::import
{

/// Return node_from_copy for each copy of node `index`. errors: gltf_extension_value (formats, counts that
/// differ, numbers that are not finite), input_too_large.
Result<std::vector<Transform>> readInstancing(const GltfNode& node, uint32_t index, GltfAccessors& accessors,
                                              const GltfContext& context, GltfTally& tally);

} // namespace hearth::import
