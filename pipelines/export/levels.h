// Exports the coarser levels of meshes as MSFT_lod.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"

#include <span>

namespace hearth::gltf_export
{

/// Add a mesh for each level that is coarser than the cut at `error`, and nodes for the levels of each
/// node that draws a mesh; authored levels are cuts like the others. No scene has the nodes of levels.
/// meshes  of the document, for each mesh of the pack
/// errors: those of addMesh
Status addLevels(GltfDocument& document, const formats::PackView& pack, std::span<const uint32_t> meshes,
                 float error);

} // namespace hearth::gltf_export
