// Tests the shadow map cache: cached maps equal freshly drawn ones bit for bit while the view, instances and
// streaming change, and they are reused if nothing in them changes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/pack/light_player.h"

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr uint32_t kRocks = 6; ///< instances 1 and on; 0 is the floor
constexpr DrawOptions kDrawn{.width = 64, .height = 48, .error_pixels = 1};

Affine3 choosePlace(std::mt19937& random)
{
    return scaled(uniform(random, 0.3f, 0.8f),
                  {uniform(random, -6, 6), uniform(random, 0.3f, 2), uniform(random, -6, 6)});
}

/// Build a floor with rocks under a sun and two spots.
PackView buildScene(TestScene& test, uint32_t detail)
{
    std::mt19937 random(7);
    const uint32_t white = test.addMaterial(plainMaterial());
    test.addInstance(test.addMesh(withMaterial(makeQuad(16, 16), white)), lying({0, 0, 0}));
    for (uint32_t i = 0; i < kRocks; ++i)
    {
        const uint32_t rock = test.addMesh(withMaterial(shapes::rock(detail, 0.25f, i), white));
        test.addInstance(rock, choosePlace(random));
    }
    test.addLight(light(LightType::spot, {-4, 4, 1}, {0.3f, -1, 0}, 30));
    test.addLight(sun({0.3f, -1, -0.4f}));
    test.addLight(light(LightType::spot, {5, 3, 4}, {-0.2f, -1, -0.1f}, 30));
    return test.build();
}

gpu::ShadowOptions smallMaps(bool moving_layers, gpu::ShadowDepth depth = gpu::ShadowDepth::d32)
{
    return {.max_maps = 8,
            .texels = 64,
            .splits = 2,
            .split_range = {.near = 1, .far = 20},
            .moving_layers = moving_layers,
            .spot_near = 0.2f,
            .depth = depth};
}

constexpr gpu::ShadowSphere kSphere{.center = {-3, 0.5f, 1}, .radius = 1.5f};

shared::Camera cameraAt(std::mt19937& random)
{
    const float reach = 8;
    return {.position = {uniform(random, -reach, reach), uniform(random, 0.5f, 4),
                         uniform(random, -reach, reach)},
            .target = {uniform(random, -1, 1), 0, uniform(random, -1, 1)},
            .y_fov_rad = 0.9f,
            .z_near = 0.05f};
}

class ShadowCacheTest : public GpuTest
{
protected:
    static const gpu::ShadowStatistics& getStatistics(const gpu::Scene& scene)
    {
        return scene.shadows->statistics();
    }

    std::vector<float> readMap(const gpu::Scene& scene, uint32_t map)
    {
        const uint32_t layer = scene.shadows->plan().block.maps[map].layer;
        auto depths = host().readDepth(renderer().device(), scene.shadows->image(), layer);
        HEARTH_ASSERT(depths.ok());
        return std::move(*depths);
    }

    /// Expect the same maps and the same image.
    void expectSame(const gpu::Scene& kept, const Image& kept_image, const gpu::Scene& fresh,
                    const Image& fresh_image, int frame)
    {
        ASSERT_EQ(kept_image.color, fresh_image.color) << "frame " << frame;
        ASSERT_EQ(getStatistics(kept).maps, getStatistics(fresh).maps);
        ASSERT_EQ(getStatistics(fresh).drawn_maps, getStatistics(fresh).maps);
        for (uint32_t map = 0; map < getStatistics(kept).maps; ++map)
            ASSERT_EQ(readMap(kept, map), readMap(fresh, map)) << "frame " << frame << ", map " << map;
    }
};

/// A view that walks, rests and jumps, spheres that come and go, and rocks that move.
class Walk
{
public:
    explicit Walk(uint32_t seed) : random_(seed), camera_(cameraAt(random_)) {}

    void step()
    {
        const auto what = random_() % 8;
        if (what == 0)
            camera_ = cameraAt(random_);
        else if (what < 5)
            camera_.position =
                camera_.position + Float3{uniform(random_, -0.1f, 0.1f), 0, uniform(random_, -0.1f, 0.1f)};
        if (random_() % 16 == 0)
            spheres_.empty() ? spheres_.push_back(kSphere) : spheres_.clear();
    }

    std::vector<gpu::InstanceMove> moves(const gpu::Scene& scene)
    {
        std::vector<gpu::InstanceMove> moves;
        if (random_() % 3 == 0)
        {
            const auto rock = static_cast<uint32_t>(1 + random_() % kRocks);
            moves.push_back(*gpu::moveInstance(scene, rock, choosePlace(random_)));
        }
        return moves;
    }

    const shared::Camera& camera() const { return camera_; }
    std::span<const gpu::ShadowSphere> spheres() const { return spheres_; }

private:
    std::mt19937 random_;
    shared::Camera camera_;
    std::vector<gpu::ShadowSphere> spheres_;
};

} // namespace

/// Runs with and without separate layers for moving casters; the fresh maps have none.
TEST_F(ShadowCacheTest, keptMapsAreFreshOnesWhileThingsMove)
{
    for (const bool moving_layers : {false, true})
    {
        TestScene test;
        const PackView pack = buildScene(test, 20);
        // layers of both formats are copied
        const auto depth = moving_layers ? gpu::ShadowDepth::d16 : gpu::ShadowDepth::d32;
        const auto kept = upload(pack, {.shadows = smallMaps(moving_layers, depth)});
        const auto fresh = upload(pack, {.shadows = smallMaps(false, depth)});
        EXPECT_EQ(kept->shadows->depth().depth, depth);
        Walk walk(1);
        uint32_t maps = 0, drawn = 0, moved = 0;
        for (int frame = 0; frame < 50; ++frame)
        {
            walk.step();
            const std::vector<gpu::InstanceMove> moves = walk.moves(*kept);
            DrawOptions options = kDrawn;
            options.moves = moves;
            options.shadow_spheres = walk.spheres();
            fresh->shadows->forget();
            const auto described = kept->shadows->findStale(makeView(*kept, walk.camera(), options),
                                                            kept->lights->lights(), walk.spheres(), moves);
            const Image kept_image = draw(*kept, walk.camera(), options);
            const auto moving = std::count_if(described.begin(), described.end(),
                                              [](const auto& map) { return map.copy_from.has_value(); });
            ASSERT_EQ(getStatistics(*kept).moved_maps, static_cast<uint32_t>(moving)) << frame;
            ASSERT_EQ(getStatistics(*kept).drawn_maps, described.size() - static_cast<size_t>(moving));
            const Image fresh_image = draw(*fresh, walk.camera(), options);
            ASSERT_NO_FATAL_FAILURE(expectSame(*kept, kept_image, *fresh, fresh_image, frame));
            maps += getStatistics(*kept).maps;
            drawn += getStatistics(*kept).drawn_maps;
            moved += getStatistics(*kept).moved_maps;
        }
        EXPECT_LT(drawn, maps * 3 / 4);
        EXPECT_GT(drawn, 50u);
        EXPECT_EQ(moved > 50, moving_layers);
    }
}

TEST_F(ShadowCacheTest, keptMapsAreFreshOnesWhilePagesComeAndGo)
{
    TestScene test;
    const PackView pack = buildScene(test, 48);
    const auto streamed = [&](bool moving_layers)
    {
        gpu::SceneOptions options;
        options.memory_budget = 2400 << 10;
        options.stream.max_loads = 1;
        options.frames_in_flight = 1;
        options.stream.read = [&pack](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
        { done(pack.decodePage(page, destination).ok()); };
        options.shadows = smallMaps(moving_layers);
        options.shadows.error_bias = 1; // every page that the frame requests is one of the maps' casters
        return upload(pack, options);
    };
    const auto kept = streamed(true);
    const auto fresh = streamed(false);
    gpu::FrameTargets targets = makeTargets(kDrawn.width, kDrawn.height);
    Walk walk(2);
    DrawOptions fine = kDrawn;
    fine.error_pixels = 0.1f;
    uint32_t maps = 0, drawn = 0, changed = 0;
    for (uint64_t frame = 1; frame <= 60; ++frame)
    {
        for (const gpu::Scene* scene : {kept.get(), fresh.get()})
            scene->stream->beginFrame(frame, frame - 1);
        changed += kept->stream->changedGroups().empty() ? 0u : 1u;
        if (frame % 3 == 0) // the pages of these frames arrive while nothing is drawn
        {
            const shared::FrameView view = makeView(*kept, walk.camera(), fine);
            const auto prefetch = [&](VkCommandBuffer commands)
            {
                renderer().recordPrefetch(commands, *kept, targets, view);
                renderer().recordPrefetch(commands, *fresh, targets, view);
                return success();
            };
            ASSERT_TRUE(host().run(prefetch).ok());
            continue;
        }
        DrawOptions options = fine;
        std::vector<gpu::InstanceMove> moves;
        if (frame % 8 == 0)
        {
            walk.step();
            moves = walk.moves(*kept);
        }
        options.moves = moves;
        options.shadow_spheres = walk.spheres();
        fresh->shadows->forget();
        const Image kept_image = draw(*kept, walk.camera(), options);
        const Image fresh_image = draw(*fresh, walk.camera(), options);
        ASSERT_NO_FATAL_FAILURE(expectSame(*kept, kept_image, *fresh, fresh_image, static_cast<int>(frame)));
        maps += getStatistics(*kept).maps;
        drawn += getStatistics(*kept).drawn_maps;
    }
    EXPECT_GT(changed, 15u);
    EXPECT_LT(drawn, maps * 3 / 4);
    EXPECT_GT(drawn, 10u);
}

TEST_F(ShadowCacheTest, mapsAreDrawnWhereSomethingChanges)
{
    for (const bool moving_layers : {false, true})
    {
        TestScene test;
        const PackView pack = buildScene(test, 20);
        const auto scene = upload(pack, {.shadows = smallMaps(moving_layers)});
        shared::Camera camera{.position = {0.1f, 2.1f, 6.1f}, .target = {0.1f, 0.1f, 0.1f}, .z_near = 0.05f};
        const auto drawnBy = [&](const DrawOptions& options)
        {
            draw(*scene, camera, options);
            return getStatistics(*scene);
        };
        const auto drawnByMove = [&](Float3 place)
        {
            const gpu::InstanceMove move = *gpu::moveInstance(*scene, 1, scaled(0.3f, place));
            DrawOptions options = kDrawn;
            options.moves = {&move, 1};
            return drawnBy(options);
        };
        EXPECT_EQ(drawnBy(kDrawn).drawn_maps, 4u); // two splits of the sun, a cone for each spot
        EXPECT_EQ(drawnBy(kDrawn).drawn_maps, 0u);
        // below the first spot and beside the second one
        drawnByMove({-3.5f, 0.5f, 1});
        const gpu::ShadowStatistics moved = drawnByMove({-3.6f, 0.5f, 1});
        EXPECT_EQ(moved.drawn_maps, moving_layers ? 0u : 3u);
        EXPECT_EQ(moved.moved_maps, moving_layers ? 3u : 0u);
        EXPECT_EQ(drawnBy(kDrawn).drawn_maps + drawnBy(kDrawn).moved_maps, 0u);
        // the eye's step stays in its cell: the splits follow it, the spots' maps are reused
        camera.position.x += 0.02f;
        camera.target.x += 0.02f;
        EXPECT_LE(drawnBy(kDrawn).drawn_maps, 2u);
        // another threshold gives another cut
        DrawOptions finer = kDrawn;
        finer.error_pixels = 0.5f;
        EXPECT_EQ(drawnBy(finer).drawn_maps, 4u);
    }
}

/// Flicker changes no projection.
TEST_F(ShadowCacheTest, flickeringLightsKeepTheirMaps)
{
    TestScene test;
    (void)buildScene(test, 8);
    for (LightRecord& record : test.model().lights)
        record.flicker_rate = 5, record.flicker_amplitude = 0.9f;
    const PackView pack = test.build();
    const auto scene = upload(pack, {.shadows = smallMaps(false)});
    const pack::PosePlayer poses(pack);
    pack::LightPlayer player(pack);
    const shared::Camera camera{
        .position = {0.1f, 2.1f, 6.1f}, .target = {0.1f, 0.1f, 0.1f}, .z_near = 0.05f};
    std::vector<Image> images;
    for (const double seconds : {0.31, 0.47, 9.6, 0.31})
    {
        player.update(poses, seconds);
        EXPECT_EQ(player.changed().size(), 3u);
        std::vector<gpu::LightChange> changes;
        for (const pack::PlayedLight& played : player.changed())
            changes.push_back(*gpu::changeLight(*scene, played.light, played.record));
        DrawOptions options = kDrawn;
        options.lights = changes;
        images.push_back(draw(*scene, camera, options));
        EXPECT_EQ(getStatistics(*scene).drawn_maps, images.size() == 1 ? 4u : 0u) << seconds;
        EXPECT_EQ(getStatistics(*scene).moved_maps, 0u);
    }
    EXPECT_NE(images[0].color, images[1].color);
    EXPECT_NE(images[1].color, images[2].color);
    EXPECT_EQ(images[0].color, images[3].color) << "the same time";
}

} // namespace hearth::test
