// Tests that the volumes of lights hold all that is lit, and little else.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/light_volume.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace hearth::test
{

namespace
{

double uniform(std::mt19937& random, double low, double high)
{
    return std::uniform_real_distribution<double>(low, high)(random);
}

float uniformFloat(std::mt19937& random, double low, double high)
{
    return static_cast<float>(uniform(random, low, high));
}

double length(const double (&v)[3])
{
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

} // namespace

TEST(LightVolume, holdsAllThatIsLit)
{
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round)
    {
        const double range = std::pow(10.0, uniform(random, -3, 4));
        const bool is_spot = random() % 3 != 0;
        const double cone = uniform(random, 0.5, 90) * std::numbers::pi / 180;
        shared::Light light{};
        light.type = is_spot ? shared::kLightSpot : shared::kLightPoint;
        light.range = static_cast<float>(range);
        light.intensity = {1, 1, 1};
        light.position = {uniformFloat(random, -3, 3), uniformFloat(random, -3, 3),
                          uniformFloat(random, -3, 3)};
        double axis[3] = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        const double axis_length = length(axis);
        for (double& a : axis)
            a /= axis_length;
        light.direction = {static_cast<float>(axis[0]), static_cast<float>(axis[1]),
                           static_cast<float>(axis[2])};
        // the falloff of KHR_lights_punctual is 0 at the outer angle, whatever the inner one
        light.cone_scale = static_cast<float>(1 / (1 - std::cos(cone)));
        light.cone_offset = static_cast<float>(-std::cos(cone) / (1 - std::cos(cone)));
        shared::LightGrid grid{};
        grid.right = {1, 0, 0};
        grid.down = {0, 1, 0};
        grid.forward = {0, 0, 1};
        const shared::CellLight volume = shared::makeCellLight(grid, light);
        double lit = 0, enclosed = 0;
        for (int i = 0; i < 2000; ++i)
        {
            const double offset[3] = {range * uniform(random, -1.6, 1.6), range * uniform(random, -1.6, 1.6),
                                      range * uniform(random, -1.6, 1.6)};
            const double distance = length(offset);
            const double along = (offset[0] * axis[0] + offset[1] * axis[1] + offset[2] * axis[2]) / distance;
            const Float3 place{static_cast<float>(double{light.position.x} + offset[0]),
                               static_cast<float>(double{light.position.y} + offset[1]),
                               static_cast<float>(double{light.position.z} + offset[2])};
            const bool is_lit = distance < range * 0.9999 && (!is_spot || along > std::cos(cone * 0.9999));
            const bool is_enclosed = shared::isInLightVolume(volume, place);
            EXPECT_TRUE(!is_lit || is_enclosed) << range << " m, " << cone << " rad";
            lit += is_lit ? 1 : 0;
            enclosed += is_enclosed ? 1 : 0;
        }
        // an icosahedron has 1.21 times the volume of its ball
        if (!is_spot)
        {
            EXPECT_LT(enclosed, 1.35 * lit);
        }
    }
}

} // namespace hearth::test
