// Exports cameras.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"

namespace hearth::gltf_export
{

/// Add all cameras, with the indices that they have in the pack, and give them to their nodes, which
/// the document has.
void addCameras(GltfDocument& document, const formats::PackView& pack);

} // namespace hearth::gltf_export
