// Computes the light that the faces of a grid settle at under the scene's own lights: all at once, the
// start of the runtime's light, or each of some lamps apart, as receivers have it.
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

/// Part of a face's emission that is a lamp's.
struct LampEmission
{
    uint32_t face;
    uint32_t lamp;
    Float3 share; ///< of the face's emission, by channel; of all lamps of a face at most 1
};

/// Lamps whose light is kept apart. The first one has what is no other's: the sky, and other emission.
struct LampSources
{
    uint32_t count = 1;
    std::vector<uint32_t> lamps_of_lights; ///< [lighting.lights]: lamp
    std::vector<LampEmission> emissions;   ///< by rising face
};

/// Compute the light of all faces for each lamp apart: the sum over lamps is that of settleLight, up to what
/// the sweeps leave. The result does not depend on the number of threads.
/// returns  [faces][lamps]: radiance that leaves the face, with weight 1
std::vector<Float3> settleLamps(const BrickView& bricks, const shared::SceneLighting& lighting,
                                const LampSources& sources, uint32_t rays = 16);

} // namespace hearth::bricks
