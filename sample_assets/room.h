// Generates a furnished room: many materials, two point lights, a spot light and shiny surfaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the room: 6 m x 5 m x 2.8 m around the origin, floor at height 0, one camera "room" inside.
Document makeRoom();

} // namespace hearth::samples
