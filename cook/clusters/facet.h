// Distances from a point to several triangles at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/lanes.h"
#include "formats/math.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace hearth::clusters
{

/// A triangle with what the distance to it needs: 16 numbers, four rows of four.
struct Facet
{
    Float3 a;
    Float3 ab;
    Float3 ac;
    float ab_ab, ab_ac, ac_ac;
    float inverse_det; ///< 0 for a needle: then only its edges count
    float inverse_ab, inverse_ac;
    float unused; ///< fills the fourth row
};

inline Facet makeFacet(Float3 a, Float3 b, Float3 c)
{
    Facet f{};
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

/// Facets side by side.
struct FacetBlock
{
    LaneVector a, ab, ac;
    Lanes ab_ab, ab_ac, ac_ac, inverse_det, inverse_ab, inverse_ac;

    struct Coordinates
    {
        Lanes v, w; ///< the point's projection is a + v ab + w ac; 0 in needles
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

    /// A point of each facet that is near to the given one: the nearest where that projects into the facet; elsewhere two
    /// steps along the edges come close to it, at half the cost of comparing the three edges.
    Nearest nearest(Float3 point) const
    {
        const LaneVector ap = allLanes(point) - a;
        const Lanes ab_ap = dot(ab, ap);
        const Lanes ac_ap = dot(ac, ap);
        Lanes v = clampToUnit((ac_ac * ab_ap - ab_ac * ac_ap) * inverse_det);
        const Lanes w = minimum(maximum((ac_ap - ab_ac * v) * inverse_ac, allLanes(0)), allLanes(1) - v);
        v = minimum(maximum((ab_ap - ab_ac * w) * inverse_ab, allLanes(0)), allLanes(1) - w);
        const LaneVector away = ap - ab * v - ac * w;
        return {v, w, dot(away, away)};
    }

    /// Squared distances of a point, never too small: each is the distance to some point of the facet.
    Lanes distance2(Float3 point) const { return nearest(point).distance2; }
};

/// Row r of the four facets' numbers: four numbers of each.
struct FacetRow
{
    Lanes of[kLanes];
};

/// From numbers facet by facet to facets number by number.
inline FacetRow transpose(const std::array<const Facet*, kLanes>& facets, size_t row)
{
    Lanes r[kLanes];
    for (size_t i = 0; i < kLanes; ++i)
        std::memcpy(&r[i], reinterpret_cast<const float*>(facets[i]) + row * kLanes, sizeof(Lanes));
    const Lanes low01 = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5);
    const Lanes high01 = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
    const Lanes low23 = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
    const Lanes high23 = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
    return {{__builtin_shufflevector(low01, low23, 0, 1, 4, 5),
             __builtin_shufflevector(low01, low23, 2, 3, 6, 7),
             __builtin_shufflevector(high01, high23, 0, 1, 4, 5),
             __builtin_shufflevector(high01, high23, 2, 3, 6, 7)}};
}

inline FacetBlock makeBlock(const std::array<const Facet*, kLanes>& facets)
{
    static_assert(sizeof(Facet) == 4 * sizeof(Lanes));
    const FacetRow r0 = transpose(facets, 0);
    const FacetRow r1 = transpose(facets, 1);
    const FacetRow r2 = transpose(facets, 2);
    const FacetRow r3 = transpose(facets, 3);
    return {.a = {r0.of[0], r0.of[1], r0.of[2]},
            .ab = {r0.of[3], r1.of[0], r1.of[1]},
            .ac = {r1.of[2], r1.of[3], r2.of[0]},
            .ab_ab = r2.of[1],
            .ab_ac = r2.of[2],
            .ac_ac = r2.of[3],
            .inverse_det = r3.of[0],
            .inverse_ab = r3.of[1],
            .inverse_ac = r3.of[2]};
}

} // namespace hearth::clusters
