// Scene of the benches of many lights, that of M. Billeter, O. Olsson and U. Assarsson, "Tiled forward
// shading", 2013: a plane with thousands of balls and lamps, and views of people who walk there.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/light_grid.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace hearth::bench
{

inline constexpr float kHalfWidth = 110, kDepth = 240; ///< of the plane, metres
inline constexpr int kBalls = 3000;

/// Lamps over the plane, by number and range.
struct LightSet
{
    uint32_t count;
    float least_range, most_range; ///< metres
};

class Random
{
public:
    float uniform(float low, float high)
    {
        return low + (high - low) * (static_cast<float>(random_() >> 8) / 16777216.0f);
    }
    Float3 direction()
    {
        const float z = uniform(-1, 1);
        const float angle = uniform(0, 2 * std::numbers::pi_v<float>);
        const float r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    Float3 place(float height)
    {
        return {uniform(-kHalfWidth, kHalfWidth), uniform(0, height), -uniform(0, kDepth)};
    }

private:
    std::mt19937 random_{11};
};

struct Ball
{
    Float3 center;
    float radius;
};

inline std::vector<Ball> makeBalls(Random& random)
{
    std::vector<Ball> balls;
    for (int i = 0; i < kBalls; ++i)
        balls.push_back({random.place(2), random.uniform(0.3f, 1.5f)});
    return balls;
}

/// Camera of somebody on the plane who looks along it, somewhere.
inline shared::Camera makeWalker(Random& random)
{
    const Float3 place = random.place(0);
    const float heading = random.uniform(0, 2 * std::numbers::pi_v<float>);
    const Float3 eye{place.x, 1.7f, place.z};
    return {
        .position = eye, .target = eye + Float3{std::sin(heading), 0, -std::cos(heading)}, .y_fov_rad = 0.8f};
}

/// View of such a camera, as grids of light cells have it.
inline shared::LightGridView makeView(const shared::Camera& camera, float width, float height)
{
    const float pixels = 0.5f * height / std::tan(0.5f * camera.y_fov_rad);
    const Float3 forward = camera.target - camera.position;
    return {.eye = camera.position,
            .right = {-forward.z, 0, forward.x},
            .down = {0, -1, 0},
            .forward = forward,
            .pixels_per_u = pixels,
            .pixels_per_v = pixels,
            .center_x = 0.5f * width,
            .center_y = 0.5f * height,
            .width = width,
            .height = height,
            .z_near = 0.1f};
}

inline shared::Light makeLamp(Random& random, const LightSet& set)
{
    shared::Light light{};
    light.type = shared::kLightPoint;
    light.position = random.place(4);
    light.range = random.uniform(set.least_range, set.most_range);
    light.intensity = {1, 1, 1};
    return light;
}

inline std::vector<shared::Light> makeLamps(const LightSet& set)
{
    Random random;
    std::vector<shared::Light> lights;
    for (uint32_t i = 0; i < set.count; ++i)
        lights.push_back(makeLamp(random, set));
    return lights;
}

} // namespace hearth::bench
