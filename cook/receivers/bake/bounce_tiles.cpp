// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/bounce_tiles.h"

#include "cook/receivers/bake/surface_texels.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hearth::receivers
{

namespace
{

static_assert(kTileRays >= kTileSide * kTileSide * kTexelPoints, "each point has a ray");

/// Return the gather rays that each point of a tile lends it: a prefix of the point's own, which is spread
/// evenly over all directions as they are.
uint32_t countPointRays(size_t members)
{
    const auto share = static_cast<uint32_t>(kTileRays / (members * kTexelPoints));
    return std::min(std::bit_floor(share), kPointRays);
}

float cellDistance(const DomainTexel& a, const DomainTexel& b)
{
    return std::hypot(static_cast<float>(a.x) - static_cast<float>(b.x),
                      static_cast<float>(a.y) - static_cast<float>(b.y));
}

} // namespace

BounceTiles::BounceTiles(const BakeScene& scene, std::span<const TexelDomain> domains,
                         const Elements& elements, const GatherTable& table)
    : tiles_(elements.list().size(), kInvalidIndex)
{
    uint32_t element = 0;
    for (const TexelDomain& domain : domains)
    {
        joinTexels(scene, domain, table, element);
        element += static_cast<uint32_t>(domain.texels.size());
    }
    for (; element < tiles_.size(); ++element)
        if (table.openPoints(element) != 0)
            tiles_[element] = tile_count_++;
    listMembers();
    listHits(table);
}

void BounceTiles::joinTexels(const BakeScene& scene, const TexelDomain& domain, const GatherTable& table,
                             uint32_t first_element)
{
    /// Tile of a square, by its first texel.
    struct SquareTile
    {
        uint32_t tile, texel;
    };
    const SurfaceTexels surface(scene, domain);
    const uint32_t columns = domain.width / kTileSide + 1, rows = domain.height / kTileSide + 1;
    std::vector<std::vector<SquareTile>> squares(size_t{columns} * rows);
    for (uint32_t i = 0; i < domain.texels.size(); ++i)
    {
        if (table.openPoints(first_element + i) == 0)
            continue;
        const DomainTexel& texel = domain.texels[i];
        std::vector<SquareTile>& square =
            squares[size_t{texel.y / kTileSide} * columns + texel.x / kTileSide];
        const auto found = std::ranges::find_if(
            square, [&](const SquareTile& tile)
            { return surface.areNear(tile.texel, i, cellDistance(domain.texels[tile.texel], texel)); });
        const uint32_t tile = found == square.end() ? tile_count_++ : found->tile;
        if (found == square.end())
            square.push_back({tile, i});
        tiles_[first_element + i] = tile;
    }
}

void BounceTiles::listMembers()
{
    first_members_.assign(tile_count_ + 1, 0);
    for (const uint32_t tile : tiles_)
        if (tile != kInvalidIndex)
            ++first_members_[tile + 1];
    for (size_t tile = 0; tile < tile_count_; ++tile)
        first_members_[tile + 1] += first_members_[tile];
    members_.resize(first_members_.back());
    std::vector<size_t> next(first_members_.begin(), first_members_.end() - 1);
    for (uint32_t element = 0; element < tiles_.size(); ++element)
        if (tiles_[element] != kInvalidIndex)
            members_[next[tiles_[element]]++] = element;
}

void BounceTiles::listHits(const GatherTable& table)
{
    for (size_t tile = 0; tile < tile_count_; ++tile)
    {
        first_hits_.push_back(hits_.size());
        const uint32_t rays = countPointRays(members(tile).size());
        for (const uint32_t element : members(tile))
            for (uint32_t point = 0; point < kTexelPoints; ++point)
                if ((table.openPoints(element) >> point & 1u) != 0)
                    for (const uint32_t hit : table.hits(element).subspan(point * kPointRays, rays))
                        hits_.push_back(hit == kInvalidIndex ? kInvalidIndex : tiles_[hit]);
    }
    first_hits_.push_back(hits_.size());
}

} // namespace hearth::receivers
