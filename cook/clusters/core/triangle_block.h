// Computes distances from a point to several triangles at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/lanes.h"
#include "formats/base/math.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace hearth::clusters
{

/// Triangle with precomputed terms for point-triangle distance: 16 numbers, four rows of four.
struct DistanceTriangle
{
    Float3 a;
    Float3 ab;
    Float3 ac;
    float ab_ab, ab_ac, ac_ac;
    float inverse_det; ///< 0 for a needle: then only its edges count
    float inverse_ab, inverse_ac;
    float unused; ///< fills the fourth row
};

inline DistanceTriangle makeDistanceTriangle(Float3 a, Float3 b, Float3 c)
{
    DistanceTriangle f{};
    f.a = a;
    f.ab = b - a;
    f.ac = c - a;
    f.ab_ab = dot(f.ab, f.ab);
    f.ab_ac = dot(f.ab, f.ac);
    f.ac_ac = dot(f.ac, f.ac);
    const float det = f.ab_ab * f.ac_ac - f.ab_ac * f.ab_ac;
    f.inverse_det = det > 1e-5f * f.ab_ab * f.ac_ac ? 1.0f / det : 0.0f;
    f.inverse_ab = inverseOr0(f.ab_ab);
    f.inverse_ac = inverseOr0(f.ac_ac);
    return f;
}

/// Triangles side by side, one in each lane.
struct TriangleBlock
{
    LaneVector a, ab, ac;
    Lanes ab_ab, ab_ac, ac_ac, inverse_det, inverse_ab, inverse_ac;

    struct Coordinates
    {
        Lanes v, w; ///< the projection of the point is a + v ab + w ac; 0 in needles
    };

    Coordinates project(LaneVector point) const
    {
        const LaneVector ap = point - a;
        const Lanes ab_ap = dot(ab, ap);
        const Lanes ac_ap = dot(ac, ap);
        return {(ac_ac * ab_ap - ab_ac * ac_ap) * inverse_det, (ab_ab * ac_ap - ab_ac * ab_ap) * inverse_det};
    }

    struct Nearest
    {
        Lanes v, w; ///< a + v ab + w ac
        Lanes distance2;
    };

    /// Find a point of each triangle near the given point. It is the nearest point where the given one
    /// projects into the triangle. Elsewhere two steps along the edges come close to it, at half the cost of
    /// comparing three edges.
    Nearest nearest(Float3 point) const
    {
        const LaneVector ap = splat(point) - a;
        const Lanes ab_ap = dot(ab, ap);
        const Lanes ac_ap = dot(ac, ap);
        Lanes v = clampToUnit((ac_ac * ab_ap - ab_ac * ac_ap) * inverse_det);
        const Lanes w = minimum(maximum((ac_ap - ab_ac * v) * inverse_ac, splat(0)), splat(1) - v);
        v = minimum(maximum((ab_ap - ab_ac * w) * inverse_ab, splat(0)), splat(1) - w);
        const LaneVector away = ap - ab * v - ac * w;
        return {v, w, dot(away, away)};
    }

    /// Return the squared distances of a point. Never too small: each is the distance to some point of the
    /// triangle.
    Lanes distance2(Float3 point) const { return nearest(point).distance2; }
};

/// Transpose a row of four numbers from triangle-major to number-major order.
/// row  index of the row
inline std::array<Lanes, kLanes> transposedRow(const std::array<const DistanceTriangle*, kLanes>& triangles,
                                               size_t row)
{
    std::array<Lanes, kLanes> of_triangles;
    for (size_t i = 0; i < kLanes; ++i)
        std::memcpy(&of_triangles[i], reinterpret_cast<const float*>(triangles[i]) + row * kLanes,
                    sizeof(Lanes));
    return transposed(of_triangles);
}

inline TriangleBlock makeTriangleBlock(const std::array<const DistanceTriangle*, kLanes>& triangles)
{
    static_assert(sizeof(DistanceTriangle) == 4 * sizeof(Lanes));
    const std::array<Lanes, kLanes> r0 = transposedRow(triangles, 0);
    const std::array<Lanes, kLanes> r1 = transposedRow(triangles, 1);
    const std::array<Lanes, kLanes> r2 = transposedRow(triangles, 2);
    const std::array<Lanes, kLanes> r3 = transposedRow(triangles, 3);
    return {.a = {r0[0], r0[1], r0[2]},
            .ab = {r0[3], r1[0], r1[1]},
            .ac = {r1[2], r1[3], r2[0]},
            .ab_ab = r2[1],
            .ab_ac = r2[2],
            .ac_ac = r2[3],
            .inverse_det = r3[0],
            .inverse_ab = r3[1],
            .inverse_ac = r3[2]};
}

} // namespace hearth::clusters
