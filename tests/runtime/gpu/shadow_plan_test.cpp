// Tests which lights cast shadows, and which of their maps a frame has.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/shadow_plan.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using formats::LightType;
using gpu::ShadowSphere;

constexpr Box3 kScene{{-10, 0, -10}, {10, 5, 10}};

/// Lights that all shine straight down; spots at 4 m with 45 degrees to each side.
shared::Lighting makeLights(std::initializer_list<LightType> types)
{
    shared::Lighting lighting{};
    for (const LightType type : types)
    {
        shared::Light& light = lighting.lights[lighting.light_count++];
        light.type = static_cast<uint32_t>(type);
        light.direction = {0, -1, 0};
        light.position = {0, 4, 0};
        light.cone_scale = 10;
        light.cone_offset = -7.0710678f;
    }
    gpu::assignShadowRows(lighting);
    return lighting;
}

gpu::ShadowPlan makePlan(const shared::Lighting& lighting, const gpu::ShadowOptions& options,
                         std::span<const ShadowSphere> spheres = {})
{
    const shared::FrameView view =
        shared::makeFrameView({.position = {0, 2, 8}, .target = {0, 0, 0}}, 640, 480, 1, 1);
    return gpu::planShadows(gpu::makeShadowCasters(lighting, kScene, options.spot_near), options, view,
                            spheres);
}

std::vector<uint32_t> getSizes(const gpu::ShadowPlan& plan, uint32_t row)
{
    const shared::ShadowLight& light = plan.block.lights[row];
    std::vector<uint32_t> sizes;
    for (uint32_t i = 0; i < light.map_count; ++i)
        sizes.push_back(static_cast<uint32_t>(plan.block.maps[light.first_map + i].size));
    return sizes;
}

} // namespace

TEST(ShadowRows, areGivenToSunsBeforeSpotsAndToNoPointLight)
{
    shared::Lighting lighting = makeLights(
        {LightType::spot, LightType::point, LightType::directional, LightType::spot, LightType::directional});
    std::vector<uint32_t> rows;
    for (uint32_t i = 0; i < lighting.light_count; ++i)
        rows.push_back(lighting.lights[i].shadow_row);
    EXPECT_EQ(rows, (std::vector<uint32_t>{2, shared::kNoShadow, 0, 3, 1}));
    const auto casting = gpu::makeShadowCasters(lighting, kScene, 0.1f);
    ASSERT_EQ(casting.size(), 4u);
    EXPECT_EQ(casting[0].light, 2u);
    EXPECT_EQ(casting[0].cone_tangent, 0);
    EXPECT_EQ(casting[2].light, 0u);
    EXPECT_NEAR(casting[2].cone_tangent, 1, 1e-4f);
    EXPECT_TRUE(gpu::makeShadowCasters(lighting, {}, 0.1f).empty()) << "nothing is there to cast";
}

TEST(ShadowPlan, hasSplitsOfSunsConesOfSpotsAndSpheresOfBoth)
{
    const auto lighting = makeLights({LightType::directional, LightType::spot});
    const ShadowSphere spheres[] = {{.center = {0, 0.5f, 0}, .radius = 0.5f},
                                    {.center = {2, 0.5f, 0}, .radius = 1, .light = 1},
                                    {.center = {9, 0.5f, 9}, .radius = 0.1f, .light = 1}, // beside the cone
                                    {.center = {0, 0.5f, 0}, .radius = 1, .light = 7}};   // no such light
    const gpu::ShadowPlan plan = makePlan(lighting, {.max_maps = 16, .splits = 3}, spheres);
    EXPECT_EQ(plan.block.lights[0].map_count, 4u);
    EXPECT_EQ(plan.block.lights[1].map_count, 3u);
    EXPECT_EQ(plan.map_count, 7u);
    EXPECT_EQ(plan.dropped_maps, 0u);
    for (uint32_t row = 0; row < 2; ++row)
    {
        const shared::ShadowLight& light = plan.block.lights[row];
        const auto maps = std::span(plan.block.maps).subspan(light.first_map, light.map_count);
        EXPECT_TRUE(std::is_sorted(maps.begin(), maps.end(),
                                   [](const auto& a, const auto& b) { return a.density > b.density; }));
        EXPECT_GT(light.eye_shift, 0);
        for (uint32_t i = 0; i < light.map_count; ++i)
            EXPECT_EQ(plan.row_of[light.first_map + i], row);
    }
    std::vector<uint32_t> layers;
    for (uint32_t i = 0; i < plan.map_count; ++i)
        layers.push_back(plan.block.maps[i].layer);
    std::sort(layers.begin(), layers.end());
    EXPECT_EQ(layers, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(ShadowPlan, givesSpheresTheTexelsThatTheyAskFor)
{
    const auto lighting = makeLights({LightType::directional});
    std::vector<ShadowSphere> spheres;
    // rounded down, limited by the filter and by the layer
    for (const uint32_t texels : {0u, 512u, 300u, 1u, 4096u})
        spheres.push_back({.center = {}, .radius = 1, .texels = texels});
    auto sizes = getSizes(makePlan(lighting, {.max_maps = 16, .kernel = 2, .splits = 0}, spheres), 0);
    std::sort(sizes.begin(), sizes.end());
    EXPECT_EQ(sizes, (std::vector<uint32_t>{16, 256, 512, 1024, 1024}));
}

TEST(ShadowPlan, countsWhatHasNoLayer)
{
    const auto lighting = makeLights({LightType::spot, LightType::directional, LightType::spot});
    const gpu::ShadowPlan plan = makePlan(lighting, {.max_maps = 3, .splits = 2});
    EXPECT_EQ(plan.map_count, 3u);
    EXPECT_EQ(plan.dropped_maps, 1u);
    EXPECT_EQ(plan.block.lights[0].map_count, 2u) << "the sun";
    EXPECT_EQ(plan.block.lights[1].map_count, 1u);
    EXPECT_EQ(plan.block.lights[2].map_count, 0u);
}

} // namespace hearth::test
