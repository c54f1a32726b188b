// Piece of a surface that planes cut out.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/convex/hull.h"
#include "formats/base/double3.h"

#include <array>
#include <vector>

namespace hearth::proxy
{

/// Side of a cut that polygons in its plane go to.
enum class FacesInPlane
{
    stay,     ///< the side that their backs face: there the solid is
    go_above, ///< sheets are taken apart
};

/// Points x with dot(normal, x) = offset.
struct Plane
{
    Double3 normal; ///< unit
    double offset;
    FacesInPlane faces = FacesInPlane::stay;
};

/// Edge where a solid is not convex, or a sheet is folded.
struct FoldedEdge
{
    Double3 middle;
    std::array<Plane, 2> planes; ///< of its two triangles
    double weight;               ///< its length times the sine of its angle
    bool is_of_sheet;            ///< its shell is open
};

/// Convex polygons, in steps of a lattice.
struct Piece
{
    std::vector<Double3> corners;
    std::vector<uint32_t> ends;      ///< of each polygon: the corner after its last one
    std::vector<uint32_t> materials; ///< of each polygon
    std::vector<FoldedEdge> edges;   ///< those whose middles lie in the piece

    void addPolygon(std::span<const Double3> polygon, uint32_t material)
    {
        corners.insert(corners.end(), polygon.begin(), polygon.end());
        ends.push_back(static_cast<uint32_t>(corners.size()));
        materials.push_back(material);
    }
};

/// Parts of a piece on both sides of a plane.
struct CutPiece
{
    Piece below; ///< where dot(normal, x) <= offset
    Piece above;
};

/// Cut a piece.
CutPiece cutPiece(const Piece& piece, const Plane& plane);

/// Return the corners as lattice points, each once.
std::vector<LatticePoint> collectLatticePoints(const Piece& piece);

} // namespace hearth::proxy
