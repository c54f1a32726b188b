// Generates grass: a tuft of crossed cards with an alpha-masked image of blades, and the placement of tufts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/terrain.h"

namespace hearth::samples
{

struct TuftShape
{
    uint32_t cards = 3;
    uint32_t columns = 2; ///< quads across a card
    uint32_t rows = 4;    ///< quads up a card
};

/// Make crossed, bent cards about 0.4 m high, each with two sides. Normals lean upwards, so that a meadow is
/// lit like the ground below it.
TriangleMesh makeGrassTuft(const TuftShape& shape = {});

int addGrassMaterial(Document& document);

/// Place tufts on gentle slopes of the terrain, in patches, outside the circle of `bare_radius` metres.
std::vector<Placement> scatterGrass(const HeightGrid& grid, uint32_t candidates, float bare_radius,
                                    uint32_t seed);

} // namespace hearth::samples
