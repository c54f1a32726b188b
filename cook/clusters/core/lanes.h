// SIMD arithmetic on four numbers side by side.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace hearth::clusters
{

inline float inverseOr0(float x)
{
    return x > 0 ? 1.0f / x : 0.0f;
}

/// Vector of four floats: the width that every x86-64 and ARM64 processor has.
inline constexpr size_t kLanes = 4;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneMask = int32_t __attribute__((vector_size(kLanes * sizeof(int32_t))));

inline Lanes splat(float x)
{
    return Lanes{x, x, x, x};
}
inline Lanes minimum(Lanes a, Lanes b)
{
    return a < b ? a : b;
}
inline Lanes maximum(Lanes a, Lanes b)
{
    return a > b ? a : b;
}
inline bool anyLane(LaneMask mask)
{
    const auto halves = std::bit_cast<std::array<uint64_t, 2>>(mask);
    return (halves[0] | halves[1]) != 0;
}
inline float sumOfLanes(Lanes x)
{
    return (x[0] + x[1]) + (x[2] + x[3]);
}
inline float minLane(Lanes x)
{
    return std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
}
inline float maxLane(Lanes x)
{
    return std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
}
/// Clamp to [0, 1]; NaN becomes 0.
inline Lanes clampToUnit(Lanes x)
{
    return minimum(maximum(x, splat(0)), splat(1));
}

/// Transpose a 4 x 4 matrix of rows.
inline std::array<Lanes, kLanes> transposed(const std::array<Lanes, kLanes>& r)
{
    const Lanes low01 = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5);
    const Lanes high01 = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
    const Lanes low23 = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
    const Lanes high23 = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
    return {__builtin_shufflevector(low01, low23, 0, 1, 4, 5),
            __builtin_shufflevector(low01, low23, 2, 3, 6, 7),
            __builtin_shufflevector(high01, high23, 0, 1, 4, 5),
            __builtin_shufflevector(high01, high23, 2, 3, 6, 7)};
}

struct LaneVector
{
    Lanes x, y, z;
};
inline LaneVector operator-(LaneVector a, LaneVector b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline LaneVector operator+(LaneVector a, LaneVector b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline LaneVector operator*(LaneVector a, Lanes s)
{
    return {a.x * s, a.y * s, a.z * s};
}
inline Lanes dot(LaneVector a, LaneVector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LaneVector splat(Float3 p)
{
    return {splat(p.x), splat(p.y), splat(p.z)};
}
/// Return the sums of x, of y and of z over the lanes, and 0.
inline Lanes sumsOfLanes(LaneVector v)
{
    const std::array<Lanes, kLanes> columns = transposed({v.x, v.y, v.z, Lanes{}});
    return (columns[0] + columns[1]) + (columns[2] + columns[3]);
}

} // namespace hearth::clusters
