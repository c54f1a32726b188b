// Adapter of CGAL: wraps triangles, and finds where triangles intersect. CGAL's code for meshes is under the
// GPL, and slow to compile: only cgal_wrap.cpp includes it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/wrap/source_tree.h"
#include "cook/wrap/surface.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hearth::wrap
{

struct TrianglePair
{
    uint32_t a;
    uint32_t b; ///< larger than a

    friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// Compute the alpha wrap of triangles: a closed surface around them that no ball of radius alpha, coming
/// from outside, can get through, about `offset` in front of them. Oriented outwards, in a canonical order of
/// vertices and triangles. Its vertices are rounded to floats, so whoever needs its guarantees checks them.
/// source   each triangle has an area
/// returns  nullopt if it takes more than max_seconds of this thread's processor time
std::optional<Surface> computeAlphaWrap(const SourceTree& source, double alpha_m, double offset_m,
                                        double max_seconds);

struct SelfIntersections
{
    uint64_t count = 0;              ///< pairs of triangles
    std::vector<TrianglePair> pairs; ///< sorted; the first ones, if not all
};

/// Find the pairs of triangles that intersect. Triangles with a common edge intersect if they overlap in one
/// plane, those with a common corner if they meet beyond it; two with the same corners do.
/// surface  a position has one index; each triangle has an area
/// returns  nullopt if it takes more than max_seconds of this thread's processor time
std::optional<SelfIntersections> findSelfIntersections(const Surface& surface, size_t max_pairs,
                                                       double max_seconds);

/// True if all points lie inside a closed surface that does not intersect itself.
bool containsPoints(const Surface& surface, std::span<const Float3> points);

/// Find the triangles of a surface that touch one of the source, in order.
std::vector<uint32_t> findTouching(const Surface& surface, const SourceTree& source);

} // namespace hearth::wrap
