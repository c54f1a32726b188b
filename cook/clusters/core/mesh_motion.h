// What moves a deformed mesh, over all poses of its scene: joints as cook/animation_bounds bounds them, and morph weights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/skin_motion.h"

#include <vector>

namespace hearth::clusters
{

struct MeshMotion
{
    const motion::SkinMotion* skin = nullptr; ///< null: joints never move against each other
    std::vector<float> most_morph_weights; ///< of each target the largest absolute weight; missing ones are 1
};

} // namespace hearth::clusters
