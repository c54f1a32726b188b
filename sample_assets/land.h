// Generates the scene of ./dev bench bricks: ground of the same area as in the conference talk that it is
// compared with, with rocks and houses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the scene: 512 x 512 m of hills, less than 128 m high, of about `ground_triangles` in 64 plots; 120
/// rocks of 100,000 triangles each, instances of four shapes, and 12 houses with open doors and windows and a
/// lamp inside; a sun; one camera "land". `texture_size`: size of the ground's colour image.
Document makeLand(uint64_t ground_triangles, uint32_t texture_size);

} // namespace hearth::samples
