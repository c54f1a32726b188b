// Writes the animations of a document into a GLB file: channels of nodes, and of lights
// (KHR_animation_pointer).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"
#include "sample_assets/shapes/glb_chunks.h"

namespace hearth::samples
{

/// Add "animations" and their accessors. Tracks must have a key at least, and as many values as keys
/// (asserted).
void addAnimations(Glb& glb, const Document& document);

} // namespace hearth::samples
