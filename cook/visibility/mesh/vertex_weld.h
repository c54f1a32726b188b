// Welds vertices that are the same point for lighting: equal position and equal normal within tolerances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Merge vertices whose positions differ by at most `position_tolerance` and whose normals differ by at most
/// `normal_tolerance` in each axis, and all vertices that a chain of such pairs connects. The result depends
/// neither on the order of pairs nor on borders of cells.
/// returns  for each vertex the first vertex that it is merged with
std::vector<uint32_t> weldVertices(std::span<const Float3> positions, std::span<const Float3> normals,
                                   double position_tolerance, double normal_tolerance);

} // namespace hearth::visibility
