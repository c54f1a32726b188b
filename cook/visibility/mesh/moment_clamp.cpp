// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/mesh/moment_clamp.h"

#include "formats/base/double3.h"

#include <algorithm>
#include <numbers>

namespace hearth::visibility
{

namespace
{

// Tolerance as a share of 2 pi: rounding of a fit where everything is open is not counted as out of bounds.
constexpr double kTolerance = 1e-6;

} // namespace

Moments openHemisphere(Float3 normal)
{
    return {static_cast<float>(2 * std::numbers::pi), normal * static_cast<float>(std::numbers::pi)};
}

bool clampMoments(Moments& moments, Float3 normal)
{
    if (!std::isfinite(moments.m0) || !isFinite(moments.m1))
    {
        moments = {};
        return true;
    }
    constexpr double kMaxM0 = 2 * std::numbers::pi;
    const double m0 = std::clamp<double>(moments.m0, 0, kMaxM0);
    Double3 m1 = widen(moments.m1);
    const Double3 n = widen(normal);
    m1 = m1 - n * std::min(dot(m1, n), 0.0);
    const double max_size = m0 * (1 - m0 / (2 * kMaxM0)), size = length(m1);
    if (size > max_size)
        m1 = m1 * (max_size / size);
    const Double3 moved = m1 - widen(moments.m1);
    const bool changed =
        std::abs(m0 - double{moments.m0}) > kMaxM0 * kTolerance || length(moved) > kMaxM0 * kTolerance;
    // values that were not clamped keep their bits
    moments = {static_cast<float>(m0), narrow(m1)};
    return changed;
}

} // namespace hearth::visibility
