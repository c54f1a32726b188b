// Bounds the distance of a triangle to the nearest triangles of a surface. See cook/clusters/README.md,
// "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/triangle_boxes.h"
#include "cook/clusters/surface/piece_bound.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hearth::clusters
{

/// Tolerance below which a bound need not be improved.
struct Tolerance
{
    float enough = 0; ///< a bound within this distance suffices
    float slack = 0;  ///< a bound that exceeds a real distance by at most 10 % and this suffices
};

/// Metric between the bounded triangle and the surface's triangles, never less than the Euclidean distance.
class SurfaceMetric : public PointMetric
{
public:
    /// Set the candidate triangles. False if the metric has no bound among them.
    virtual bool load(std::span<const TriangleId> triangles) = 0;

    /// Set the corners of the next piece to bound, in multiples of the triangle's edges from corner 0.
    virtual void setPiece(const std::array<Float2, 3>& corners) = 0;
};

/// Bounds the distances of triangles to a surface by branch and bound. The largest distance of a triangle to
/// one other triangle is at a corner, because the distance to a convex set is convex. Triangles that lie
/// across several others are cut where the nearest one changes, until the bounds of the pieces are good
/// enough.
class NearestBound
{
public:
    /// Return an upper bound of the distance of any point of the triangle to the surface.
    /// likely  triangles that are probably near, likeliest first: if they bound it well enough, no others are
    ///         searched; may be empty
    /// metric  instead of the distance; then only triangles close to the given one are searched, and the
    ///         bound may be infinite. null: the distance
    float bound(const Corners& triangle, TriangleBoxes& index, std::span<const TriangleId> likely,
                Tolerance tolerance, SurfaceMetric* metric = nullptr);

    /// Triangle of the surface that bounds some points of the last triangle, and their distance to it.
    struct UsedTriangle
    {
        TriangleId triangle;
        float distance;
    };

    /// Return the triangles that the last bound was taken from; may contain duplicates. Each point of the
    /// bounded triangle is within the distance of one of them.
    std::span<const UsedTriangle> used() const { return used_; }

    /// Return the number of pieces whose search ended early, so that their bounds are not tight.
    uint64_t loosePieces() const { return loose_pieces_; }

private:
    /// Piece of the triangle, with its corners' coordinates in the whole triangle.
    struct Piece
    {
        Corners corners;
        std::array<Float2, 3> plane;
    };
    static std::pair<Piece, Piece> halve(const Piece& piece);
    Bound boundByLikely(const Corners& triangle, TriangleBoxes& index, std::span<const TriangleId> likely);
    Bound boundPiece(const Piece& piece, TriangleBoxes& index, float allowed2, float radius);
    void dropDistant(const Corners& piece, TriangleBoxes& index, float radius);
    void keepNearest(const Corners& piece, TriangleBoxes& index);
    bool load(const TriangleBoxes& index, std::span<const TriangleId> triangles);
    void addUsed(std::span<const TriangleId> triangles);
    float allowed2() const;

    Tolerance tolerance_;
    float floor2_ = 0;
    float lower2_ = 0; ///< lower bound: some point of the triangle is this far away
    uint64_t loose_pieces_ = 0;
    std::vector<std::pair<float, TriangleId>> by_distance_;
    SurfaceMetric* metric_ = nullptr;
    std::vector<Piece> stack_;
    std::vector<TriangleId> found_;
    std::vector<UsedTriangle> used_;
    std::vector<DistanceTriangle> triangles_;
    Candidates candidates_;
    PieceBounder bounder_;
};

} // namespace hearth::clusters
