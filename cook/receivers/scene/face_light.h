// Light of each lamp at the faces of the grid of bricks: receivers of everything that has no texels, and of
// what moves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/scene/lamp_table.h"
#include "formats/pack/pack_view.h"

namespace hearth::receivers
{

/// Compute the light that leaves each face, direct light of suns included, as it settles at under each lamp
/// alone. It sums to the light of the grid's own table, less that of the default sun.
/// bricks  checked part with a grid that was cooked from the scene
/// probes  of the sky; none: the default sky
/// returns  [faces][lamps]: exposed radiance with weight 1
/// errors: errors of decoding pages
Result<std::vector<Float3>> bakeFaces(const bricks::StaticScene& scene, const formats::PackView& bricks,
                                      const shared::SceneProbes& probes, const ReceiverScene& receivers,
                                      const LampTable& lamps);

} // namespace hearth::receivers
