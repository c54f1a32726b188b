// Grid of cells over the view, each with a list of the lights that reach it: cascades whose depth doubles,
// each cut into slabs, rows and columns (M. Billeter et al., "Tiled forward shading", GPU Pro 4, and
// "Clustered shading" by O. Olsson et al., 2012, with their minimum size of a cell). One source for C++ and
// GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LIGHT_GRID_H
#define HEARTH_SHARED_LIGHT_GRID_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Number of cascades; each begins at twice the depth of the one before.
HEARTH_CONSTANT uint kLightCascades = 12;

/// Depth at which the first cascade begins, in metres: a power of two. Its first slab reaches to the eye, and
/// the last slab of all has no end, so that no light is lost to distance.
HEARTH_CONSTANT float kFirstCascadeDepth = 0.125f;

/// One cascade. u and v are the place on the image plane at distance 1: u = x / z to the right and v = y / z
/// down; x and y of an orthographic view.
struct LightCascade
{
    float begin;       ///< depth, metres
    float slab_depth;  ///< metres
    float slabs_per_m; ///< inverse of slab_depth
    float cells_per_pixel;
    float column_step;   ///< in u
    float columns_per_u; ///< inverse of column_step
    float row_step;      ///< in v
    float rows_per_v;    ///< inverse of row_step
    uint first_slab;     ///< number of the first slab, counted over all cascades
    uint slabs;
    uint rows;
    uint columns;
    uint first_cell; ///< cells follow by slab, then row, then column
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

/// View of the grid, without its cascades. Distances are in metres; view space has x to the right, y down,
/// and z along the view.
struct LightGrid
{
    Float3 right; ///< unit, world, as the next two
    float z_near; ///< nearest depth of a drawn point
    Float3 down;
    float slack_share; ///< share of a light's distance by which its ball grows: see lightSlack
    Float3 forward;
    float slack_size;     ///< the same that does not depend on the distance, in metres
    Float3 eye;           ///< world
    uint is_orthographic; ///< 1: u and v are x and y
    Float4 edges;         ///< least and greatest u, least and greatest v of the image
    Float4 edge_lengths;  ///< lengths of the normals of the planes through the edges
    uint slab_count;
    uint cell_count;
    uint max_columns; ///< of any cascade
    uint max_rows;
};

/// Return the number of the cascade at a depth. Exact: the exponent of a float tells it.
/// depth  above 0
HEARTH_FUNCTION uint lightCascadeAt(float depth)
{
    int doublings = int(floatBits(depth / kFirstCascadeDepth) >> 23) - 127;
    return uint(doublings < 0                         ? 0
                : doublings > int(kLightCascades) - 1 ? int(kLightCascades) - 1
                                                      : doublings);
}

/// Return the number of the slab at a depth, counted in its cascade.
HEARTH_FUNCTION uint lightSlabAt(HEARTH_IN(LightCascade) cascade, float depth)
{
    HEARTH_PRECISE float slab = (depth - cascade.begin) * cascade.slabs_per_m;
    return uint(min(max(slab, 0.0f), float(cascade.slabs - 1u)));
}

/// Return the number of the cell at a point of the image.
/// x, y   pixels
/// depth  of the point in that cascade
HEARTH_FUNCTION uint lightCellAt(HEARTH_IN(LightCascade) cascade, float x, float y, float depth)
{
    uint column = uint(min(max(x * cascade.cells_per_pixel, 0.0f), float(cascade.columns - 1u)));
    uint row = uint(min(max(y * cascade.cells_per_pixel, 0.0f), float(cascade.rows - 1u)));
    return cascade.first_cell + (lightSlabAt(cascade, depth) * cascade.rows + row) * cascade.columns + column;
}

/// Word of a cell: where its list begins, in words of two indices, and the number of its lights. Lights of a
/// list are 16-bit places in the frame's list of ranged lights, rising, the first in the low half.
HEARTH_CONSTANT uint kLightOffsetBits = 20;
/// Count that stands for all ranged lights of the frame: lists are full, or the cell's is longer.
HEARTH_CONSTANT uint kAllLights = 4095;

/// Largest number of lights of a scene.
HEARTH_CONSTANT uint kMaxLights = 4096;

/// Largest number of cells of a grid: larger images get larger cells.
HEARTH_CONSTANT uint kMaxLightCells = 32768;

/// Largest number of tiles of an image. Their depths lie behind the words of their lists, in the room that
/// the cells of a grid have.
HEARTH_CONSTANT uint kMaxLightTiles = kMaxLightCells / 3;

/// Return the first word of a tile's depths, its least and its greatest, from the first word of all lists.
HEARTH_CONSTEXPR_FUNCTION uint tileDepthWord(uint tile)
{
    return kMaxLightTiles + 2u * tile;
}

/// Numbers of a frame's lists.
struct LightListCounts
{
    uint unranged;    ///< lights that every point gets
    uint ranged;      ///< lights with a range that reach into the view
    uint index_words; ///< words of indices that all lists need
    uint overflows;   ///< cells with kAllLights; tiles or slots where those have the lists, as the next two
    uint cells;       ///< cells that some light reaches
    uint indices;     ///< pairs of such a cell and a light
    // of all pixels that show a surface, counted by LightStatisticsPass
    uint pixels;
    uint longest;        ///< most lights that a pixel evaluates
    uint evaluated_low;  ///< lights evaluated
    uint evaluated_high; ///< in 2^32
    uint reaching_low;   ///< lights whose light is not 0 there
    uint reaching_high;
};

/// Words of LightListCounts, by member, for shaders that write them.
HEARTH_CONSTANT uint kCountUnranged = 0;
HEARTH_CONSTANT uint kCountRanged = 1;
HEARTH_CONSTANT uint kCountIndexWords = 2;
HEARTH_CONSTANT uint kCountOverflows = 3;
HEARTH_CONSTANT uint kCountCells = 4;
HEARTH_CONSTANT uint kCountIndices = 5;
HEARTH_CONSTANT uint kCountPixels = 6;
HEARTH_CONSTANT uint kCountLongest = 7;
HEARTH_CONSTANT uint kCountEvaluated = 8; ///< two words, like the next one
HEARTH_CONSTANT uint kCountReaching = 10;
/// Words of all of them, behind which the rows of the frame's lights follow.
HEARTH_CONSTANT uint kLightCountWords = 12;

HEARTH_CONSTEXPR_FUNCTION uint lightCellWord(uint offset, uint count)
{
    return offset | count << kLightOffsetBits;
}
HEARTH_CONSTEXPR_FUNCTION uint lightCellCount(uint word)
{
    return word >> kLightOffsetBits;
}
HEARTH_CONSTEXPR_FUNCTION uint lightCellOffset(uint word)
{
    return word & ((1u << kLightOffsetBits) - 1u);
}

/// Word of a cell that no pixel has marked, where only marked cells get lists: all lights, so that a pixel
/// whose depth rounds into such a cell loses none.
HEARTH_CONSTANT uint kUnmarkedCell = kAllLights << kLightOffsetBits;

/// Return the words of indices that a list of so many lights takes; none if it is too long for a cell.
HEARTH_CONSTEXPR_FUNCTION uint lightListWords(uint count)
{
    return count >= kAllLights ? 0u : (count + 1u) >> 1;
}

/// Return the word of a cell: all lights if its list is too long or does not fit.
/// offset    where the lists before it end
/// capacity  words of indices
HEARTH_CONSTEXPR_FUNCTION uint placeLightList(uint count, uint offset, uint capacity)
{
    if (count == 0u)
        return lightCellWord(0u, 0u);
    bool fits = count < kAllLights && offset + lightListWords(count) <= capacity;
    return fits ? lightCellWord(offset, count) : lightCellWord(0u, kAllLights);
}

HEARTH_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(hearth::shared::LightCascade) == 64);
static_assert(sizeof(hearth::shared::LightGrid) == 112);
static_assert(sizeof(hearth::shared::LightListCounts) == 4 * hearth::shared::kLightCountWords);
static_assert(offsetof(hearth::shared::LightListCounts, ranged) == 4 * hearth::shared::kCountRanged);
static_assert(offsetof(hearth::shared::LightListCounts, overflows) == 4 * hearth::shared::kCountOverflows);
static_assert(offsetof(hearth::shared::LightListCounts, indices) == 4 * hearth::shared::kCountIndices);
static_assert(offsetof(hearth::shared::LightListCounts, longest) == 4 * hearth::shared::kCountLongest);
static_assert(offsetof(hearth::shared::LightListCounts, evaluated_low) ==
              4 * hearth::shared::kCountEvaluated);
static_assert(offsetof(hearth::shared::LightListCounts, reaching_low) == 4 * hearth::shared::kCountReaching);
#endif

#endif
