// Generates many hemisphere directions at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/sampling/maps.h"

#include <cstdint>
#include <span>

namespace hearth::sampling
{

/// Map points `first`, `first` + 1, ... of the seed's owenSobol sequence to directions of the hemisphere
/// about frame.z: hemisphereDirection of each point, transformed by the frame. About 10 ns each.
/// x, y, z  of equal length; filled
void hemisphereDirections(uint32_t first, uint64_t seed, const Frame& frame, std::span<float> x,
                          std::span<float> y, std::span<float> z);

} // namespace hearth::sampling
