// The ways that the sides of a surface's facets take over the surface that a simplification leaves.
// See cook/clusters/README.md, "Error".
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

/// A point in a facet: (1 - v - w) * corner 0 + v * corner 1 + w * corner 2.
struct InFacet
{
    float v = 0, w = 0;
};

/// Corner k of a facet.
inline InFacet cornerPoint(uint32_t k)
{
    return {k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
}

/// Where a position lies on the surface after: at a position of that surface, which is in all facets around it, or
/// within a facet.
struct Image
{
    uint32_t facet = kNoFacet;
    uint32_t vertex = kNoFacet; ///< the position
    InFacet at;
    float far = 0; ///< distance of the two

    bool isVertex() const { return vertex != kNoFacet; }
    bool isThere() const { return facet != kNoFacet; }
};

/// Where a way goes from facet to facet.
struct Crossing
{
    std::array<uint32_t, 2> sides; ///< of the facet before, and its twin of the facet behind
    float t;                       ///< from the start (0) to the end (1) of the side that is left
    float far;                     ///< distance from the point that goes there

    uint32_t leaving() const { return sides[0]; }
    uint32_t entering() const { return sides[1]; }
};

/// From the image of where a side starts to that of where it ends.
struct Way
{
    uint32_t side = 0;
    uint32_t first = 0;        ///< crossing
    uint32_t count = 0;        ///< of crossings
    uint32_t from = 0, to = 0; ///< facets
    float far = -1;            ///< the largest of the crossings' distances; less than 0: no way was found

    bool isFound() const { return far >= 0; }
};

class SideWays
{
public:
    SideWays(const GroupMesh& group, const Simplified& simplified, std::span<const uint32_t> positions_before,
             const Surface& after, std::span<const FacetPoint> points);

    const Image& imageOf(uint32_t position) const { return images_[position]; }

    /// The image in a facet that it lies in.
    InFacet pointIn(uint32_t facet, const Image& image) const
    {
        return image.isVertex() ? cornerPoint(cornerAt(facet, image.vertex) - facet * 3) : image.at;
    }

    /// Search the way of a side; once for each.
    void findWay(uint32_t side);

    /// Of a side whose way was searched.
    const Way& wayOf(uint32_t side) const { return ways_[way_of_side_[side]]; }

    std::span<const Crossing> crossingsOf(const Way& way) const
    {
        return std::span(crossings_).subspan(way.first, way.count);
    }

    /// Those that were searched.
    std::span<const Way> ways() const { return ways_; }

    std::span<const uint32_t> twins() const { return twins_; }

    /// The sides to cross from a facet to another one around the same position, the shorter way; none if there is none.
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

    /// The corner of a facet that lies at a position, or kNoSide.
    uint32_t cornerAt(uint32_t facet, uint32_t position) const
    {
        const uint32_t* corners = &after_.positions[size_t{facet} * 3];
        return corners[0] == position   ? facet * 3
               : corners[1] == position ? facet * 3 + 1
               : corners[2] == position ? facet * 3 + 2
                                        : kNoSide;
    }

    /// Twice the areas, seen from above, that corners have with the straight line that a walk follows: positive to its
    /// left.
    struct Line
    {
        Float3 origin, left;
        float sideOf(Float3 place) const { return dot(left, place - origin); }
    };

    std::span<const uint32_t> positions_;
    std::span<const Float3> places_;
    const Surface& after_;
    std::vector<uint32_t> twins_; ///< of sides after
    std::vector<Image> images_;
    std::vector<uint32_t> way_of_side_; ///< of sides before
    std::vector<Way> ways_;
    std::vector<Crossing> crossings_;
    std::vector<uint32_t> turn_;

    // of the side whose way is searched
    Float3 from_, to_;
    Line line_;
};

} // namespace hearth::clusters
