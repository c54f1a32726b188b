// Adapter of CGAL: wraps triangles, and finds where triangles intersect. CGAL's code for meshes is under the
// GPL, and slow to compile: only cgal_wrap.cpp includes it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hearth::wrap
{

/// Triangles over points that they share.
struct Surface
{
    std::vector<Float3> positions;
    std::vector<uint32_t> indices; ///< three for each triangle

    size_t triangleCount() const { return indices.size() / 3; }
    std::array<Float3, 3> corners(size_t triangle) const
    {
        return {positions[indices[3 * triangle]], positions[indices[3 * triangle + 1]],
                positions[indices[3 * triangle + 2]]};
    }
};

struct TrianglePair
{
    uint32_t a;
    uint32_t b; ///< larger than a

    friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// Compute the alpha wrap of triangles: a closed surface around them that no ball of radius alpha, coming
/// from outside, can get through, about `offset` in front of them. Oriented outwards, in a canonical order of
/// vertices and triangles. Its vertices are rounded to floats, so whoever needs its guarantees checks them.
/// source   at least one triangle; each has an area
/// returns  nullopt if it takes more than max_seconds of this thread's processor time
std::optional<Surface> computeAlphaWrap(const Surface& source, double alpha_m, double offset_m,
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

/// Search tree over triangles, each with an area.
class TriangleTree
{
public:
    explicit TriangleTree(const Surface& surface);
    ~TriangleTree();

    /// True if a triangle of `other` touches one of these.
    bool touches(const Surface& other) const;
    /// Return the triangle that is nearest to a point.
    uint32_t findNearest(Double3 point) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::wrap
