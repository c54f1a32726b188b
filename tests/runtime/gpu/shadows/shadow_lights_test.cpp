// Tests shadows of more lights than have maps: rows and maps reach their frames while lights come, go, move
// and change their type.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/pack/light_player.h"

#include <algorithm>
#include <set>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr uint32_t kSlots = 40;
constexpr gpu::ShadowOptions kSmallMaps{.max_maps = 26,
                                        .texels = 64,
                                        .splits = 2,
                                        .split_range = {.near = 0.5f, .far = 20},
                                        .moving_layers = false};
constexpr DrawOptions kSmall{.width = 96, .height = 64};

PackView buildRocks(TestScene& test)
{
    const uint32_t white = test.addMaterial(plainMaterial());
    test.addInstance(test.addMesh(withMaterial(makeQuad(16, 16), white)), lying({0, 0, 0}));
    for (uint32_t i = 0; i < 9; ++i)
        test.addInstance(
            test.addMesh(withMaterial(shapes::rock(8, 0.25f, i), white)),
            scaled(0.6f, {static_cast<float>(i % 3) * 4 - 4, 0.5f, static_cast<float>(i / 3) * 4 - 4}));
    test.addLight(light(LightType::point, {0, 2, 0}, {0, -1, 0}, 2));
    return test.build();
}

LightRecord chooseLight(std::mt19937& random)
{
    if (random() % 30 == 0)
    {
        LightRecord weak = sun({uniform(random, -1, 1), -1, uniform(random, -1, 1)});
        weak.intensity = 0.2f;
        return weak;
    }
    const Float3 place{uniform(random, -7, 7), uniform(random, 0.5f, 3), uniform(random, -7, 7)};
    LightRecord record = light(random() % 3 == 0 ? LightType::point : LightType::spot, place,
                               {uniform(random, -1, 1), -1, uniform(random, -1, 1)}, uniform(random, 1, 5));
    record.range = random() % 10 == 0 ? 0 : uniform(random, 2, 8);
    record.outer_cone_rad = uniform(random, 0.3f, 1.2f);
    record.inner_cone_rad = 0.5f * record.outer_cone_rad;
    if (random() % 4 == 0)
        record.intensity = 0;
    return record;
}

shared::Camera chooseCamera(std::mt19937& random)
{
    const Float3 eye{uniform(random, -8, 8), uniform(random, 0.5f, 4), uniform(random, -8, 8)};
    return {.position = eye, .target = {uniform(random, -2, 2), 0, uniform(random, -2, 2)}};
}

class ShadowLightsTest : public GpuTest
{
protected:
    /// The lights that have maps, by their slots.
    static std::set<uint32_t> findHolders(const gpu::Scene& scene)
    {
        std::set<uint32_t> slots;
        for (const shared::ShadowLights::Holder& holder : scene.shadows->holders())
            slots.insert(holder.slot);
        return slots;
    }

    /// Expect that each light in the buffer of the last frame has the row that the frame gave it.
    static void expectRows(const gpu::Scene& scene)
    {
        std::vector<uint32_t> expected(scene.lights->lights().size(), shared::kNoShadow);
        for (const shared::ShadowLights::Holder& holder : scene.shadows->holders())
            expected[holder.slot] = holder.row;
        const std::byte* const mapped = scene.tables->lighting.copy(scene.tables->frame).mapped;
        for (uint32_t slot = 0; slot < expected.size(); ++slot)
        {
            shared::Light light;
            std::memcpy(&light, mapped + scene.lights->layout().light(slot), sizeof(light));
            if (!shared::isLightOff(light))
                ASSERT_EQ(light.shadow_row, expected[slot]) << "slot " << slot;
        }
    }

    /// Change some slots at random.
    std::vector<gpu::LightChange> changeSome(const gpu::Scene& scene, std::vector<LightRecord>& now,
                                             uint32_t count)
    {
        std::vector<gpu::LightChange> changes;
        for (uint32_t i = 0; i < count; ++i)
        {
            const uint32_t slot = random_() % kSlots;
            now[slot] = chooseLight(random_);
            changes.push_back(gpu::changeLight(scene, slot, now[slot]).value());
        }
        return changes;
    }

    std::mt19937 random_{5};
};

} // namespace

/// A frame shows what a scene shows that has these lights from the start, unless it holds on to some that
/// would not be chosen today.
TEST_F(ShadowLightsTest, framesAreThoseOfFreshScenesWhileLightsComeAndGo)
{
    TestScene test;
    const PackView pack = buildRocks(test);
    const gpu::SceneOptions options{.max_lights = kSlots, .shadows = kSmallMaps};
    const auto scene = upload(pack, options);
    gpu::FrameTargets targets = makeTargets(kSmall.width, kSmall.height);
    std::vector<LightRecord> now(kSlots);
    now[0] = test.model().lights[0];
    shared::Camera camera = chooseCamera(random_);
    uint32_t compared = 0, crowded = 0, drawn = 0, maps = 0;
    for (int frame = 0; frame < 240; ++frame)
    {
        if (random_() % 6 == 0)
            camera = chooseCamera(random_);
        DrawOptions drawing = kSmall;
        const std::vector<gpu::LightChange> changes = changeSome(*scene, now, frame < 10 ? 8 : random_() % 4);
        drawing.lights = changes;
        const Image image = draw(*scene, targets, camera, drawing);
        const gpu::ShadowStatistics& statistics = scene->shadows->statistics();
        ASSERT_NO_FATAL_FAILURE(expectRows(*scene)) << "frame " << frame;
        crowded += statistics.unshadowed_lights > 0;
        drawn += statistics.drawn_maps;
        maps += statistics.maps;
        if (frame % 8 != 0)
            continue;
        const auto fresh = upload(pack, options);
        std::vector<gpu::LightChange> all;
        for (uint32_t slot = 0; slot < kSlots; ++slot)
            all.push_back(gpu::changeLight(*fresh, slot, now[slot]).value());
        drawing.lights = all;
        const Image fresh_image = draw(*fresh, camera, drawing);
        if (findHolders(*scene) != findHolders(*fresh))
            continue;
        ++compared;
        ASSERT_EQ(image.color, fresh_image.color) << "frame " << frame;
        EXPECT_EQ(statistics.shadowed_lights, fresh->shadows->statistics().shadowed_lights);
        EXPECT_EQ(statistics.unshadowed_lights, fresh->shadows->statistics().unshadowed_lights);
    }
    EXPECT_GT(compared, 10u);
    EXPECT_GT(crowded, 150u) << "more lights than maps";
    EXPECT_LT(drawn, maps * 3 / 4) << "maps stay with their lights";
}

/// A light that a game adds has a shadow in the frame that adds it, and so has one of another type.
TEST_F(ShadowLightsTest, lightsThatFramesAddOrRetypeCastShadows)
{
    TestScene test;
    const PackView pack = buildRocks(test);
    const gpu::SceneOptions options{.max_lights = kSlots, .shadows = kSmallMaps};
    const shared::Camera camera{.position = {0, 6, 9}, .target = {0, 0, 0}};
    const auto drawWith = [&](const gpu::Scene& scene, const LightRecord& record, uint32_t slot)
    {
        const gpu::LightChange change = gpu::changeLight(scene, slot, record).value();
        DrawOptions drawing = kSmall;
        drawing.lights = {&change, 1};
        return draw(scene, camera, drawing);
    };
    const LightRecord lamp = light(LightType::point, {2, 3, 1}, {0, -1, 0}, 20);
    LightRecord spot = light(LightType::spot, {-3, 4, 1}, {0.3f, -1, 0}, 60);
    spot.outer_cone_rad = 1;
    const auto shadowed = upload(pack, options);
    const auto unshadowed = upload(pack, {.max_lights = kSlots});
    for (const LightRecord& record : {lamp, spot, sun({0.4f, -1, 0.3f}), lamp})
        EXPECT_NE(drawWith(*shadowed, record, 7).color, drawWith(*unshadowed, record, 7).color);
    EXPECT_EQ(shadowed->shadows->statistics().shadowed_lights, 2u);
    LightRecord off = lamp;
    off.intensity = 0;
    drawWith(*shadowed, off, 7);
    EXPECT_EQ(shadowed->shadows->statistics().shadowed_lights, 1u);
    EXPECT_EQ(shadowed->shadows->statistics().unshadowed_lights, 0u);
}

/// Lights of about equal weight that flicker, more than there are maps for: none takes the place of another,
/// and no map is drawn again.
TEST_F(ShadowLightsTest, flickerMovesNoMaps)
{
    TestScene test;
    (void)buildRocks(test);
    for (uint32_t i = 0; i < 12; ++i)
    {
        LightRecord flame = light(LightType::point, {static_cast<float>(i % 4) * 3 - 4, 1.5f, 0}, {0, -1, 0},
                                  1 + 0.01f * static_cast<float>(i));
        flame.flicker_rate = 7;
        flame.flicker_amplitude = 1;
        flame.flicker_seed = i;
        test.addLight(flame);
    }
    const PackView pack = test.build();
    const auto scene = upload(pack, {.max_lights = kSlots, .shadows = kSmallMaps});
    const pack::PosePlayer poses(pack);
    pack::LightPlayer player(pack);
    const shared::Camera camera{.position = {0, 6, 9}, .target = {0, 0, 0}};
    std::set<uint32_t> holders;
    for (int frame = 0; frame < 40; ++frame)
    {
        player.update(poses, frame * 0.0317);
        std::vector<gpu::LightChange> changes;
        for (const pack::PlayedLight& played : player.changed())
            changes.push_back(
                gpu::changeLight(*scene, played.light, played.record, played.steady_intensity).value());
        DrawOptions drawing = kSmall;
        drawing.lights = changes;
        draw(*scene, camera, drawing);
        if (frame == 0)
            holders = findHolders(*scene);
        EXPECT_EQ(findHolders(*scene), holders);
        EXPECT_EQ(scene->shadows->statistics().drawn_maps > 0, frame == 0);
    }
    EXPECT_EQ(holders.size(), 4u);
}

} // namespace hearth::test
