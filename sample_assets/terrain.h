// Generates ground: a tile of height field with a clearing in the middle, the hills around it, and their
// textures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

struct TerrainShape
{
    float size = 32;           ///< metres along a side; centred on the origin
    uint32_t cells = 256;      ///< quads along a side
    float clearing_radius = 0; ///< metres around the origin that are flat at height 0
    uint32_t seed = 1;
};

/// Heights on a regular grid.
struct HeightGrid
{
    TerrainShape shape;
    std::vector<float> heights; ///< (cells + 1)^2, rows along +Z

    /// Return the bilinear height; the border's height outside.
    float at(Float2 xz) const;
    Float3 normalAt(Float2 xz) const;
};

HeightGrid makeHeights(const TerrainShape& shape);

/// Make a mesh of the tile; UVs cover the unit square once.
TriangleMesh makeTerrain(const HeightGrid& grid);

/// Make a ring of hills from `inner` to `outer` metres that hides the end of the tile; v of the UVs grows
/// from 0 to 1 outwards.
TriangleMesh makeHills(float inner, float outer, uint32_t segments, uint32_t seed);

/// Add a material with colours by slope and height, and a bare patch of earth in the clearing; return its
/// index.
int addTerrainMaterial(Document& document, const HeightGrid& grid, uint32_t texture_size);

} // namespace hearth::samples
