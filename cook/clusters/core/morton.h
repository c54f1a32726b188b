// Morton codes: numbers along the Z-order curve, on which near numbers are near positions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>

namespace hearth::clusters
{

/// Spread the low 21 bits so that two zero bits follow each.
constexpr uint64_t spreadBits(uint64_t x)
{
    x &= 0x1FFFFF;
    x = (x | x << 32) & 0x1F00000000FFFF;
    x = (x | x << 16) & 0x1F0000FF0000FF;
    x = (x | x << 8) & 0x100F00F00F00F00F;
    x = (x | x << 4) & 0x10C30C30C30C30C3;
    return (x | x << 2) & 0x1249249249249249;
}

/// Morton code of a point in a box, 21 bits an axis. All axes share one scale, so that cells are cubes.
inline uint64_t mortonCode(Float3 p, const Box3& box)
{
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis)
        extent = std::max(extent, double{box.max[axis]} - box.min[axis]);
    uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double unit = extent > 0 ? (double{p[axis]} - box.min[axis]) / extent : 0.0;
        code |= spreadBits(static_cast<uint64_t>(std::clamp(unit, 0.0, 1.0) * 2097151.0)) << axis;
    }
    return code;
}

} // namespace hearth::clusters
