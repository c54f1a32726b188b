// Decodes KHR_draco_mesh_compression: a primitive's indices and attributes compressed by Draco.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/model.h"

namespace hearth::import
{

struct DracoAttribute
{
    uint32_t id = 0;              ///< in the compressed data
    uint32_t component_count = 1; ///< requested by the accessor
    bool normalized = false;      ///< integers become -1..1 or 0..1
};

struct DracoMesh
{
    uint32_t vertex_count = 0;
    std::vector<uint32_t> indices;              ///< three for each triangle, all < vertex_count
    std::vector<std::vector<float>> attributes; ///< as requested, vertex_count * component_count each
};

/// Decode a primitive. errors: codec_failed, at `where`, also for a point cloud, a missing id or too few
/// components.
Result<DracoMesh> decodeDraco(std::span<const std::byte> compressed,
                              std::span<const DracoAttribute> attributes, const std::string& file,
                              const std::string& where);

} // namespace hearth::import
