// Lists the lights that reach the surfaces of each tile of the image, between the depths that mark_lists.comp
// has found. A workgroup has a tile.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/light/light_buffer.glsl"
#include "runtime/shaders/light/area_lists.glsl"

uint column, row_number; // of the tile
LightSlab slab;
vec4 edges;

bool reachesArea(CellLight light)
{
    LightRow row = LightRow(edges.z, edges.w);
    LightColumns columns = lightColumns(lighting.grid, lighting.tiles, light, slab, row);
    return int(column) >= columns.first && int(column) <= columns.last && slab.begin <= slab.end &&
           reachesCell(lighting.grid, light, slab, edges);
}

void main()
{
    LightCascade tiles = lighting.tiles;
    column = gl_WorkGroupID.x;
    row_number = gl_WorkGroupID.y;
    uint tile = row_number * tiles.columns + column;
    uint depths = lighting.first_cell_word + tileDepthWord(tile);
    slab = tileSlab(lighting.grid, uintBitsToFloat(light_words[depths]), uintBitsToFloat(light_words[depths + 1u]));
    edges = vec4(lightColumnEdge(lighting.grid, tiles, column), lightColumnEdge(lighting.grid, tiles, column + 1u),
                 lightRowEdge(lighting.grid, tiles, row_number), lightRowEdge(lighting.grid, tiles, row_number + 1u));
    listArea(lighting.first_cell_word + tile);
}
