// LOD curve: weight of a group's error by distance. C++ only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/gpu_shared/records.h"

#include <span>

namespace hearth::shared
{

/// Knot of a piecewise linear curve that is constant before the first and after the last knot.
struct LodKnot
{
    float distance; ///< metres from the eye, 0 or more, less than the next knot's
    /// factor on the projected error: above 1 is finer. At most 8 times the next one's, and vice versa
    float factor;
};

/// Maximum number of knots.
inline constexpr size_t kMaxLodKnots = kLodKnots;

/// Multiply the errors of a frame by `curve(distance)`. An empty curve is 1 everywhere. A factor may grow
/// with the distance, but never faster than the distance itself: else an error would weigh more from farther
/// away, a group could be refined while its coarser neighbour above is not, and the cut would overlap itself.
/// errors: usage, naming the knot.
Status setLodCurve(FrameView& view, std::span<const LodKnot> curve);

} // namespace hearth::shared
