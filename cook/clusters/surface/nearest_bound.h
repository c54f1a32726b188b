// How far a triangle is from the nearest facets of a surface, as a bound. See cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/facet_index.h"
#include "cook/clusters/surface/piece_bound.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hearth::clusters
{

/// What a bound need not go below.
struct Allowance
{
    float enough = 0; ///< within this, nothing nearer is searched for
    float slack = 0;  ///< nor if the bound exceeds what is there by 10 % and this
};

/// A metric between the triangle that is bound and the surface's facets, which are at least as far apart in it as in space.
class SurfaceMetric : public PointMetric
{
public:
    /// The facets that the candidates are from now on. False where the metric has no bound among them.
    virtual bool load(std::span<const uint32_t> facets) = 0;

    /// The corners of the piece that is bound next, in multiples of the triangle's edges from corner 0.
    virtual void setPiece(const std::array<Float2, 3>& corners) = 0;
};

/// Bounds the distances of triangles to a surface. The largest distance of a triangle to one facet is at a corner,
/// because the distance to a convex set is convex: triangles that lie across several facets are cut where the nearest
/// one changes until the pieces' bounds are good enough.
class NearestBound
{
public:
    /// An upper bound of the distance of any point of the triangle to the surface.
    /// likely  facets that probably lie beside it, likeliest first: if they bound it well enough, no others are
    ///         searched; may be empty
    /// metric  instead of the distance; then only facets that lie close to the triangle are searched, and the bound may
    ///         be infinite. null: the distance
    float bound(const Corners& triangle, FacetIndex& index, std::span<const uint32_t> likely,
                Allowance allowance, SurfaceMetric* metric = nullptr);

    /// The facets that the last bound was taken from; some may be there twice.
    std::span<const uint32_t> used() const { return used_; }

    /// Pieces whose bound was taken before the search for a better one ended.
    uint64_t loosePieces() const { return loose_pieces_; }

private:
    /// Of the triangle, with where its corners are in the whole one.
    struct Piece
    {
        Corners corners;
        std::array<Float2, 3> plane;
    };
    static std::pair<Piece, Piece> halve(const Piece& piece);
    Bound boundByLikely(const Corners& triangle, FacetIndex& index, std::span<const uint32_t> likely);
    Bound boundPiece(const Piece& piece, FacetIndex& index, float allowed2, float radius);
    void dropBesides(const Corners& piece, FacetIndex& index, float radius);
    void keepNearest(const Corners& piece, FacetIndex& index);
    bool load(const FacetIndex& index, std::span<const uint32_t> facets);
    void addUsed(std::span<const uint32_t> facets);
    float allowed2() const;

    Allowance allowance_;
    float floor2_ = 0;
    float sure2_ = 0; ///< some point of the triangle is as far away
    uint64_t loose_pieces_ = 0;
    std::vector<std::pair<float, uint32_t>> by_distance_;
    SurfaceMetric* metric_ = nullptr;
    std::vector<Piece> stack_;
    std::vector<uint32_t> found_;
    std::vector<uint32_t> used_;
    std::vector<Facet> facets_;
    Candidates candidates_;
    Bounder bounder_;
};

} // namespace hearth::clusters
