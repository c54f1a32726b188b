// hearth extract -o X.glb: writes a pack, or a cut of one of its meshes, as glTF.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/export/export_gltf.h"

#include <string>

namespace hearth::command
{

/// True if a file is written as glTF: its name ends in ".glb".
bool isGltfName(const std::string& output);

/// Write the pack. Returns the text for people: counts, and a line for each kind of thing that glTF does not
/// say.
/// errors: usage if the mesh does not exist; those of openPack and exportGltf
Result<std::string> extractGltf(const std::string& path, const gltf_export::ExportOptions& options,
                                const std::string& output);

} // namespace hearth::command
