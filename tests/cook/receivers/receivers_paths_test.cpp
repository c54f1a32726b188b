// Tests baked bounces beside paths through a box, which needs no rays of a library: its walls are planes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/bake.h"
#include "formats/base/double3.h"
#include "formats/gpu_shared/record_values.h"
#include "tests/cook/receivers/receiver_shapes.h"
#include "tests/support/sanitized.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace hearth::receivers
{
namespace
{

constexpr Float3 kSize{4, 3, 2.5f};
constexpr Float3 kLamp{0.5f, 0.6f, 2.0f}; ///< near a corner, so that the far walls are lit by bounces
constexpr double kCandela = 10;

/// Albedo of the walls at low x, y, z and high x, y, z, in the order of addRoom.
constexpr std::array<Float3, 6> kWalls{Float3{0.7f, 0.1f, 0.1f}, Float3{0.1f, 0.7f, 0.2f},
                                       Float3{0.5f, 0.5f, 0.5f}, Float3{0.2f, 0.3f, 0.8f},
                                       Float3{0.8f, 0.7f, 0.2f}, Float3{0.8f, 0.8f, 0.8f}};

/// Place on a wall of the box.
struct Place
{
    Double3 position, normal;
    Double3 albedo;
};

double component(Double3 v, size_t axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Return where a ray from within the box meets it.
Place meetBox(Double3 from, Double3 direction)
{
    const Double3 size = widen(kSize);
    double nearest = std::numeric_limits<double>::infinity();
    size_t wall = 0;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        const double along = component(direction, axis);
        const double distance = ((along > 0 ? component(size, axis) : 0) - component(from, axis)) / along;
        if (along != 0 && distance < nearest)
        {
            nearest = distance;
            wall = axis + (along > 0 ? 3 : 0);
        }
    }
    std::array<double, 3> normal{};
    normal[wall % 3] = wall < 3 ? 1 : -1;
    return {from + direction * nearest, {normal[0], normal[1], normal[2]}, widen(kWalls[wall])};
}

/// Return the irradiance of the lamp, of which nothing in the box casts a shadow.
double lampIrradiance(const Place& at)
{
    const Double3 to_lamp = widen(kLamp) - at.position;
    const double distance2 = dot(to_lamp, to_lamp);
    return kCandela * std::max(dot(at.normal, to_lamp), 0.0) / (distance2 * std::sqrt(distance2));
}

/// Return the irradiance that paths through the box find, of any number of bounces.
Double3 traceIrradiance(const Place& at, int paths, std::mt19937& random)
{
    std::uniform_real_distribution<double> unit(0, 1);
    Double3 sum{};
    for (int path = 0; path < paths; ++path)
    {
        Place place = at;
        Double3 throughput{1, 1, 1};
        while (std::max({throughput.x, throughput.y, throughput.z}) > 1e-4)
        {
            // by the cosine: a point of the unit ball around the normal's end
            Double3 ball{};
            do
                ball = {2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
            while (dot(ball, ball) > 1 || dot(ball, ball) < 1e-12);
            const Double3 direction = place.normal + ball * (1 / std::sqrt(dot(ball, ball)));
            place = meetBox(place.position + place.normal * 1e-9, direction);
            throughput = {throughput.x * place.albedo.x, throughput.y * place.albedo.y,
                          throughput.z * place.albedo.z};
            sum = sum + throughput * lampIrradiance(place);
        }
    }
    const double direct = lampIrradiance(at);
    return sum * (1.0 / paths) + Double3{direct, direct, direct};
}

} // namespace

TEST(ReceiversPaths, allBouncesAreThoseOfPaths)
{
    BakeScene scene;
    scene.instance_count = 1;
    addRoom(scene.triangles, {0, 0, 0}, kSize, {}, 0);
    for (size_t i = 0; i < scene.triangles.size(); ++i)
        scene.triangles[i].albedo = kWalls[i / 2];
    Lamp lamp;
    lamp.light.type = shared::kLightPoint;
    lamp.light.position = kLamp;
    lamp.light.intensity = Float3{1, 1, 1} * static_cast<float>(kCandela);
    scene.lamps = {lamp};
    const BakedReceivers baked = bakeReceivers(scene, {.texels_per_metre = 16}).value();
    std::mt19937 random(1);
    double squares = 0, errors = 0, found_sum = 0, expected_sum = 0;
    for (size_t i = 0; i < baked.texels.size(); i += test::kSanitized ? 1997 : 397)
    {
        if (baked.texels[i].is_copy)
            continue;
        const Double3 position = widen(baked.texels[i].position), normal = widen(baked.texels[i].normal);
        const Double3 expected = traceIrradiance({position, normal, {}}, 1000, random);
        const Double3 found = widen(baked.light(i)[0]);
        const Double3 error = found - expected;
        errors += dot(error, error);
        squares += dot(expected, expected);
        found_sum += found.x + found.y + found.z;
        expected_sum += expected.x + expected.y + expected.z;
    }
    std::printf("room of a lamp: %.2f %% rms, mean off by %+.2f %%\n", 100 * std::sqrt(errors / squares),
                100 * (found_sum / expected_sum - 1));
    EXPECT_LT(std::sqrt(errors / squares), 0.03);
    EXPECT_NEAR(found_sum / expected_sum, 1, 0.01);
}

} // namespace hearth::receivers
