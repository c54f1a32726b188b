// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/convex/piece.h"

#include "cook/proxy/convex/lattice.h"

#include <algorithm>
#include <span>

namespace hearth::proxy
{

namespace
{

// Corners within this distance of a plane lie in it, in steps: a cut along a face leaves no slivers of its
// neighbours.
constexpr double kInPlane = 0.01;

double heightOver(const Plane& plane, Double3 point)
{
    const double height = dot(plane.normal, point) - plane.offset;
    return std::abs(height) <= kInPlane ? 0 : height;
}

/// True if a convex polygon in the plane of a cut goes below it.
bool goesBelow(std::span<const Double3> polygon, const Plane& plane)
{
    Double3 area;
    for (size_t i = 2; i < polygon.size(); ++i)
        area = area + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return plane.faces == FacesInPlane::stay && dot(area, plane.normal) > 0;
}

/// Cut a convex polygon whose corners have these heights.
void cutPolygon(std::span<const Double3> polygon, std::span<const double> heights, uint32_t material,
                CutPiece& cut)
{
    std::vector<Double3> below, above;
    for (size_t i = 0; i < polygon.size(); ++i)
    {
        const size_t next = (i + 1) % polygon.size();
        if (heights[i] <= 0)
            below.push_back(polygon[i]);
        if (heights[i] >= 0)
            above.push_back(polygon[i]);
        if (heights[i] * heights[next] < 0)
        {
            const double share = heights[i] / (heights[i] - heights[next]);
            const Double3 point = polygon[i] + (polygon[next] - polygon[i]) * share;
            below.push_back(point);
            above.push_back(point);
        }
    }
    cut.below.addPolygon(below, material);
    cut.above.addPolygon(above, material);
}

} // namespace

CutPiece cutPiece(const Piece& piece, const Plane& plane)
{
    CutPiece cut;
    std::vector<double> heights;
    uint32_t first = 0;
    for (size_t p = 0; p < piece.ends.size(); ++p)
    {
        const std::span<const Double3> polygon(piece.corners.data() + first, piece.ends[p] - first);
        const uint32_t material = piece.materials[p];
        first = piece.ends[p];
        heights.clear();
        for (const Double3 corner : polygon)
            heights.push_back(heightOver(plane, corner));
        const auto [lowest, highest] = std::ranges::minmax(heights);
        if (lowest == 0 && highest == 0)
            (goesBelow(polygon, plane) ? cut.below : cut.above).addPolygon(polygon, material);
        else if (highest <= 0)
            cut.below.addPolygon(polygon, material);
        else if (lowest >= 0)
            cut.above.addPolygon(polygon, material);
        else
            cutPolygon(polygon, heights, material, cut);
    }
    for (const FoldedEdge& edge : piece.edges)
        (heightOver(plane, edge.middle) <= 0 ? cut.below : cut.above).edges.push_back(edge);
    return cut;
}

std::vector<LatticePoint> collectLatticePoints(const Piece& piece)
{
    std::vector<LatticePoint> points;
    points.reserve(piece.corners.size());
    for (const Double3 corner : piece.corners)
        points.push_back(roundToLattice(corner));
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

} // namespace hearth::proxy
