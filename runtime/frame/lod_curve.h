// C++ only: how much the error of a group counts at a distance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/gpu_shared/records.h"

#include <span>

namespace hearth::shared
{

/// A knot of a curve that is linear between its knots and constant beyond the first and the last.
struct LodKnot
{
    float distance; ///< metres from the eye, 0 or more, less than that of the next knot
    float factor;   ///< on the projected error: above 1 is finer. Within 8 times the next one's
};

/// At most so many knots.
inline constexpr size_t kMaxLodKnots = kLodKnots;

/// Make the errors of a frame count `curve(distance)` times. An empty curve is 1 everywhere.
/// A factor may grow with the distance, but never faster than it: else an error would count more seen from
/// farther away, a group could be refined whose coarser neighbour above is not, and the cut would overlap itself.
/// errors: usage, naming the knot.
Status setLodCurve(FrameView& view, std::span<const LodKnot> curve);

} // namespace hearth::shared
