// Registry of the properties that animation channels change: importer, checker, reports and FORMAT.md use it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <array>

namespace hearth::formats
{

/// Animated property of a node, or of a punctual light.
struct AnimationPathInfo
{
    AnimationPath path;
    std::string_view name; ///< in glTF; of a light: its JSON pointer, relative to the light
    uint32_t components;   ///< floats of a value; 0: one for each morph target
    bool of_light;
    std::string_view meaning;
};

/// Paths by number.
inline constexpr std::array kAnimationPaths{
    AnimationPathInfo{AnimationPath::translation, "translation", 3, false, "3 components"},
    AnimationPathInfo{AnimationPath::rotation, "rotation", 4, false, "4 components, quaternion x y z w"},
    AnimationPathInfo{AnimationPath::scale, "scale", 3, false, "3 components"},
    AnimationPathInfo{AnimationPath::weights, "weights", 0, false, "one component for each morph target"},
    AnimationPathInfo{AnimationPath::light_color, "color", 3, true, "3 components, of a light"},
    AnimationPathInfo{AnimationPath::light_intensity, "intensity", 1, true, "one component, of a light"},
    AnimationPathInfo{AnimationPath::light_range, "range", 1, true, "one component, of a light"},
    AnimationPathInfo{AnimationPath::light_inner_cone, "spot/innerConeAngle", 1, true,
                      "one component, of a light"},
    AnimationPathInfo{AnimationPath::light_outer_cone, "spot/outerConeAngle", 1, true,
                      "one component, of a light"},
};

static_assert(
    []
    {
        for (size_t i = 0; i < kAnimationPaths.size(); ++i)
            if (static_cast<size_t>(kAnimationPaths[i].path) != i)
                return false;
        return true;
    }());

} // namespace hearth::formats
