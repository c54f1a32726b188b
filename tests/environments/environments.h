// Environments for tests, made by functions of direction.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"

#include <random>

namespace hearth::test
{

/// Return an environment whose texels have the radiance in the direction of their centres.
/// radiance  Float3(Double3 direction)
template <typename Radiance>
environment::Environment makeEnvironment(environment::Layout layout, uint32_t height, Radiance&& radiance)
{
    const bool is_cube = layout == environment::Layout::cube;
    environment::Environment made{layout, is_cube ? height : 2 * height, height, {}};
    for (uint32_t panel = 0; panel < made.panelCount(); ++panel)
        for (uint32_t y = 0; y < made.height; ++y)
            for (uint32_t x = 0; x < made.width; ++x)
                made.texels.push_back(radiance(
                    panelDirection(layout, panel, {(x + 0.5) / made.width, (y + 0.5) / made.height})));
    return made;
}

/// Return an environment of random radiance from 0 to 1, with a few texels that are up to 1000 times
/// brighter.
inline environment::Environment makeNoise(environment::Layout layout, uint32_t height, uint32_t seed)
{
    std::mt19937 random(seed);
    const auto number = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    return makeEnvironment(layout, height,
                           [&](Double3)
                           {
                               const float scale = number() < 0.01f ? 1000 * number() : 1.0f;
                               return Float3{scale * number(), scale * number(), scale * number()};
                           });
}

} // namespace hearth::test
