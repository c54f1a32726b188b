// Exports materials: factors, textures, and the layers of KHR_materials_*.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"
#include "pipelines/export/omissions.h"

namespace hearth::gltf_export
{

/// Add all materials, with the indices that they have in the pack, and the textures that they use.
/// errors: those of PackView::imageData
Status addMaterials(GltfDocument& document, const formats::PackView& pack, Omissions& omissions);

} // namespace hearth::gltf_export
