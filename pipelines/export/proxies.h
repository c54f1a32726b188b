// Exports proxies as nodes below those of their meshes, by the names that game engines know.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"
#include "pipelines/export/omissions.h"

#include <span>

namespace hearth::gltf_export
{

/// Add each proxy of a mesh below the first node that has the mesh, at the same place: as X_PROXY, with a
/// primitive for each section, or where sections are convex as UCX_X_01, UCX_X_02, ..., one for each, where X
/// is the name of that node. A node of that name without contents, which the source's proxy has left, is
/// moved there; a new one says the same to Hearth by the extra hearth_proxy. Proxies of meshes that no node
/// has are counted as omissions.
/// meshes  of the document, for each mesh of the pack
void addProxies(GltfDocument& document, const formats::PackView& pack, std::span<const uint32_t> meshes,
                Omissions& omissions);

} // namespace hearth::gltf_export
