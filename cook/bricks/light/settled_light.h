// Computes the light that the faces of a grid settle at under the scene's own lights: the start of the
// runtime's light.
//
// It is the fixed point of the runtime's iteration (light/face_lighting.h). The rays of a face never change,
// so each is marched once, and what a face gets from other faces becomes a row of a sparse linear system.
// Sweeps over the rows then cost no rays.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_view.h"
#include "formats/scene/scene_lighting.h"

#include <cstdint>
#include <vector>

namespace hearth::bricks
{

struct SettledLight
{
    std::vector<uint32_t> codes; ///< radiance of each face: chunk BRKL
    uint32_t sweeps = 0;
};

/// Compute the light of all faces. The last sweep changes the sum of their light by less than a
/// ten-thousandth. The result does not depend on the number of threads.
/// lighting  lights in world space, after exposure
/// rays      per face, at least 1; the runtime takes 16
SettledLight settleLight(const BrickView& bricks, const shared::SceneLighting& lighting, uint32_t rays = 16);

} // namespace hearth::bricks
