// Sharp mips of a sky: what the camera sees behind a scene, finer than what surfaces reflect.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/probes/prefilter.h"

namespace hearth::probes
{

/// Return the number of mips above one of `side` that an environment has detail for, up to `max_side`. A
/// lat-long image has a quarter of its width around a face.
uint32_t countSharpMips(const environment::Environment& environment, uint32_t side, uint32_t max_side);

/// Average an environment times `scale` over each texel of a cube, by 4 x 4 points of the texel. The same for
/// any number of threads.
ProbeMip averageSharply(const environment::Environment& environment, double scale, uint32_t side);

} // namespace hearth::probes
