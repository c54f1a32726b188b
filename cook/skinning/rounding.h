// Conservative rounding of boxes for a runtime that skins in single precision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "formats/base/math.h"

namespace hearth::skinning
{

/// Round a box outwards, with a margin for a runtime that skins in single precision: 2e-6 of its farthest
/// coordinate.
Box3 roundOutwards(const animation_bounds::Box3d& box);

} // namespace hearth::skinning
