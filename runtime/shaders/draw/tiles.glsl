// Push constants of the tile passes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/material_tiles.h"

layout(push_constant) uniform Push
{
    uint width; // pixels of the frame
    uint height;
    uint draw_count; // the sky and the materials of the scene
};

uint tileIndex(uvec2 tile) { return tile.y * materialTiles(width) + tile.x; }
