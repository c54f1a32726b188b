// Generates an attic: an L-shaped room below two slanted roofs, lit by the sun and the sky through a window
// and by a paper lantern.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the attic: 7 m x 7 m x 3 m, floor at height 0, cameras "attic" and "side_wing". Neither its walls nor
/// its furniture lie on a round number of decimetres.
Document makeAttic();

} // namespace hearth::samples
