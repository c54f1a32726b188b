// The nearest point of a surface that faces the way of a normal: a tree of boxes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/mesh_view.h"
#include "formats/base/double3.h"

#include <array>
#include <vector>

namespace hearth::visibility
{

class ClosestPoint
{
public:
    /// Keeps no reference to the view.
    /// triangle_count  only the first triangles of the mesh are there to be found
    ClosestPoint(const MeshView& mesh, size_t triangle_count);

    struct Found
    {
        uint32_t triangle = kNowhere;
        float u = 0; ///< weight of corner 1
        float v = 0; ///< weight of corner 2
        double distance2 = 0;
    };

    /// The nearest point, no farther than sqrt(`limit2`), on a triangle whose plane faces `normal` (dot > 0);
    /// triangles without area face nothing. Triangle kNowhere if there is none.
    /// normal  need not have length 1; 0: all triangles will do
    /// hint    a triangle that is probably near, or kNowhere: the answer is as good without, but for ties
    Found find(Float3 point, Float3 normal, double limit2, uint32_t hint) const;

private:
    /// A leaf has `count` triangles; a node has its first child behind it and its second at `second`.
    struct Node
    {
        Box3 box;
        uint32_t first = 0;
        uint32_t count = 0;
        uint32_t second = 0;
    };
    struct Facet
    {
        std::array<Float3, 3> corners;
        uint32_t triangle = 0;
    };

    void build(uint32_t first, uint32_t count);
    void visit(Double3 point, Double3 normal, const Facet& facet, Found& best) const;

    std::vector<Facet> facets_; ///< leaf by leaf
    std::vector<uint32_t> facet_of_triangle_;
    std::vector<Node> nodes_;
};

} // namespace hearth::visibility
