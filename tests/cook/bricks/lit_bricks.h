// Lit bricks for tests: lamps, suns, a closed room, and the radiance of faces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/light/face_lighting.h"
#include "tests/support/voxel_model.h"

#include <array>
#include <vector>

namespace hearth::bricks
{

shared::SceneLighting darkness();
shared::SceneLighting constantSky(Float3 radiance);
void addSun(shared::SceneLighting& lighting, Float3 direction, Float3 illuminance);
/// position  in metres
void addLamp(shared::SceneLighting& lighting, Float3 position, Float3 candela, float range = 0);

struct LitFace
{
    uint32_t x, y, z, side, face;
};

/// All faces whose centre lies in the box, in voxels.
std::vector<LitFace> facesIn(const BrickTables& tables, Float3 low, Float3 high);

/// Closed box with walls one voxel thick, and a voxel of air around it.
struct Room
{
    BrickTables tables;
    std::vector<LitFace> inner;

    Room(std::array<uint32_t, 3> inside, const Voxel& wall, float voxel_size = 1);
};

Float3 computeRadiance(const FaceLighting& lighting, uint32_t face);

/// tolerance  relative to the expected value, by channel
void expectRelative(Float3 value, Float3 expected, float tolerance);

float largest(Float3 v);

} // namespace hearth::bricks
