// Splits the two forms of a glTF file: JSON text, and GLB with the JSON and one binary buffer in chunks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hearth::import
{

struct GltfContainer
{
    std::string_view json;
    std::optional<std::span<const std::byte>> binary; ///< chunk BIN of a GLB
};

/// Split a file; its content decides the form. errors: glb_structure, gltf_version (of the container).
Result<GltfContainer> splitGltf(std::span<const std::byte> bytes, const std::string& file);

} // namespace hearth::import
