// Which materials occur in which tiles of the picture: what the tile passes and the shading pass agree on, written
// once for C++ and GLSL. See runtime/gpu/README.md, "Material tiles".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_MATERIAL_TILES_H
#define HEARTH_SHARED_MATERIAL_TILES_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Side of a tile. A multiple of the tiles of every mobile GPU (16 or 32 pixels), so that none is shaded in two.
HEARTH_CONSTANT uint kMaterialTilePixels = 64;

/// Materials that one tile lists, in rising order; the rest of its row is kNoTileMaterial. The materials of a tile that
/// are more are shaded full-screen instead, which is always right. A row is 256 bytes; the scenes at hand see about two
/// materials a tile (README.md).
HEARTH_CONSTANT uint kMaterialsPerTile = 64;
HEARTH_CONSTANT uint kNoTileMaterial = 0xFFFFFFFFu;

/// Materials whose bits one round of the tile pass gathers in shared memory: one word a thread. Only scenes with more
/// need a second round.
HEARTH_CONSTANT uint kTileRoundMaterials = 8192;

/// Entries of the tile lists are x | y << 16, in tiles. Entry 0 is not used: it stands for the whole picture.
HEARTH_CONSTANT uint kFirstTileEntry = 1;

/// While the tiles of a material are counted, this bit of TileDraw::instance_count says that it is shaded full-screen.
HEARTH_CONSTANT uint kCountedWhole = 0x80000000u;

/// Two triangles.
HEARTH_CONSTANT uint kTileVertices = 6;

/// The draw of one material (VkDrawIndirectCommand): one instance a tile, or one triangle that is the whole picture.
struct TileDraw
{
    uint vertex_count;
    uint instance_count;
    uint
        first_vertex; ///< kTileVertices * its first entry in the tile lists: the first instance has to stay 0
    uint first_instance;
};

HEARTH_FUNCTION uint materialTiles(uint pixels)
{
    return (pixels + kMaterialTilePixels - 1u) / kMaterialTilePixels;
}

HEARTH_SHARED_END

#endif
