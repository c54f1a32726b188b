// Decodes EXT_meshopt_compression: buffer views compressed by meshoptimizer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/model.h"

namespace hearth::import
{

/// Return the count * byte_stride bytes of a compressed view. `where` is its JSON pointer.
/// errors: gltf_extension_value (inconsistent stride, count, mode and filter), codec_failed.
Result<std::vector<std::byte>> decodeMeshopt(const GltfMeshopt& view, std::span<const std::byte> compressed,
                                             const std::string& file, const std::string& where);

} // namespace hearth::import
