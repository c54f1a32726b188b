// Tests the renderer's picture of a night scene beside rays: punctual lights of all kinds with ranges, cones
// and flicker, shadow maps of all of them, and alpha masks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/night.h"
#include "tests/reference/flip.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/lattice_texture.h"

#include <cstdio>
#include <cstdlib>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

/// Mean difference for a viewer who flips between both pictures, as the bench's aim for the market.
constexpr double kMaxFlip = 0.02;

class NightTest : public GpuTest
{
protected:
    /// Add a yard: ground, stones, balls of metal and paint, walls, and a fence with holes.
    void addYard()
    {
        formats::MaterialRecord stone = plainMaterial(), metal = plainMaterial(), paint = plainMaterial();
        stone.base_color = {0.5f, 0.47f, 0.42f, 1};
        metal.metallic = 1;
        metal.roughness = 0.35f;
        paint.base_color = {0.6f, 0.1f, 0.08f, 1};
        paint.roughness = 0.3f;
        const uint32_t materials[] = {test_.addMaterial(stone), test_.addMaterial(metal),
                                      test_.addMaterial(paint)};
        const uint32_t ground = test_.addMesh(withMaterial(makeQuad(100, 100), materials[0]));
        test_.addInstance(ground, lying({}));
        for (uint32_t i = 0; i < 3; ++i)
        {
            const uint32_t ball =
                test_.addMesh(withMaterial(shapes::rock(16, 0.15f * float(2 - i), i + 1), materials[i]));
            for (uint32_t k = 0; k < 4; ++k)
                test_.addInstance(ball, scaled(uniform(random_, 0.4f, 1),
                                               {uniform(random_, -6, 6), 0.5f, uniform(random_, -6, 6)}));
        }
        const uint32_t block = test_.addMesh(withMaterial(shapes::blocks(12), materials[0]));
        for (const Float3 at : {Float3{-4, 1, -4}, Float3{1, 1, -5}, Float3{5.5f, 1, -1}})
            test_.addInstance(block, scaled(0.08f, at));
    }

    /// Add a fence across the view whose holes are an alpha mask.
    void addFence()
    {
        formats::MaterialRecord lattice = plainMaterial();
        lattice.alpha_mode = shared::kAlphaMask;
        lattice.alpha_cutoff = 0.5f;
        lattice.flags |= formats::kMaterialDoubleSided;
        lattice.base_color_texture = makeTextureRef(
            test_.addImage(formats::TexelFormat::rgba8_srgb, 64, 32, makeLatticeTexels(64, 32)));
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(4, 2), test_.addMaterial(lattice))),
                          translated({-1, 1, 1.5f}));
    }

    void addLight(LightType type, float range)
    {
        const Float3 position{uniform(random_, -8, 8), uniform(random_, 1.5f, 4), uniform(random_, -8, 8)};
        const Float3 direction{uniform(random_, -0.7f, 0.7f), -1, uniform(random_, -0.7f, 0.7f)};
        LightRecord record = light(type, position, direction, 0.25f * range * range);
        record.range = range;
        record.color = {uniform(random_, 0.3f, 1), uniform(random_, 0.3f, 1), uniform(random_, 0.3f, 1)};
        record.outer_cone_rad = uniform(random_, 0.3f, 1.2f);
        record.inner_cone_rad = record.outer_cone_rad * uniform(random_, 0, 0.9f);
        if (random_() % 2 == 0)
        {
            record.flicker_rate = 8;
            record.flicker_amplitude = 0.8f;
            record.flicker_seed = static_cast<uint32_t>(random_());
        }
        test_.addLight(record);
    }

    /// Draw and trace the yard, print how far the pictures are apart, and return the drawn one's casting
    /// lights.
    size_t expectSame(const char* name, const gpu::ShadowOptions& shadows)
    {
        const formats::PackView pack = test_.build();
        const picture::NightView view{
            .camera = {.position = {5, 4.5f, 10}, .target = {0, 0.3f, -0.5f}, .y_fov_rad = 0.8f},
            .width = 240,
            .height = 135,
            .seconds = 1.7};
        const picture::DrawnNight night = picture::drawNight(host(), renderer(), pack, view, shadows).value();
        const reference::Image traced = picture::traceNight(pack, view, night.casting).value();
        const double flip = reference::flip(traced, night.image).mean();
        std::printf("%s: mean FLIP %.4f, %zu of %zu lights cast shadows\n", name, flip, night.casting.size(),
                    pack.lights().size());
        EXPECT_LE(flip, kMaxFlip);
        EXPECT_GT(reference::flip(traced, reference::Image(view.width, view.height)).mean(), 0.2)
            << "a black picture must not pass";
        if (const char* const folder = std::getenv("HEARTH_TEST_PICTURES"))
        {
            EXPECT_TRUE(
                reference::writePng(std::string(folder) + "/" + name + "-drawn.png", night.image).ok());
            EXPECT_TRUE(reference::writePng(std::string(folder) + "/" + name + "-traced.png", traced).ok());
        }
        return night.casting.size();
    }

    TestScene test_;
    std::mt19937 random_{26};
};

} // namespace

TEST_F(NightTest, looksAsTracedByManyLights)
{
    addYard();
    addFence();
    for (uint32_t i = 0; i < 192; ++i)
        addLight(i % 3 == 0 ? LightType::spot : LightType::point, uniform(random_, 2, 7));
    EXPECT_EQ(expectSame("many-lights", {}), 0u);
}

/// The moon has four maps, two points have twelve and each of the spots one: all that there may be.
TEST_F(NightTest, looksAsTracedWhereAllLightsCastShadows)
{
    addYard();
    addFence();
    LightRecord moon = sun({0.4f, -1, -0.3f});
    moon.intensity = 0.3f;
    moon.color = {0.5f, 0.65f, 1};
    test_.addLight(moon);
    for (uint32_t i = 0; i < 2; ++i)
        addLight(LightType::point, 9);
    for (uint32_t i = 0; i < 48; ++i)
        addLight(LightType::spot, uniform(random_, 4, 9));
    EXPECT_EQ(
        expectSame(
            "shadows",
            {.max_maps = 64, .texels = 1024, .split_range = {.near = 4, .far = 24}, .moving_layers = false}),
        51u);
}

} // namespace hearth::test
