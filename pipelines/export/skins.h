// Exports skins: joints and inverse bind matrices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/export/gltf_document.h"

namespace hearth::gltf_export
{

/// Add all skins, with the indices that they have in the pack. A skeleton root that is not above all
/// joints is left out: it changes nothing, and validators refuse it.
void addSkins(GltfDocument& document, const formats::PackView& pack);

} // namespace hearth::gltf_export
