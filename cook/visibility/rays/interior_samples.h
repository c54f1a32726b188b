// Finds interior samples, which are never visible, such as those of a floor below a rug.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/rays.h"

#include <span>
#include <vector>

namespace hearth::visibility
{

/// Find points that something covers closely: almost all of a point's rays hit something, and most of them
/// hit within `reach`. The same for any number of threads.
///
/// moments  of each point: those that see more than a tenth of their hemisphere are not interior, and cost
///          nothing
/// reach    metres, for each point
/// seed     of the rays; each point has a sequence of its own
/// returns  1 for each interior point, else 0
std::vector<uint8_t> findInteriorPoints(const Occluders& occluders, std::span<const SamplePoint> points,
                                        std::span<const Moments> moments, std::span<const float> reach,
                                        uint64_t seed);

} // namespace hearth::visibility
