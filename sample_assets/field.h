// Generates the scene of ./dev bench runtime and cook: a field of rocks with the counts of the conference
// talk that it is compared with.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the scene: 40 rocks of `rock_triangles` each, instances of `rock_shapes` (a divisor of 40); 4096
/// tiles of ground of 1024 triangles, 64 tiles a mesh; 10,000 tufts of grass of 20 triangles; a sun and a
/// painted sky; one camera "field", which looks along -Z. `texture_size`: size of the ground's colour image.
Document makeField(uint64_t rock_triangles, uint32_t rock_shapes, uint32_t texture_size);

} // namespace hearth::samples
