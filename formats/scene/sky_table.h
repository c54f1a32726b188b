// Makes the table of the sky's means over cones, and looks it up on the CPU as shaders do on the GPU (C++
// only).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/light_cone.h"
#include "formats/gpu_shared/sky.h"

#include <vector>

namespace hearth::shared
{

/// Return the nodes of the table, heights first: kSkyTableHeights * kSkyTableAngles words with the mean of
/// skyAbove in the low half and of skyAbove * skyHigh in the high half, as half floats. Computed once.
const std::vector<uint32_t>& skyTable();

/// Return the mean radiance over a cone, by the table.
Float3 skyConeRadiance(const Sky& sky, const LightCone& cone);

} // namespace hearth::shared
