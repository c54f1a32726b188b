// Generates a gallery that eight lamps light: three hang, two are spots, three are surfaces that shine.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the gallery: 16 m x 10 m x 4 m around the origin, floor at height 0, three bays between two walls
/// with a doorway each, cameras "gallery" and "east". Its lamps are the nodes "pendant_west",
/// "pendant_middle", "pendant_east", "spot_stone", "spot_painting", "neon", "light_box" and "sign". Its walls
/// have UVs that overlap, so that a cook has to make those for baked light.
Document makeGallery();

} // namespace hearth::samples
