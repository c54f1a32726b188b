// Random lights over the ground of a test scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/lit_scene.h"

#include <numbers>
#include <random>

namespace hearth::test
{

/// Light somewhere over the ground: a lamp, or a spot of 1 to 90 degrees.
inline formats::LightRecord randomLight(std::mt19937& random, float most_range)
{
    constexpr float kRightAngle = 0.5f * std::numbers::pi_v<float>;
    const Float3 position{uniform(random, -10, 10), uniform(random, 0.1f, 3), uniform(random, -10, 10)};
    const Float3 direction{uniform(random, -1, 1), uniform(random, -1, 0.3f), uniform(random, -1, 1)};
    const bool is_spot = random() % 2 == 0;
    formats::LightRecord record = light(is_spot ? formats::LightType::spot : formats::LightType::point,
                                        position, direction, uniform(random, 0.2f, 2));
    record.color = {uniform(random, 0.2f, 1), uniform(random, 0.2f, 1), uniform(random, 0.2f, 1)};
    record.range = uniform(random, 0.3f, 1) * most_range;
    record.outer_cone_rad = random() % 8 == 0 ? kRightAngle : uniform(random, 1.0f / 90, 1) * kRightAngle;
    record.inner_cone_rad = record.outer_cone_rad * uniform(random, 0, 0.9f);
    return record;
}

} // namespace hearth::test
