// Intervals and axis-aligned boxes in double precision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hearth::animation_bounds
{

/// Closed interval; empty until a value is added.
struct Interval
{
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void grow(double by)
    {
        low -= by;
        high += by;
    }
    bool empty() const { return !(low <= high); }
    bool contains(double value) const { return value >= low && value <= high; }
    double middle() const { return 0.5 * (low + high); }
    double half() const { return 0.5 * (high - low); }
    /// Return the largest absolute value.
    double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
};

using Box3d = std::array<Interval, 3>;

inline void add(Box3d& box, Double3 point)
{
    box[0].add(point.x);
    box[1].add(point.y);
    box[2].add(point.z);
}

inline Double3 middle(const Box3d& box)
{
    return {box[0].middle(), box[1].middle(), box[2].middle()};
}

inline Double3 half(const Box3d& box)
{
    return {box[0].half(), box[1].half(), box[2].half()};
}

} // namespace hearth::animation_bounds
