// Exports clips: the keys of nodes, morph weights and lights as the pack has them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"
#include "pipelines/export/omissions.h"

#include <vector>

namespace hearth::gltf_export
{

/// Add all clips. A clip that ends after its last key gets one more, which repeats it. Returns the
/// clip of the document for each of the pack, or kInvalidIndex: clips that move nothing cannot be
/// written.
std::vector<uint32_t> addAnimations(GltfDocument& document, const formats::PackView& pack,
                                    Omissions& omissions);

} // namespace hearth::gltf_export
