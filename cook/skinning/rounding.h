// From bounds in double precision to what records hold.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "formats/base/math.h"

namespace hearth::skinning
{

/// `value` as a float that is not smaller; the largest finite float if it is beyond them.
float roundUp(double value);

/// The box as floats, with room for a runtime that skins in single precision: 2e-6 of its farthest coordinate.
Box3 roundedOut(const motion::Box3d& box);

} // namespace hearth::skinning
