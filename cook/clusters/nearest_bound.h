// How far a triangle is from the nearest facets of a surface, as a bound. See README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/facet_index.h"
#include "cook/clusters/piece_bound.h"

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

/// Bounds the distances of triangles to a surface. The largest distance of a triangle to one facet is at a corner,
/// because the distance to a convex set is convex: triangles that lie across several facets are cut where the nearest
/// one changes until the pieces' bounds are good enough.
class NearestBound
{
public:
    /// An upper bound of the distance of any point of the triangle to the surface.
    /// likely  facets that probably lie beside it, likeliest first: if they bound it well enough, no others are
    ///         searched; may be empty
    float bound(const Corners& triangle, FacetIndex& index, std::span<const uint32_t> likely,
                Allowance allowance);

    /// The facets that the last bound was taken from; some may be there twice.
    std::span<const uint32_t> used() const { return used_; }

    /// Pieces whose bound was taken before the search for a better one ended.
    uint64_t loosePieces() const { return loose_pieces_; }

private:
    Bound boundByLikely(const Corners& triangle, FacetIndex& index, std::span<const uint32_t> likely);
    Bound boundPiece(const Corners& piece, FacetIndex& index, float allowed2, float radius);
    void dropBesides(const Corners& piece, FacetIndex& index, float radius);
    void keepNearest(const Corners& piece, FacetIndex& index);
    void load(const FacetIndex& index, std::span<const uint32_t> facets);
    float allowed2() const;

    Allowance allowance_;
    float floor2_ = 0;
    float sure2_ = 0; ///< some point of the triangle is as far away
    uint64_t loose_pieces_ = 0;
    std::vector<std::pair<float, uint32_t>> by_distance_;
    std::vector<Corners> stack_;
    std::vector<uint32_t> found_;
    std::vector<uint32_t> used_;
    std::vector<Facet> facets_;
    Candidates candidates_;
    Bounder bounder_;
};

} // namespace hearth::clusters
