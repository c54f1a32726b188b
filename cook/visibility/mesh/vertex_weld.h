// Which vertices are one point of the surface to light: the same place, facing the same way.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Vertices whose positions are no farther apart than `position_tolerance` and whose normals no farther than
/// `normal_tolerance`, in each axis, are one, and so are those that a chain of such pairs connects: the answer knows
/// no order, and no border of a cell can part two of them.
/// returns  for each vertex the first of those that are one with it
std::vector<uint32_t> weldVertices(std::span<const Float3> positions, std::span<const Float3> normals,
                                   double position_tolerance, double normal_tolerance);

} // namespace hearth::visibility
