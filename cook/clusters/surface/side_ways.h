// Traces the half-edges (triangle edges) of a surface over the simplified surface. See
// cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/side_twins.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_points.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Point in a triangle by barycentric coordinates: (1 - v - w) * corner 0 + v * corner 1 + w * corner 2.
struct InFacet
{
    float v = 0, w = 0;
};

/// Return corner k of a triangle as a point.
inline InFacet cornerPoint(uint32_t k)
{
    return {k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
}

/// Point of the simplified surface that a position maps to: one of its positions, which belongs to all
/// triangles around it, or a point within a triangle.
struct Image
{
    uint32_t facet = kNoFacet;
    uint32_t vertex = kNoFacet; ///< position id
    InFacet at;
    float far = 0; ///< distance between the position and the point

    bool isVertex() const { return vertex != kNoFacet; }
    bool isThere() const { return facet != kNoFacet; }
};

/// Crossing of a traced path from triangle to triangle.
struct Crossing
{
    /// Half-edge of the triangle before, and its opposite in the triangle behind.
    std::array<uint32_t, 2> sides;
    float t;   ///< from the start (0) to the end (1) of the half-edge that is left
    float far; ///< distance from the point of the traced half-edge that maps there

    uint32_t leaving() const { return sides[0]; }
    uint32_t entering() const { return sides[1]; }
};

/// Traced path of a half-edge: from the point that its start maps to, to that of its end.
struct Way
{
    uint32_t side = 0;
    uint32_t first = 0;        ///< first crossing
    uint32_t count = 0;        ///< number of crossings
    uint32_t from = 0, to = 0; ///< triangles
    float far = -1;            ///< largest distance of the crossings; less than 0: no path was found

    bool isFound() const { return far >= 0; }
};

/// Traces half-edges of the surface before over the surface after.
class SideWays
{
public:
    SideWays(const GroupMesh& group, const Simplified& simplified, std::span<const uint32_t> positions_before,
             const Surface& after, std::span<const FacetPoint> points);

    const Image& imageOf(uint32_t position) const { return images_[position]; }

    /// Return the coordinates of a mapped position in a triangle that contains it.
    InFacet pointIn(uint32_t facet, const Image& image) const
    {
        return image.isVertex() ? cornerPoint(cornerAt(facet, image.vertex) - facet * 3) : image.at;
    }

    /// Trace the path of a half-edge; call once for each.
    void findWay(uint32_t side);

    /// Return the path of a half-edge that was traced.
    const Way& wayOf(uint32_t side) const { return ways_[way_of_side_[side]]; }

    std::span<const Crossing> crossingsOf(const Way& way) const
    {
        return std::span(crossings_).subspan(way.first, way.count);
    }

    /// Return all traced paths.
    std::span<const Way> ways() const { return ways_; }

    std::span<const uint32_t> twins() const { return twins_; }

    /// Return the half-edges to cross from a triangle to another one around the same position, by the
    /// shorter turn; empty if there is none.
    std::span<const uint32_t> turn(uint32_t vertex, uint32_t from, uint32_t to);

private:
    void findImages(const GroupMesh& group, const Simplified& simplified, std::span<const FacetPoint> points);
    bool findWay(const Image& start, const Image& end, Way& way);
    bool walk(const Image& start, const Image& end, Way& way);
    uint32_t commonFacet(const Image& a, const Image& b) const;
    bool crossFewest(const Image& start, const Image& end, Way& way);
    void cross(uint32_t side, Way& way);
    Float3 placeOf(const Image& image) const;
    bool holds(uint32_t facet, const Image& image) const;

    /// Return the corner of a triangle that lies at a position, or kNoSide.
    uint32_t cornerAt(uint32_t facet, uint32_t position) const
    {
        const uint32_t* corners = &after_.positions[size_t{facet} * 3];
        return corners[0] == position   ? facet * 3
               : corners[1] == position ? facet * 3 + 1
               : corners[2] == position ? facet * 3 + 2
                                        : kNoSide;
    }

    /// Line that a traced path follows. sideOf(position) is twice the signed area that a corner
    /// spans with the line, seen from above: positive to its left.
    struct Line
    {
        Float3 origin, left;
        float sideOf(Float3 place) const { return dot(left, place - origin); }
    };

    std::span<const uint32_t> positions_;
    std::span<const Float3> places_;
    const Surface& after_;
    std::vector<uint32_t> twins_; ///< opposite half-edges of the surface after
    std::vector<Image> images_;
    std::vector<uint32_t> way_of_side_; ///< of the half-edges before
    std::vector<Way> ways_;
    std::vector<Crossing> crossings_;
    std::vector<uint32_t> turn_;

    // of the half-edge that is traced
    Float3 from_, to_;
    Line line_;
};

} // namespace hearth::clusters
