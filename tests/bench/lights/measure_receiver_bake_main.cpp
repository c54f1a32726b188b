// Measures the bake of receivers: a hall of columns and balls with a million texels under eight lights, on
// two threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/receivers/bake/bake.h"
#include "formats/gpu_shared/record_values.h"
#include "tests/bench/aims.h"
#include "tests/cook/receivers/receiver_shapes.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>

namespace
{

using namespace hearth;
using namespace hearth::receivers;

constexpr Float3 kHall{24, 16, 5}; ///< metres
constexpr uint32_t kBallSteps = 48;

Lamp makeLamp(Float3 position, float radius)
{
    Lamp lamp;
    lamp.light.type = shared::kLightPoint;
    lamp.light.position = position;
    lamp.light.intensity = {30, 25, 20};
    lamp.radius = radius;
    return lamp;
}

/// Append a ball with UVs by longitude and latitude.
void addBall(std::vector<Triangle>& triangles, Float3 middle, float radius, uint32_t instance)
{
    const auto add = [&](std::array<Float2, 3> uvs)
    {
        Triangle triangle{{}, {}, uvs, {0.6f, 0.3f, 0.2f}, instance, false};
        for (size_t i = 0; i < 3; ++i)
        {
            const float turn = uvs[i].x * 6.28318531f, height = uvs[i].y * 3.14159265f;
            triangle.normals[i] = {std::sin(height) * std::cos(turn), std::sin(height) * std::sin(turn),
                                   -std::cos(height)};
            triangle.corners[i] = middle + triangle.normals[i] * radius;
        }
        triangles.push_back(triangle);
    };
    const auto at = [](uint32_t x, uint32_t y) {
        return Float2{static_cast<float>(x) / (2 * kBallSteps), static_cast<float>(y) / kBallSteps};
    };
    for (uint32_t y = 0; y < kBallSteps; ++y)
        for (uint32_t x = 0; x < 2 * kBallSteps; ++x)
        {
            add({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            add({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
}

/// Append the sides of a column, each in a quarter of UV.
void addColumn(std::vector<Triangle>& triangles, Float3 foot, uint32_t instance)
{
    constexpr float kWidth = 0.8f;
    const Float3 up{0, 0, kHall.z - 0.01f};
    const std::array<Float3, 4> corners{foot, foot + Float3{kWidth, 0, 0}, foot + Float3{kWidth, kWidth, 0},
                                        foot + Float3{0, kWidth, 0}};
    for (size_t i = 0; i < 4; ++i)
    {
        const float u = static_cast<float>(i) / 4;
        addQuad(triangles, corners[i], corners[(i + 1) % 4] - corners[i], up, {0.7f, 0.7f, 0.7f}, instance,
                {{u + 0.02f, 0.02f}, {u + 0.23f, 0.98f}});
    }
}

/// Build the hall: eight columns and twelve balls; six lamps, one of them with a radius, a spot and a panel
/// that shines.
BakeScene makeHall()
{
    BakeScene scene;
    addRoom(scene.triangles, {0, 0, 0}, kHall, {0.6f, 0.6f, 0.5f}, 0);
    uint32_t instance = 1;
    for (uint32_t i = 0; i < 8; ++i)
        addColumn(scene.triangles, {3.0f + 5 * static_cast<float>(i % 4), i < 4 ? 4.0f : 11.0f, 0},
                  instance++);
    for (uint32_t i = 0; i < 12; ++i)
        addBall(scene.triangles,
                {2.0f + 3.5f * static_cast<float>(i % 6), i < 6 ? 7.0f : 9.5f,
                 0.9f + 0.3f * static_cast<float>(i % 3)},
                0.8f, instance++);
    MeshLight panel;
    for (uint32_t i = 0; i < 2; ++i)
    {
        panel.triangles.push_back(static_cast<uint32_t>(scene.triangles.size()) + i);
        panel.radiance.push_back({3, 3, 4});
    }
    addQuad(scene.triangles, {10, 6, kHall.z - 0.1f}, {0, 4, 0}, {4, 0, 0}, {0.5f, 0.5f, 0.5f}, instance++,
            {{0, 0}, {0, 0}});
    scene.mesh_lights = {panel};
    scene.instance_count = instance;
    for (uint32_t i = 0; i < 6; ++i)
        scene.lamps.push_back(
            makeLamp({4.0f + 8 * static_cast<float>(i % 3), i < 3 ? 3.0f : 13.0f, 4}, i == 0 ? 0.15f : 0.0f));
    Lamp spot = makeLamp({12, 8, 4.5f}, 0);
    spot.light.type = shared::kLightSpot;
    spot.light.direction = {0, 0, -1};
    spot.light.cone_scale = 5;
    spot.light.cone_offset = -3;
    scene.lamps.push_back(spot);
    return scene;
}

/// Bake and print the figures. Returns seconds of processor.
double measure(const BakeScene& scene, const BakeSettings& settings)
{
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor_start = std::clock();
    const BakedReceivers baked = bakeReceivers(scene, settings).value();
    const double processor = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto texels = std::ranges::count(baked.texels, false, &BakedTexel::is_copy);
    const auto rays = static_cast<double>(baked.gather_rays + baked.shadow_rays);
    std::printf(
        "%zu triangles, %zu lights, %u bounces at most: %.3f million texels, atlas %u x %u, %.1f s, "
        "%.1f of processor, %.1f + %.1f million gather and shadow rays, %.2f million of them a second "
        "of processor\n",
        scene.triangles.size(), baked.light_count, settings.bounces, static_cast<double>(texels) / 1e6,
        baked.width, baked.height, seconds, processor, static_cast<double>(baked.gather_rays) / 1e6,
        static_cast<double>(baked.shadow_rays) / 1e6, rays / processor / 1e6);
    std::fflush(stdout);
    return processor;
}

} // namespace

int main(int argc, char** argv)
{
    cli::CommandLine app("Measures the bake of receivers on two threads.");
    double texels_per_metre = 20.5;
    app.addOption("--texels-per-metre", texels_per_metre, "density; 20.5 gives a million texels");
    if (const auto exit = app.parse(argc, argv))
        return *exit;
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 2);
    bench::Judgement judgement("receiver-bake");
    const BakeScene scene = makeHall();
    const double one = measure(scene, {.texels_per_metre = texels_per_metre, .bounces = 1});
    judgement.record("s of processor for a million texels, 8 lights, one bounce", one);
    const double all = measure(scene, {.texels_per_metre = texels_per_metre});
    judgement.record("s of processor for a million texels, 8 lights, all bounces", all);
    return judgement.finish();
}
