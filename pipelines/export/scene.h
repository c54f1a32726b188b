// Exports the nodes: names, hierarchy, transforms, meshes, and levels of detail where asked for.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"

#include <optional>
#include <vector>

namespace hearth::gltf_export
{

/// Choice of what is written.
struct ExportOptions
{
    std::optional<uint32_t> mesh; ///< none: the whole scene
    float error = 0;              ///< of the cut, in the units of each mesh
    bool has_lods = false;        ///< coarser levels as MSFT_lod
};

/// Mesh of the document for each mesh of the pack, or kInvalidIndex: it is not drawn, or has no
/// triangles.
using ExportedMeshes = std::vector<uint32_t>;

/// Add the nodes of the pack with their indices, then one below a node for each copy of a mesh that it
/// draws several times, then those of levels of detail, which no scene has.
/// errors: those of addMesh
Result<ExportedMeshes> addScene(GltfDocument& document, const formats::PackView& pack,
                                const ExportOptions& options);

/// Add one node that has mesh `options.mesh` in its own space.
/// errors: those of addMesh
Result<ExportedMeshes> addLoneMesh(GltfDocument& document, const formats::PackView& pack,
                                   const ExportOptions& options);

} // namespace hearth::gltf_export
