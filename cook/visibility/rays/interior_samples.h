// Samples that nobody looks at, as those of a floor below a rug.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/rays.h"

#include <span>
#include <vector>

namespace hearth::visibility
{

/// Whether something covers a point closely: of its rays, of which all but a few met something, most did within `reach`.
/// The same for any number of threads.
///
/// moments  of each point: those that see more than a tenth of their hemisphere are not buried, and cost nothing
/// reach    metres, for each point
/// seed     of the rays; a sequence for each point
std::vector<uint8_t> buriedPoints(const Occluders& occluders, std::span<const SamplePoint> points,
                                  std::span<const Moments> moments, std::span<const float> reach,
                                  uint64_t seed);

} // namespace hearth::visibility
