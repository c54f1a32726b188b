// Tests the path tracer against closed forms: open surfaces, a white furnace, a lamp with an area, and
// shadows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/path_tracer.h"
#include "tests/reference/tracer/sky_tracer.h"
#include "tests/support/lit_scene.h"

#include <gtest/gtest.h>

namespace hearth::reference
{
namespace
{

using namespace formats;

class PathTracerTest : public ::testing::Test
{
protected:
    /// Add a square of the current material that faces a direction.
    void addSquare(float side, Float3 center, Float3 normal)
    {
        const mesh::SourceMesh quad =
            test::withMaterial(test::makeQuad(side, side), test_.addMaterial(material_));
        test_.addInstance(test_.addMesh(quad), test::shining(center, -normal));
    }

    const ShadedScene& scene()
    {
        if (!scene_)
        {
            pack_.emplace(test_.build());
            geometry_.emplace(PackGeometry::decode(*pack_).value());
            textures_.emplace(TextureSet::load(*pack_).value());
            scene_.emplace(*geometry_, *textures_, nullptr);
        }
        return *scene_;
    }

    /// Mean radiance of a few pixels about a point.
    Double3 look(Float3 eye, Float3 target, PathTracing tracing)
    {
        tracing.camera = {.position = eye, .target = target, .up = {0.1f, 0.9f, 0.3f}, .y_fov_rad = 0.01f};
        tracing.width = tracing.height = 4;
        tracing.max_indirect = 1e30;
        Double3 sum;
        for (const Double3 pixel : tracePaths(scene(), tracing))
            sum += pixel / 16;
        return sum;
    }

    test::TestScene test_;
    MaterialRecord material_ = test::plainMaterial();
    std::optional<PackView> pack_;
    std::optional<PackGeometry> geometry_;
    std::optional<TextureSet> textures_;
    std::optional<ShadedScene> scene_;
};

/// Paths that scatter once, over each lobe, find what the integral over the open sky says.
TEST_F(PathTracerTest, agreesOnAnOpenPlaneWithTheIntegralOverTheSky)
{
    constexpr std::array kRoughnesses{0.1f, 0.4f, 1.0f};
    for (size_t i = 0; i < kRoughnesses.size(); ++i)
        for (const float metallic : {0.0f, 0.5f, 1.0f})
        {
            material_.roughness = kRoughnesses[i];
            material_.metallic = metallic;
            material_.base_color = {0.8f, 0.5f, 0.2f, 1};
            addSquare(2, {10 * static_cast<float>(i), 0, 10 * metallic}, {0, 1, 0});
        }
    for (size_t i = 0; i < kRoughnesses.size(); ++i)
        for (const float metallic : {0.0f, 0.5f, 1.0f})
        {
            const Float3 at{10 * static_cast<float>(i), 0, 10 * metallic}, eye = at + Float3{1, 0.7f, 0.5f};
            const Double3 open = look(eye, at, {.samples = 1, .occlusion = Occlusion::none});
            const Double3 paths = look(eye, at, {.samples = 1024});
            EXPECT_NEAR(paths.x, open.x, 0.01 * open.x) << kRoughnesses[i] << " " << metallic;
            EXPECT_NEAR(paths.z, open.z, 0.01 * open.z) << kRoughnesses[i] << " " << metallic;
        }
}

/// The sky of an image with a small sun, beside a sum over its texels.
TEST_F(PathTracerTest, agreesWithTheSumOverTheTexelsOfASky)
{
    constexpr uint32_t kRows = 32;
    for (const auto layout : {environment::Layout::lat_long, environment::Layout::cube})
        for (const float roughness : {0.25f, 0.9f})
        {
            const bool is_cube = layout == environment::Layout::cube;
            SCOPED_TRACE(::testing::Message() << is_cube << " " << roughness);
            test_ = {};
            scene_.reset();
            material_ = test::plainMaterial();
            material_.roughness = roughness;
            material_.base_color = {0.5f, 0.5f, 0.5f, 1};
            addSquare(20, {0, 0, 0}, {0, 1, 0});
            environment::Environment sky{layout, is_cube ? kRows : 2 * kRows, kRows, {}};
            for (size_t i = 0; i < size_t{sky.panelCount()} * sky.width * sky.height; ++i)
                sky.texels.push_back(Float3{1, 1, 1} * (0.3f + 0.01f * static_cast<float>(i % 97)));
            const Double3 sun = normalize(Double3{-0.5, 0.6, -0.3});
            sky.texels[findTexel(sky, {sun.x, sun.y, sun.z})] = {80, 80, 80};
            SceneLighting lighting = scene().lighting();
            lighting.lights.clear();
            lighting.sky_map = std::make_shared<SkyMap>(sky);
            scene_->setLighting(lighting);

            const Float3 eye{1, 0.7f, 0.5f};
            const Double3 view = normalize(Double3(eye));
            const auto floor = scene().nearest({Double3(eye), -view, 0, 1e30}, 0);
            ASSERT_TRUE(floor.has_value());
            constexpr uint32_t kParts = 4;
            double sum = 0, total_density = 0;
            for (uint32_t panel = 0; panel < sky.panelCount(); ++panel)
                for (uint32_t y = 0; y < kParts * sky.height; ++y)
                    for (uint32_t x = 0; x < kParts * sky.width; ++x)
                    {
                        const environment::Environment fine{
                            layout, kParts * sky.width, kParts * sky.height, {}};
                        const environment::PanelArea area = fine.area(x, y);
                        const auto d = panelDirection(layout, panel,
                                                      {0.5 * (area.u0 + area.u1), 0.5 * (area.v0 + area.v1)});
                        const Double3 direction{d.x, d.y, d.z};
                        const double solid_angle = panelSolidAngle(layout, area);
                        total_density += lighting.sky_map->density(direction) * solid_angle;
                        if (direction.y > 0)
                            sum += lighting.sky_map->radiance(direction).y *
                                   reflected(floor->coating, view, direction).y * solid_angle;
                    }
            EXPECT_NEAR(total_density, 1, 0.01);
            const double traced = look(eye, {0, 0, 0}, {.samples = 4096, .max_bounces = 1}).y;
            EXPECT_NEAR(traced, sum, 0.01 * sum);
        }
}

/// Walls of a closed box that are white and shine with radiance 1 add 1 with each bounce.
TEST_F(PathTracerTest, addsUpInAFurnace)
{
    material_.base_color = {1, 1, 1, 1};
    material_.emissive = {1, 1, 1};
    material_.roughness = 0.5f;
    for (const float side : {-1.0f, 1.0f})
        for (const Float3 axis : {Float3{1, 0, 0}, Float3{0, 1, 0}, Float3{0, 0, 1}})
            addSquare(2, axis * side, axis * -side);
    for (const uint32_t bounces : {0u, 1u, 2u, 6u})
        EXPECT_NEAR(look({0.1f, 0.2f, 0.3f}, {1, 0.4f, 0.3f}, {.samples = 4096, .max_bounces = bounces}).y,
                    bounces + 1.0, 0.01 * (bounces + 1));
}

/// Light of a square that shines, beside a sum over its area.
TEST_F(PathTracerTest, agreesWithTheIntegralOverALampWithAnArea)
{
    constexpr float kHeight = 1.5f;
    constexpr int kSteps = 64;
    for (const float roughness : {0.15f, 0.9f})
    {
        SCOPED_TRACE(roughness);
        test_ = {};
        scene_.reset();
        material_ = test::plainMaterial();
        material_.roughness = roughness;
        material_.base_color = {0.5f, 0.5f, 0.5f, 1};
        addSquare(20, {0, 0, 0}, {0, 1, 0});
        material_.emissive = {5000, 5000, 5000}; // beside which the sky is nothing
        addSquare(1, {0.3f, kHeight, 0}, {0, -1, 0});
        const Float3 eye{-1.2f, 1, 0.2f};
        const double traced = look(eye, {0, 0, 0}, {.samples = 4096, .max_bounces = 1}).y;

        const auto point = scene().nearest({Double3(eye), normalize(-Double3(eye)), 0, 1e30}, 0);
        ASSERT_TRUE(point.has_value());
        double sum = 0;
        for (int i = 0; i < kSteps * kSteps; ++i)
        {
            const Double3 offset{0.3 - 0.5 + (i % kSteps + 0.5) / kSteps, double{kHeight},
                                 -0.5 + (i / kSteps + 0.5) / kSteps};
            const Double3 light = normalize(offset);
            sum += 5000 * reflected(point->coating, normalize(Double3(eye)), light).y * light.y /
                   dot(offset, offset) / (kSteps * kSteps);
        }
        EXPECT_NEAR(traced, sum, 0.01 * sum);
    }
}

/// Light that a lamp sends to the floor over a square right above it, beside a sum over the square.
TEST_F(PathTracerTest, agreesWithTheIntegralOverASurfaceThatALampLights)
{
    constexpr float kHeight = 1.5f, kSide = 0.4f;
    constexpr int kSteps = 128;
    const Float3 lamp{0.05f, kHeight - 0.1f, 0};
    for (const float roughness : {0.3f, 0.9f})
    {
        SCOPED_TRACE(roughness);
        test_ = {};
        scene_.reset();
        material_ = test::plainMaterial();
        material_.base_color = {0.5f, 0.5f, 0.5f, 1};
        material_.roughness = roughness;
        addSquare(20, {0, 0, 0}, {0, 1, 0});
        addSquare(kSide, {0, kHeight, 0}, {0, -1, 0});
        test_.addLight(test::light(LightType::point, lamp, {0, -1, 0}, 1e6f)); // the sky is nothing beside it
        const Float3 eye{-1.2f, 1, 0.2f};
        const Double3 view = normalize(Double3(eye));
        const auto traced = [&](uint32_t bounces) {
            return look(eye, {0, 0, 0}, {.samples = 4096, .max_bounces = bounces}).y;
        };

        const auto floor = scene().nearest({Double3(eye), -view, 0, 1e30}, 0);
        ASSERT_TRUE(floor.has_value());
        double sum = 0;
        for (int i = 0; i < kSteps * kSteps; ++i)
        {
            const Double3 target{double{kSide} * ((i % kSteps + 0.5) / kSteps - 0.5), double{kHeight},
                                 double{kSide} * ((i / kSteps + 0.48) / kSteps - 0.5)}; // off the diagonal
            const Double3 direction = normalize(target);
            const auto square = scene().nearest({{}, direction, 0.001, 1e30}, 0);
            ASSERT_TRUE(square.has_value());
            const double area = double{kSide} * double{kSide} / (kSteps * kSteps);
            sum += underLights(scene(), *square, -direction, true).y *
                   reflected(floor->coating, view, direction).y * direction.y / dot(target, target) * area;
        }
        EXPECT_GT(sum, 0.1);
        EXPECT_NEAR(traced(2) - traced(1), sum, 0.02 * sum);
    }
}

TEST_F(PathTracerTest, shadowsALampUnlessNothingOccludes)
{
    addSquare(20, {0, 0, 0}, {0, 1, 0});
    addSquare(1, {0, 0.5f, 0}, {0, 1, 0});
    test_.addLight(test::light(LightType::point, {0, 2, 0}, {0, -1, 0}, 4));
    const Float3 eye{1.5f, 0.3f, 0}, below{0, 0, 0};
    const auto point = scene().nearest({Double3(eye), normalize(-Double3(eye)), 0, 1e30}, 0);
    ASSERT_TRUE(point.has_value());
    const double lamp = underLights(scene(), *point, normalize(Double3(eye)), false).y;
    const double open = look(eye, below, {.samples = 1, .occlusion = Occlusion::none}).y;
    EXPECT_GT(lamp, 0.3 * open);
    // the back of the square shadows the lamp, and hides nothing of the sky
    const double sky = open - lamp;
    EXPECT_NEAR(look(eye, below, {.samples = 1024, .max_bounces = 1}).y, sky, 0.01 * sky);
}

TEST_F(PathTracerTest, showsLightsAloneWithTheShadowsOfThoseThatCastThem)
{
    addSquare(20, {0, 0, 0}, {0, 1, 0});
    addSquare(1, {0, 0.5f, 0}, {0, 1, 0});
    test_.addLight(test::light(LightType::point, {0, 2, 0}, {0, -1, 0}, 4));
    const Float3 eye{1.5f, 0.3f, 0}, below{0, 0, 0}, beside{1, 0, 0};
    const auto lamp = [&](Float3 target)
    {
        const Double3 view = normalize(Double3(eye) - Double3(target));
        return underLights(scene(), *scene().nearest({Double3(eye), -view, 0, 1e30}, 0), view, false).y;
    };
    const PathTracing lights{.samples = 1, .through_centers = true, .occlusion = Occlusion::lights};
    EXPECT_NEAR(look(eye, beside, lights).y, lamp(beside), 0.01 * lamp(beside));
    EXPECT_EQ(look(eye, below, lights).y, 0);
    EXPECT_EQ(look(eye, {3, 1, 0}, lights).y, 0) << "no sky";
    SceneLighting lighting = scene().lighting();
    lighting.lights[0].casts_shadows = false;
    scene_->setLighting(lighting);
    EXPECT_NEAR(look(eye, below, lights).y, lamp(below), 0.01 * lamp(below));
}

TEST_F(PathTracerTest, flickersAsThePackSays)
{
    addSquare(20, {0, 0, 0}, {0, 1, 0});
    LightRecord torch = test::light(LightType::point, {0, 2, 0}, {0, -1, 0}, 4);
    torch.flicker_rate = 1;
    torch.flicker_amplitude = 0.5f;
    test_.addLight(torch);
    const PackView pack = test_.build();
    const double steady = readLighting(pack).lights[0].intensity.x;
    double least = steady, most = 0;
    for (int i = 0; i < 100; ++i)
    {
        const double now = readLighting(pack, 0.37 * i).lights[0].intensity.x;
        least = std::min(least, now);
        most = std::max(most, now);
    }
    EXPECT_GE(least, 0.5 * steady);
    EXPECT_LE(most, steady);
    EXPECT_GT(most - least, 0.3 * steady);
}

} // namespace
} // namespace hearth::reference
