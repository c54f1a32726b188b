// Generates the surroundings of the market: houses, trees, poles, and the night above.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/market/plan.h"
#include "sample_assets/shapes/textures.h"

namespace hearth::samples::market
{

/// Height of a house's eaves, and of its storeys' ledges, metres.
inline constexpr float kHouseEaves = 7.4f, kHouseLedge = 3.55f, kHouseHalfWidth = 3.5f;

void addHouses(Document& document, const Plan& plan);
void addTrees(Document& document, const Plan& plan);

/// Add the ground beyond the street and the town around the market, which hide the edge of the world.
void addTown(Document& document);

/// Add the poles and the wires of all strings.
void addPoles(Document& document, const Plan& plan);

/// Return the direction towards the moon.
Float3 moonDirection();

/// Radius of the painted sky around the origin, metres.
inline constexpr float kSkyRadius = 78;

/// Return the sky's radiance in an image as addSky() takes it: stars, the moon, the glow of a town.
Float4 nightSkyColor(Float2 uv);

/// Add a black shell behind the painted sky, with an opening around the moon: renderers light a scene with a
/// daylight sky, and the shell leaves only as much of it as a moonlit night has.
void addNightShell(Document& document);

} // namespace hearth::samples::market
