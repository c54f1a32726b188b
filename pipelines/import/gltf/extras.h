// Writes the extras of a glTF file: custom properties, which the game reads and Hearth only carries.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/buffers.h"
#include "pipelines/import/gltf/mesh_uses.h"

namespace hearth::import
{

/// Write the extras of the objects that the part has, after all of them have been written. Extras of other
/// objects, such as textures and accessors, are named in a warning.
/// document  parsed from `text`
/// errors    input_too_large: the extras of an object are longer than kMaxExtrasBytes
Status writeExtras(const JsonDocument& document, std::string_view text, const GltfModel& model,
                   const MeshUses& uses, const GltfContext& context);

} // namespace hearth::import
