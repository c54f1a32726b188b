// Removes the specks that few paths leave in a picture of light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>

namespace hearth::reflections
{

/// Spread light that few paths have found by chance over the texels around: the sum of all texels stays. A
/// speck is three times the median of the 9 x 9 texels about it, unless a third of these are as bright.
/// light  side x side texels of a face, row by row
void spreadSpecks(std::span<Float3> light, uint32_t side);

} // namespace hearth::reflections
