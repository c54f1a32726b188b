// Lists the materials that occur in each screen tile, for deferred shading by material. Defines the data that
// the tile passes and the shading pass share. One source for C++ and GLSL. See runtime/gpu/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_MATERIAL_TILES_H
#define HEARTH_SHARED_MATERIAL_TILES_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Side of a tile in pixels. A multiple of the tile size of every mobile GPU (16 or 32 pixels), so that no
/// GPU tile is shaded in two parts.
HEARTH_CONSTANT uint kMaterialTilePixels = 64;

/// Materials that one tile lists, in ascending order; the rest of its row is kNoTileMaterial. A material that
/// no longer fits is shaded full-screen instead, which is always correct. A row is 256 bytes; the measured
/// scenes have about two materials a tile (runtime/gpu/README.md).
HEARTH_CONSTANT uint kMaterialsPerTile = 64;
HEARTH_CONSTANT uint kNoTileMaterial = 0xFFFFFFFFu;

/// Materials that one round of the tile pass collects as bits in shared memory, one word a thread. Only
/// scenes with more materials need a second round.
HEARTH_CONSTANT uint kTileRoundMaterials = 4096;

/// First used entry of the tile lists. Entries are x | y << 16, in tiles. Entry 0 is reserved: it means the
/// whole frame.
HEARTH_CONSTANT uint kFirstTileEntry = 1;

/// Bit of TileDraw::instance_count while the tiles of a material are counted: the material is shaded
/// full-screen.
HEARTH_CONSTANT uint kFullScreenBit = 0x80000000u;

/// Vertices of a tile: two triangles.
HEARTH_CONSTANT uint kTileVertices = 6;

/// Draw of one material (VkDrawIndirectCommand): one instance a tile, or one triangle that covers the whole
/// frame.
struct TileDraw
{
    uint vertex_count;
    uint instance_count;
    /// kTileVertices * index of its first entry in the tile lists. The first instance has to stay 0.
    uint first_vertex;
    uint first_instance;
};

HEARTH_FUNCTION uint materialTiles(uint pixels)
{
    return (pixels + kMaterialTilePixels - 1u) / kMaterialTilePixels;
}

HEARTH_SHARED_END

#endif
