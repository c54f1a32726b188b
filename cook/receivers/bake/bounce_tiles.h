// Joins elements to tiles, between which light is reflected until it settles: what a surface receives after a
// bounce is smooth, so all bounces but the last need less detail than the texels have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/gather_table.h"

namespace hearth::receivers
{

/// Texels along each side of the square whose texels share a tile, if they are on the same surface.
inline constexpr uint32_t kTileSide = 4;

/// Gather rays of a tile, at most.
inline constexpr uint32_t kTileRays = 2 * kElementRays;

/// Tiles of the elements that have open points: texels of a square on one surface, or one patch.
class BounceTiles
{
public:
    /// domains  of the elements
    BounceTiles(const BakeScene& scene, std::span<const TexelDomain> domains, const Elements& elements,
                const GatherTable& table);

    size_t size() const { return first_members_.size() - 1; }

    /// Return the tile of an element; kInvalidIndex: it has no open points.
    uint32_t find(size_t element) const { return tiles_[element]; }

    /// Return the elements of a tile, in their order.
    std::span<const uint32_t> members(size_t tile) const
    {
        return std::span(members_).subspan(first_members_[tile],
                                           first_members_[tile + 1] - first_members_[tile]);
    }

    /// Return the tiles that the rays of a tile meet, some of each open point; kInvalidIndex: none.
    std::span<const uint32_t> hits(size_t tile) const
    {
        return std::span(hits_).subspan(first_hits_[tile], first_hits_[tile + 1] - first_hits_[tile]);
    }

private:
    void joinTexels(const BakeScene& scene, const TexelDomain& domain, const GatherTable& table,
                    uint32_t first_element);
    void listMembers();
    void listHits(const GatherTable& table);

    std::vector<uint32_t> tiles_; ///< of elements
    uint32_t tile_count_ = 0;
    std::vector<uint32_t> members_, hits_;
    std::vector<size_t> first_members_, first_hits_; ///< of tiles, and the ends
};

} // namespace hearth::receivers
