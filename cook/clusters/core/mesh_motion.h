// Motion of a deformed mesh over all poses of its scene: joints as bounded by cook/animation_bounds, and
// morph weights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/skin_motion.h"

#include <vector>

namespace hearth::clusters
{

/// Joint motion and morph weights of one mesh.
struct MeshMotion
{
    const animation_bounds::SkinMotion* skin = nullptr; ///< null: joints never move relative to each other
    std::vector<float> max_morph_weights; ///< largest absolute weight of each target; missing ones are 1
};

} // namespace hearth::clusters
