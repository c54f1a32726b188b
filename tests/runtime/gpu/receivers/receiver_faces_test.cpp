// Tests the baked light of the faces of bricks on the device: against its CPU twin by bytes, and with
// live light beside it against the solver of all light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/face_lighting.h"
#include "cook/bricks/light/settled_light.h"
#include "cook/receivers/select/atlas.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "runtime/pack/receivers/receiver_light.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;
using formats::ReceiverLampKind;

constexpr std::array<uint32_t, 3> kVoxels{14, 10, 12};

/// Room of 3.5 x 2.5 x 3 m with a window to the sky, red and green walls, and a panel that shines.
BrickModel makeRoom()
{
    const auto solid = [](uint32_t x, uint32_t y, uint32_t z)
    { return makeShell(kVoxels)(x, y, z) && !(z == 0 && x > 3 && x < 9 && y > 3 && y < 8); };
    BrickModel model = brickModel(kVoxels, solid,
                                  [](std::array<uint32_t, 3> v, uint32_t side)
                                  {
                                      FaceLook look{{0.6f, 0.6f, 0.6f}, {}};
                                      if (v[0] == 0)
                                          look.albedo = {0.8f, 0.1f, 0.1f};
                                      if (v[0] == kVoxels[0] - 1)
                                          look.albedo = {0.1f, 0.7f, 0.2f};
                                      if (v[1] == kVoxels[1] - 1 && side == 2 && v[0] > 9)
                                          look.emission = {1, 2, 3};
                                      return look;
                                  });
    model.grid.voxel_size = 0.25f;
    return model;
}

class ReceiverFacesTest : public GpuTest
{
protected:
    /// Load the room with lamps, each of which the faces have apart. Adds a triangle far away, since a
    /// scene must draw something; the panel is its emission.
    void load(std::span<const LightRecord> lights)
    {
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(1, 1), test_.addMaterial(plainMaterial()))),
                          translated({0, -1000, 0}));
        for (const LightRecord& light : lights)
            test_.addLight(light);
        setBricks(test_, model_);
        {
            const formats::PackView without = test_.build();
            lighting_ = gpu::makeLighting(without);
        }
        makeReceivers(static_cast<uint32_t>(lights.size()));
        PackModel& pack = test_.model();
        pack.receiver_lamps = atlas_.lamps;
        pack.face_atlases = {atlas_.record};
        pack.face_blocks = atlas_.blocks;
        pack.face_words = atlas_.words;
        pack_.emplace(test_.build());
        scene_ = upload(*pack_, {.bricks = {.faces_per_frame = model_.grid.face_count / 2}});
        ASSERT_EQ(scene_->bricks->period, 2u);
        targets_.emplace(makeTargets(64, 48));
    }

    void drawFrames(uint32_t count, const DrawOptions& more = {})
    {
        DrawOptions options = more;
        options.width = 64;
        options.height = 48;
        for (uint32_t i = 0; i < count; ++i)
        {
            draw(*scene_, *targets_, {.position = {1.7f, 1.2f, 2.5f}, .target = {1, 1, 0}}, options);
            options.lights = {};
            options.lamp_weights = {};
            options.daylight = nullptr;
        }
    }

    uint32_t parts() const { return scene_->bricks->last_view.light_parts; }

    /// Words of baked light of all faces.
    std::vector<uint32_t> bakedWords()
    {
        const size_t faces = model_.albedo.size();
        const std::vector<uint32_t> words = read<uint32_t>(scene_->bricks->lighting, 3 * faces);
        return {words.begin() + static_cast<ptrdiff_t>(2 * faces), words.end()};
    }

    /// Radiance of all faces as passes over bricks read it.
    std::vector<Float3> radiance()
    {
        const size_t faces = model_.albedo.size();
        const auto live = read<shared::BrickLight>(scene_->bricks->lighting, faces);
        const std::vector<uint32_t> baked = bakedWords();
        std::vector<Float3> sum(faces);
        for (size_t face = 0; face < faces; ++face)
        {
            sum[face] = shared::decodeSharedExponentWord(baked[face]) * atlas_.record.scale;
            if ((parts() & shared::kLiveFaceLight) != 0)
                sum[face] += shared::decodeBrickLight(live[face]);
        }
        return sum;
    }

    /// Return what all faces have in the end under lights, as if nothing were baked.
    /// panel  weight of its emission
    std::vector<Float3> solve(const shared::SceneLighting& lighting, Float3 panel = {1, 1, 1})
    {
        BrickModel model = model_;
        for (uint32_t& code : model.emission)
            code = shared::encodeRadiance(shared::decodeRadiance(code) * panel);
        bricks::FaceLighting solver(makeBrickView(model));
        solver.sweep(lighting, 16, 90);
        std::vector<Float3> radiance;
        for (const shared::BrickLight& face : solver.faces())
            radiance.push_back(shared::decodeBrickLight(face));
        return radiance;
    }

    /// Compare radiances, by the largest difference of a channel over the largest value of that channel.
    static void expectNear(const std::vector<Float3>& radiance, const std::vector<Float3>& expected,
                           double share)
    {
        ASSERT_EQ(radiance.size(), expected.size());
        for (int c = 0; c < 3; ++c)
        {
            double most = 0, off = 0;
            for (size_t i = 0; i < radiance.size(); ++i)
            {
                most = std::max<double>(most, expected[i][c]);
                off = std::max<double>(off, std::abs(radiance[i][c] - expected[i][c]));
            }
            EXPECT_GT(most, 0.01) << c;
            EXPECT_LE(off, share * most) << "channel " << c;
        }
    }

    gpu::LampWeight weigh(uint32_t light, Float3 weight)
    {
        return gpu::weighLight(*scene_, light, weight).value();
    }

    BrickModel model_ = makeRoom();
    TestScene test_;
    std::optional<formats::PackView> pack_;
    shared::SceneLighting lighting_{};
    receivers::Atlas atlas_;
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::FrameTargets> targets_;

private:
    void makeReceivers(uint32_t lights)
    {
        std::vector<formats::ReceiverLampRecord> lamps{{0, 0}};
        bricks::LampSources sources{.count = lights + 2, .lamps_of_lights = {}, .emissions = {}};
        for (uint32_t i = 0; i < lights; ++i)
        {
            lamps.push_back({static_cast<uint32_t>(ReceiverLampKind::light), i});
            sources.lamps_of_lights.push_back(i + 1);
        }
        lamps.push_back({static_cast<uint32_t>(ReceiverLampKind::mesh_light), 0});
        for (uint32_t face = 0; face < model_.emission.size(); ++face)
            if (model_.emission[face] != 0)
                sources.emissions.push_back({face, lights + 1, {1, 1, 1}});
        const std::vector<Float3> light = bricks::settleLamps(makeBrickView(model_), lighting_, sources);
        // keep all lamps of a face, so that only codes differ
        atlas_ = receivers::packFaces(lamps, light, static_cast<uint32_t>(model_.albedo.size()),
                                      {.select = {.low = 1e-6, .high = 2e-6}});
    }
};

const std::array kLights{light(LightType::point, {1, 1.8f, 1.5f}, {0, -1, 0}, 4),
                         light(LightType::spot, {2.6f, 2, 2}, {-0.3f, -1, -0.2f}, 9), sun({0.3f, -0.8f, 1})};

TEST_F(ReceiverFacesTest, haveTheBytesOfTheCpu)
{
    load(kLights);
    const std::array weights{weigh(0, {0.3f, 0.5f, 2}), weigh(1, {0, 0, 0}),
                             gpu::weighEmission(*scene_, 0, {0.5f, 0.25f, 1}).value()};
    drawFrames(4, {.lamp_weights = weights});
    EXPECT_EQ(parts(), shared::kBakedFaceLight) << "no light is live";
    const std::vector<Float3> all{{1, 1, 1}, {0.3f, 0.5f, 2}, {0, 0, 0}, {1, 1, 1}, {0.5f, 0.25f, 1}};
    std::vector<uint32_t> expected(model_.albedo.size());
    pack::updateReceivers(atlas_.tables(), all, 0b1111, expected);
    EXPECT_EQ(bakedWords(), expected);
    for (const shared::BrickLight& live : read<shared::BrickLight>(scene_->bricks->lighting, expected.size()))
        ASSERT_EQ(live.code, 0u) << "passes over bricks add nothing to it";
}

TEST_F(ReceiverFacesTest, followLampsAndEmissionAtOnce)
{
    load(kLights);
    drawFrames(1);
    expectNear(radiance(), solve(lighting_), 0.01);

    const std::array weights{weigh(0, {0, 0, 0}), weigh(2, {1, 0.5f, 0.25f}),
                             gpu::weighEmission(*scene_, 0, {0.1f, 0.1f, 1}).value()};
    drawFrames(1, {.lamp_weights = weights});
    shared::SceneLighting dimmed = lighting_;
    dimmed.lights[0].intensity = {};
    dimmed.lights[2].intensity = dimmed.lights[2].intensity * Float3{1, 0.5f, 0.25f};
    expectNear(radiance(), solve(dimmed, {0.1f, 0.1f, 1}), 0.01);
}

/// Frames without GI leave faces behind; the next one with GI brings them up to date.
TEST_F(ReceiverFacesTest, areUpdatedWhereFramesShowThem)
{
    load(kLights);
    drawFrames(1, {.gi = false});
    EXPECT_EQ(scene_->receivers->updatedFaceGroups(), 0u);
    EXPECT_EQ(std::ranges::count(bakedWords(), 0u), static_cast<ptrdiff_t>(model_.albedo.size()));
    drawFrames(1);
    EXPECT_EQ(scene_->receivers->updatedFaceGroups(), 0b1111u);
    expectNear(radiance(), solve(lighting_), 0.01);
    drawFrames(1);
    EXPECT_EQ(scene_->receivers->updatedFaceGroups(), 0u) << "nothing has changed";
}

TEST_F(ReceiverFacesTest, addLightThatIsNotBaked)
{
    load(kLights);
    const LightRecord torch = light(LightType::point, {2.4f, 0.8f, 1}, {0, -1, 0}, 3);
    const gpu::LightChange on = gpu::changeLight(*scene_, 3, torch).value();
    drawFrames(60, {.lights = {&on, 1}});
    EXPECT_EQ(parts(), shared::kBakedFaceLight | shared::kLiveFaceLight);
    shared::SceneLighting all = lighting_;
    all.lights.push_back(on.record);
    expectNear(radiance(), solve(all), 0.015);

    LightRecord out = torch;
    out.intensity = 0;
    const gpu::LightChange off = gpu::changeLight(*scene_, 3, out).value();
    drawFrames(60, {.lights = {&off, 1}});
    expectNear(radiance(), solve(lighting_), 0.01);
    drawFrames(300);
    EXPECT_EQ(parts(), shared::kBakedFaceLight) << "passes over bricks are done";
}

/// A lamp that moves has no baked light, and passes over bricks bounce it until it is back.
TEST_F(ReceiverFacesTest, loseLampsThatMove)
{
    load(kLights);
    LightRecord away = kLights[0];
    away.world_from_light.m[0][3] += 1;
    const gpu::LightChange move = gpu::changeLight(*scene_, 0, away).value();
    drawFrames(60, {.lights = {&move, 1}});
    shared::SceneLighting moved = lighting_;
    moved.lights[0] = move.record;
    expectNear(radiance(), solve(moved), 0.015);

    const gpu::LightChange back = gpu::changeLight(*scene_, 0, kLights[0]).value();
    drawFrames(60, {.lights = {&back, 1}});
    expectNear(radiance(), solve(lighting_), 0.01);
}

/// Daylight moves the sun: its direct and bounced light is live then, and the sky's follows by its ratio.
TEST_F(ReceiverFacesTest, followDaylight)
{
    load(kLights);
    const gpu::DaylightChange day =
        gpu::changeDaylight(*scene_, shared::Daylight{.elevation_deg = 35, .azimuth_deg = 170}).value();
    drawFrames(60, {.daylight = &day});
    EXPECT_EQ(parts(), shared::kBakedFaceLight | shared::kLiveFaceLight);
    shared::SceneLighting other = lighting_;
    other.sky = day.sky;
    other.lights[2] = day.sun->record;
    // the sky of the window brightens by the ratio of level ground's light
    expectNear(radiance(), solve(other), 0.1);
}

/// Images see the light of both parts: beside a scene whose light is all live.
TEST_F(ReceiverFacesTest, areSeenByFragmentsAndRays)
{
    load(kLights);
    const DrawOptions options{.width = 64, .height = 48, .debug_view = shared::kViewBrickLighting};
    const shared::Camera camera{.position = {1.7f, 1.2f, 2.5f}, .target = {1, 1, 0}};
    drawFrames(1);
    const Image baked = draw(*scene_, *targets_, camera, options);
    PackModel& model = test_.model();
    model.receiver_lamps.clear();
    model.face_atlases.clear();
    model.face_blocks.clear();
    model.face_words.clear();
    const formats::PackView live_pack = test_.build();
    scene_ = upload(live_pack);
    drawFrames(60);
    const Image live = draw(*scene_, *targets_, camera, options);
    int bright = 0, most = 0;
    for (size_t i = 0; i < live.color.size(); ++i)
        for (int c = 0; c < 3; ++c)
        {
            bright = std::max(bright, channel(live.color[i], c));
            most = std::max(most, std::abs(channel(live.color[i], c) - channel(baked.color[i], c)));
        }
    EXPECT_GT(bright, 100);
    EXPECT_LE(most, 4);
}

} // namespace

} // namespace hearth::test
