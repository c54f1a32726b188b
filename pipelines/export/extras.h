// Exports extras: the custom properties of objects.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"

#include <span>

namespace hearth::gltf_export
{

/// Indices of the document for objects of the pack that may be left out.
struct ExportedObjects
{
    std::span<const uint32_t> meshes;
    std::span<const uint32_t> animations;
};

/// Add the extras of all objects that the document has. Packs of several sources have asset, scene and
/// file several times: those of the first are written.
void addExtras(GltfDocument& document, const formats::PackView& pack, const ExportedObjects& objects);

} // namespace hearth::gltf_export
