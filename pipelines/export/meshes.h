// Exports a cut of a mesh: one primitive a material, with vertices that clusters share welded again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"

namespace hearth::gltf_export
{

/// True if joints or morph targets can move the vertices of the mesh.
bool isDeformed(const formats::MeshRecord& mesh);

/// Add the cut of mesh `mesh` at an error in its own units. Positions and all other attributes are the
/// pack's, decoded; vertices of one material are welded where all attributes are equal, bit by bit.
/// Returns the mesh of the document, or kInvalidIndex if the cut has no triangles.
/// errors: those of PageCache::clusterGeometry
Result<uint32_t> addMesh(GltfDocument& document, const formats::PackView& pack, uint32_t mesh, float error);

} // namespace hearth::gltf_export
