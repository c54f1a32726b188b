// Accumulates the voxels of one tile of the grid while surfaces are added.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/voxel_sum.h"
#include "formats/pack/pack_view.h"

namespace hearth::bricks
{

/// Voxels along an edge of a tile: two groups. Sums of larger tiles do not fit in a cache; smaller tiles
/// decode pages more often.
inline constexpr uint32_t kTileVoxels = 32;

/// Result of a tile: its groups with solid voxels, their bricks and voxels in bit order.
struct TileVoxels
{
    struct Group
    {
        Cell cell; ///< lowest cell of the group
        MaskedCells bricks;
    };
    std::vector<Group> groups;
    std::vector<MaskedCells> bricks;
    std::vector<SolidVoxel> voxels;
    uint64_t pieces = 0;
};

/// Return the number of tiles along each axis of a grid.
Cell tileCounts(const GridFrame& frame);

/// Return the coordinates of a tile from its index, x fastest.
Cell tileAt(const GridFrame& frame, uint32_t tile);

/// Merge tiles, in any order, into one grid.
SolidGrid mergeTiles(const GridFrame& frame, std::span<const TileVoxels> tiles);

class Tile
{
public:
    /// Construct an empty tile.
    /// at  coordinates in tiles
    Tile(const GridFrame& frame, const Cell& at);

    /// Add the part of a cluster that lies in the tile.
    /// mirrored  true if `voxels_from_object` inverts the winding of triangles
    void add(const formats::ClusterGeometry& geometry, const SurfaceMaterial& material,
             const Affine3d& voxels_from_object, bool mirrored);

    /// Add the part of a triangle that lies in the tile.
    /// triangle  three snapped corners, in voxels of the grid
    /// front     1 if the front's normal follows the order of the corners, else -1
    void add(const Polygon& triangle, const TriangleAttributes& look, const SurfaceMaterial& material,
             double front);

    TileVoxels finish() const;

private:
    bool reaches(const Polygon& triangle) const;
    bool addPiece(VoxelSum& sum, const Cell& cell, const Polygon& piece, const TriangleSurface& surface,
                  const SurfaceMaterial& material, double front);
    uint32_t& indexAt(const Cell& cell);

    GridFrame frame_;
    CellBox box_;
    std::vector<uint32_t> index_; ///< index of each voxel's sum, for all voxels of the tile, x fastest
    std::vector<VoxelSum> sums_;
    std::vector<Double3> positions_; ///< positions of the vertices of the current cluster
    uint64_t pieces_ = 0;
};

} // namespace hearth::bricks
