// Grass: a tuft of crossed cards with an alpha-masked picture of blades, and where tufts grow.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/terrain.h"

namespace hearth::samples
{

/// Three crossed, bent cards about 0.4 m high, each with two sides; normals lean upwards, so that a meadow is lit like the ground below it.
TriangleMesh makeGrassTuft();

int addGrassMaterial(Document& document);

/// Tufts on gentle slopes of the terrain, in patches, outside the circle of `bare_radius` metres.
std::vector<Placement> scatterGrass(const HeightGrid& grid, uint32_t candidates, float bare_radius,
                                    uint32_t seed);

} // namespace hearth::samples
