// Push constants of the tile passes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/material_tiles.h"
#include "formats/gpu_shared/push_constants.h"

layout(push_constant) uniform Push { TilesPush push; };

uint tileIndex(uvec2 tile) { return tile.y * materialTiles(push.width) + tile.x; }
