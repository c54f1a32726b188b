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

/// Lights that all shine straight down; spots at 4 m with 45 degrees to each side, and lamps there.
shared::SceneLighting makeLights(std::initializer_list<LightType> types)
{
    shared::SceneLighting lighting{};
    for (const LightType type : types)
    {
        shared::Light& light = lighting.lights.emplace_back();
        light.type = static_cast<uint32_t>(type);
        light.direction = {0, -1, 0};
        light.position = {0, 4, 0};
        light.cone_scale = 10;
        light.cone_offset = -7.0710678f;
    }
    return lighting;
}

/// Suns, then spots, then lamps, with rows one after the other.
std::vector<gpu::ShadowCaster> makeCasters(const shared::SceneLighting& lighting, float near)
{
    std::vector<gpu::ShadowCaster> casters;
    for (const LightType type : {LightType::directional, LightType::spot, LightType::point})
        for (uint32_t i = 0; i < lighting.lights.size(); ++i)
            if (lighting.lights[i].type == static_cast<uint32_t>(type))
                gpu::addShadowCasters(lighting.lights[i], i, static_cast<uint32_t>(casters.size()), kScene,
                                      near, casters);
    return casters;
}

gpu::ShadowPlan makePlan(const shared::SceneLighting& lighting, const gpu::ShadowOptions& options,
                         std::span<const ShadowSphere> spheres = {})
{
    const shared::FrameView view =
        shared::makeFrameView({.position = {0, 2, 8}, .target = {0, 0, 0}}, 640, 480, 1, 1);
    return gpu::planShadows(makeCasters(lighting, options.spot_near), options, view, spheres);
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

TEST(ShadowCasters, areOneOfASunAndOfASpotAndSixOfAPointLight)
{
    shared::SceneLighting lighting = makeLights({LightType::directional, LightType::spot, LightType::point});
    lighting.lights[2].range = 7;
    const std::vector<gpu::ShadowCaster> casters = makeCasters(lighting, 0.1f);
    ASSERT_EQ(casters.size(), 8u);
    for (uint32_t row = 0; row < casters.size(); ++row)
    {
        EXPECT_EQ(casters[row].row, row);
        EXPECT_EQ(casters[row].light, std::min(row, 2u));
    }
    EXPECT_EQ(casters[0].tangent, 0);
    EXPECT_NEAR(casters[1].tangent, 1, 1e-4f);
    for (uint32_t face = 0; face < 6; ++face)
    {
        const gpu::ShadowCaster& caster = casters[2 + face];
        EXPECT_EQ(caster.face, face);
        EXPECT_EQ(caster.range, 7);
        EXPECT_EQ(caster.projection.origin, (Float3{0, 4, 0}));
        for (uint32_t other = 0; other < face; ++other)
            EXPECT_LE(dot(caster.projection.direction, casters[2 + other].projection.direction), 0);
    }
}

TEST(ShadowPlan, leavesOutUnseenFacesAndKeepsTheirPlace)
{
    const auto lighting = makeLights({LightType::point, LightType::point});
    std::vector<gpu::ShadowCaster> casters = makeCasters(lighting, 0.1f);
    const shared::FrameView view = shared::makeFrameView({.position = {0, 2, 8}}, 640, 480, 1, 1);
    const ShadowSphere sphere{.center = {0, 1, 0}, .radius = 0.5f, .light = 0}; // in the face that looks down
    const gpu::ShadowOptions options{.max_maps = 13};
    const gpu::ShadowPlan all = gpu::planShadows(casters, options, view, {&sphere, 1});
    casters[0].is_unseen = casters[3].is_unseen = true;
    const gpu::ShadowPlan seen = gpu::planShadows(casters, options, view, {&sphere, 1});
    EXPECT_EQ(all.map_count, 13u);
    EXPECT_EQ(seen.map_count, 10u);
    EXPECT_EQ(seen.unseen_maps, 3u);
    EXPECT_EQ(seen.dropped_maps, 0u);
    EXPECT_EQ(seen.finest_m, all.finest_m) << "maps do not change as their neighbours go out of view";
    EXPECT_EQ(seen.block.lights[0].map_count, 0u);
    EXPECT_EQ(seen.block.lights[3].map_count, 0u);
    EXPECT_EQ(seen.shadowed_lights, 2u);
    // the other lamp gets no layers in place of the faces that are not in view
    EXPECT_EQ(gpu::planShadows(casters, {.max_maps = 12}, view, {&sphere, 1}).shadowed_lights, 1u);
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

TEST(ShadowPlan, hasSixFacesOfAPointLightAndThePartsOfSpheresInThem)
{
    const auto lighting = makeLights({LightType::point});
    const ShadowSphere spheres[] = {{.center = {0, 1, 0}, .radius = 0.5f},     // in the face that looks down
                                    {.center = {2, 2, 0}, .radius = 0.5f},     // in that and in another one
                                    {.center = {0, 4, 0.1f}, .radius = 0.5f}}; // around the lamp: in all
    const gpu::ShadowPlan plan = makePlan(lighting, {.max_maps = 16}, spheres);
    EXPECT_EQ(plan.map_count, 6u + 1 + 2 + 6);
    std::vector<uint32_t> maps;
    for (uint32_t row = 0; row < 6; ++row)
    {
        const shared::ShadowLight& face = plan.block.lights[row];
        maps.push_back(face.map_count);
        EXPECT_EQ(plan.finest_m[row], plan.finest_m[0]) << "one cut for both sides of a seam";
        for (uint32_t i = 0; i < face.map_count; ++i)
            EXPECT_EQ(plan.row_of[face.first_map + i], row);
    }
    EXPECT_EQ(maps, (std::vector<uint32_t>{3, 2, 2, 4, 2, 2}));
}

TEST(ShadowPlan, shadowsAPointLightOnAllSidesOrNotAtAll)
{
    const auto lighting =
        makeLights({LightType::point, LightType::directional, LightType::point, LightType::point});
    const ShadowSphere sphere{.center = {0, 4, 0}, .radius = 0.5f, .light = 0};
    const gpu::ShadowPlan plan = makePlan(lighting, {.max_maps = 17, .splits = 2}, {&sphere, 1});
    std::vector<uint32_t> maps;
    for (uint32_t row = 0; row < 19; ++row)
        maps.push_back(plan.block.lights[row].map_count);
    // 15 layers for the lamps: a sphere in all faces of the first leaves 3, too few for the others
    EXPECT_EQ(maps, (std::vector<uint32_t>{2, 2, 2, 2, 2, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(plan.dropped_maps, 12u);
    const gpu::ShadowPlan tight = makePlan(lighting, {.max_maps = 10, .splits = 2}, {&sphere, 1});
    maps.clear();
    for (uint32_t row = 1; row < 7; ++row)
        maps.push_back(tight.block.lights[row].map_count);
    EXPECT_EQ(maps, (std::vector<uint32_t>{2, 2, 1, 1, 1, 1})) << "whole faces before spheres";
}

TEST(ShadowPlan, countsTheMapsThatItWouldHave)
{
    const auto lighting = makeLights({LightType::point, LightType::directional, LightType::spot});
    EXPECT_EQ(gpu::countShadowMaps(lighting, 4, 0), 4u + 1 + 6);
    EXPECT_EQ(gpu::countShadowMaps(lighting, 4, 2), 6u + 3 + 18);
    EXPECT_EQ(gpu::countShadowMaps(lighting, 4, 100), shared::kMaxShadowMaps);
}

gpu::ShadowDepthChoice chooseDepth(const shared::SceneLighting& lighting, const gpu::ShadowOptions& options,
                                   const Box3& scene = kScene, std::span<const ShadowSphere> spheres = {})
{
    return gpu::chooseShadowDepth(lighting, options, scene, spheres);
}

TEST(ShadowDepthChoice, has32BitsUnlessOptionsAskForLess)
{
    const auto lighting = makeLights({LightType::directional, LightType::spot});
    const gpu::ShadowDepthChoice choice = chooseDepth(lighting, {.max_maps = 8});
    EXPECT_EQ(choice.depth, gpu::ShadowDepth::d32);
    EXPECT_EQ(choice.light, kInvalidIndex);
    const gpu::ShadowPlan plan = makePlan(lighting, {.max_maps = 8});
    EXPECT_EQ(plan.block.lights[0].depth_quantum, 0);
}

/// A sun straight above 5 m: a step is 5 m / 65535. The sphere's map has 1024 - 5 texels on 2 m.
TEST(ShadowDepthChoice, ofASunHas16BitsWhereItsStepIsSmallBesideATexel)
{
    const auto lighting = makeLights({LightType::directional});
    const gpu::ShadowOptions options{.max_maps = 8, .splits = 0, .depth = gpu::ShadowDepth::d16};
    const ShadowSphere sphere{.center = {0, 1, 0}, .radius = 1};
    const gpu::ShadowDepthChoice shallow = chooseDepth(lighting, options, kScene, {&sphere, 1});
    EXPECT_EQ(shallow.depth, gpu::ShadowDepth::d16);
    EXPECT_EQ(shallow.light, 0u);
    EXPECT_NEAR(shallow.step_texels, 5.0f / 65535 / (2.0f / 1019), 0.001f);
    const gpu::ShadowDepthChoice deep =
        chooseDepth(lighting, options, {{-10, 0, -10}, {10, 100, 10}}, {&sphere, 1});
    EXPECT_EQ(deep.depth, gpu::ShadowDepth::d32);
    EXPECT_NEAR(deep.step_texels, 20 * shallow.step_texels, 0.01f);
    const gpu::ShadowPlan plan = makePlan(lighting, options, {&sphere, 1});
    EXPECT_EQ(plan.block.lights[0].depth_quantum, 1.0f / 65535);
}

/// Spots at 4 m that look down with 45 degrees to each side: a step is 16 m^2 / (near * 65535), a texel of
/// the floor 8 m / 1019.
TEST(ShadowDepthChoice, ofASpotHas16BitsWhereItsNearPlaneIsFarEnough)
{
    const auto lighting = makeLights({LightType::directional, LightType::spot});
    gpu::ShadowOptions options{.max_maps = 8, .splits = 1, .depth = gpu::ShadowDepth::d16};
    const gpu::ShadowDepthChoice near = chooseDepth(lighting, options);
    EXPECT_EQ(near.depth, gpu::ShadowDepth::d32);
    EXPECT_EQ(near.light, 1u) << "one spot decides for all";
    EXPECT_NEAR(near.step_texels, 16 / (0.05f * 65535) / (8.0f / 1019), 0.01f);
    options.spot_near = 0.1f;
    const gpu::ShadowDepthChoice far = chooseDepth(lighting, options);
    EXPECT_EQ(far.depth, gpu::ShadowDepth::d16);
    EXPECT_NEAR(far.step_texels, near.step_texels / 2, 0.01f);
}

TEST(ShadowDepthChoice, ofALampCountsItsRange)
{
    auto lighting = makeLights({LightType::point});
    const gpu::ShadowOptions options{.max_maps = 8, .depth = gpu::ShadowDepth::d16};
    EXPECT_EQ(chooseDepth(lighting, options).depth, gpu::ShadowDepth::d32) << "10 m to the sides";
    lighting.lights[0].range = 3;
    EXPECT_EQ(chooseDepth(lighting, options).depth, gpu::ShadowDepth::d16);
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
