// Conservative rounding from double to single precision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace hearth
{

/// Return the smallest float that is not below `value`; the largest finite float if it is beyond the range or
/// no number, the lowest one if it is below it.
inline float roundUp(double value)
{
    constexpr float kMaxFloat = std::numeric_limits<float>::max();
    if (!(value < double{kMaxFloat}))
        return kMaxFloat;
    if (value <= -double{kMaxFloat})
        return -kMaxFloat;
    const auto nearest = static_cast<float>(value);
    if (double{nearest} >= value)
        return nearest;
    // the next float has the next bits; below 0 those before
    const auto bits = std::bit_cast<uint32_t>(nearest);
    return std::bit_cast<float>(nearest < 0 ? bits - 1 : bits + 1);
}

/// Return the largest float that is not above `value`, within the range of finite floats.
inline float roundDown(double value)
{
    return -roundUp(-value);
}

} // namespace hearth
