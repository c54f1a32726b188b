// The voxels of one tile of the grid, while surfaces are added.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/voxel_sum.h"
#include "formats/pack/pack_view.h"

namespace hearth::bricks
{

/// Along an edge of a tile: two groups. Larger ones have sums that no cache holds, smaller ones decode pages more often.
inline constexpr uint32_t kTileVoxels = 32;

/// What became of a tile: groups with something in them, their bricks and voxels in the order of their bits.
struct TileVoxels
{
    struct Group
    {
        Cell cell; ///< least of the group
        MaskedCells bricks;
    };
    std::vector<Group> groups;
    std::vector<MaskedCells> bricks;
    std::vector<SolidVoxel> voxels;
    uint64_t pieces = 0;
};

/// Tiles along each axis of a grid.
Cell tilesOf(const GridFrame& frame);

/// Tile number `tile` of them, x fastest.
Cell tileAt(const GridFrame& frame, uint32_t tile);

/// All tiles, in any order, as one grid.
SolidGrid mergedTiles(const GridFrame& frame, std::span<const TileVoxels> tiles);

class Tile
{
public:
    /// at  in tiles
    Tile(const GridFrame& frame, const Cell& at);

    /// Add what of a cluster lies in the tile.
    /// mirrored  whether `voxels_from_object` turns triangles round
    void add(const formats::ClusterGeometry& geometry, const MaterialUse& material,
             const Affine3d& voxels_from_object, bool mirrored);

    /// Add what of a triangle lies in the tile.
    /// triangle  three snapped corners, in voxels of the grid
    /// front     1 where the front's normal is that of the corners' order, else -1
    void add(const Polygon& triangle, const TriangleLook& look, const MaterialUse& material, double front);

    TileVoxels finish() const;

private:
    bool reaches(const Polygon& triangle) const;
    bool addPiece(VoxelSum& sum, const Cell& cell, const Polygon& piece, const TriangleSurface& surface,
                  const MaterialUse& material, double front);
    uint32_t& indexAt(const Cell& cell);

    GridFrame frame_;
    CellBox box_;
    std::vector<uint32_t> index_; ///< of a voxel's sum, for all voxels of the tile; x fastest
    std::vector<VoxelSum> sums_;
    std::vector<Double3> places_; ///< of the vertices of the cluster that is being added
    uint64_t pieces_ = 0;
};

} // namespace hearth::bricks
