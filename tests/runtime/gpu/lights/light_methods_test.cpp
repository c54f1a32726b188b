// Tests that the device lists lights as the CPU does, word for word, and that all light methods draw one
// image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/statistics/light_statistics_pass.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

constexpr float kRightAngle = 0.5f * std::numbers::pi_v<float>;

/// Light somewhere over the ground of the test scene: a lamp, or a spot of 1 to 90 degrees.
LightRecord randomLight(std::mt19937& random, float most_range)
{
    const Float3 position{uniform(random, -10, 10), uniform(random, 0.1f, 3), uniform(random, -10, 10)};
    const Float3 direction{uniform(random, -1, 1), uniform(random, -1, 0.3f), uniform(random, -1, 1)};
    const bool is_spot = random() % 2 == 0;
    LightRecord record =
        light(is_spot ? LightType::spot : LightType::point, position, direction, uniform(random, 0.2f, 2));
    record.color = {uniform(random, 0.2f, 1), uniform(random, 0.2f, 1), uniform(random, 0.2f, 1)};
    record.range = uniform(random, 0.3f, 1) * most_range;
    record.outer_cone_rad = random() % 8 == 0 ? kRightAngle : uniform(random, 1.0f / 90, 1) * kRightAngle;
    record.inner_cone_rad = record.outer_cone_rad * uniform(random, 0, 0.9f);
    return record;
}

class LightMethodsTest : public GpuTest
{
protected:
    /// Ground with rocks, one of them a masked or blended pattern of holes.
    void addGround()
    {
        const uint32_t stone = test_.addMaterial(plainMaterial());
        formats::MaterialRecord glass = plainMaterial();
        glass.base_color = {0.6f, 0.8f, 1, 0.5f};
        glass.roughness = 0.2f;
        glass.alpha_mode = shared::kAlphaBlend;
        formats::MaterialRecord metal = plainMaterial();
        metal.metallic = 1;
        metal.roughness = 0.3f;
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(24, 24), stone)), lying({}));
        const uint32_t rocks[] = {
            test_.addMesh(withMaterial(shapes::rock(12, 0.3f), stone)),
            test_.addMesh(withMaterial(shapes::rock(12, 0.1f, 2), test_.addMaterial(glass))),
            test_.addMesh(withMaterial(shapes::rock(12, 0, 3), test_.addMaterial(metal)))};
        for (uint32_t i = 0; i < 9; ++i)
            test_.addInstance(rocks[i % 3], translated({static_cast<float>(i % 3) * 5 - 5, 0.6f,
                                                        static_cast<float>(i / 3) * 5 - 6}));
    }

    void addLights(uint32_t count, float most_range)
    {
        for (uint32_t i = 0; i < count; ++i)
            test_.addLight(randomLight(random_, most_range));
    }

    void addSuns()
    {
        LightRecord moon = sun({0.3f, -1, 0.2f});
        moon.intensity = 0.1f;
        test_.addLight(moon);
        LightRecord endless = light(LightType::point, {3, 4, 3}, {0, -1, 0}, 1);
        test_.addLight(endless);
    }

    void load(const gpu::SceneOptions& options = {})
    {
        pack_.emplace(test_.build());
        scene_ = upload(*pack_, options);
        for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
            ASSERT_TRUE(renderer().prepareLightMethod(*scene_, static_cast<gpu::LightMethod>(method)).ok());
    }

    /// Words of the frame's lists: counts, numbers of lights, cells, and all indices that are in use.
    std::vector<uint32_t> lists() const
    {
        const gpu::LightBufferLayout& layout = scene_->lights->layout();
        const std::byte* mapped = scene_->tables->lighting.copy(scene_->tables->frame).mapped;
        const shared::LightListCounts counts = gpu::readLightCounts(*scene_);
        std::vector<uint32_t> words;
        const auto add = [&](VkDeviceSize offset, size_t count)
        {
            words.resize(words.size() + count);
            std::memcpy(words.data() + words.size() - count, mapped + offset, count * sizeof(uint32_t));
        };
        add(layout.lists, shared::kLightCountWords + counts.unranged + counts.ranged);
        add(layout.cells, scene_->lights->grid().cell_count);
        if (counts.overflows == 0)
            add(layout.indices, counts.index_words);
        return words;
    }

    /// Compare the lists of both processors in a frame, and the images of all methods.
    void expectOneImage(const shared::Camera& camera, const DrawOptions& options = {})
    {
        DrawOptions drawn = options;
        drawn.light_method = gpu::LightMethod::all;
        const Image expected = draw(*scene_, camera, drawn);
        for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
            for (const gpu::LightLister lister : {gpu::LightLister::gpu, gpu::LightLister::cpu})
            {
                drawn.light_method = static_cast<gpu::LightMethod>(method);
                drawn.light_lister = lister;
                const Image image = draw(*scene_, camera, drawn);
                EXPECT_EQ(image.color, expected.color) << gpu::kLightMethods[method].name;
                if (lister == gpu::LightLister::gpu)
                    on_gpu_ = lists();
                else
                    EXPECT_EQ(lists(), on_gpu_) << gpu::kLightMethods[method].name;
            }
    }

    TestScene test_;
    std::mt19937 random_{3};
    std::optional<formats::PackView> pack_;
    std::unique_ptr<gpu::Scene> scene_;
    std::vector<uint32_t> on_gpu_;
};

constexpr shared::Camera kOverview{.position = {8, 4, 9}, .target = {0, 0, 0}};

} // namespace

TEST_F(LightMethodsTest, drawOneImageByAFewLights)
{
    addGround();
    addLights(4, 8);
    load();
    expectOneImage(kOverview);
}

TEST_F(LightMethodsTest, drawOneImageByHundredsWithShadowsAndTheEyeInsideLights)
{
    addGround();
    addSuns();
    addLights(192, 6);
    load({.shadows = {.max_maps = 16, .texels = 256}});
    expectOneImage(kOverview);
    expectOneImage({.position = {0, 0.5f, 3}, .target = {0, 0.4f, 0}, .y_fov_rad = 1.5f});
    EXPECT_GT(gpu::readLightCounts(*scene_).cells, 20u);
}

TEST_F(LightMethodsTest, drawOneImageByAThousandLightsInAllSizes)
{
    addGround();
    addLights(1024, 3);
    load();
    for (const auto& [width, height] : {std::pair{1u, 1u}, {64u, 48u}, {161u, 90u}, {640u, 360u}})
        expectOneImage(kOverview, {.width = width, .height = height});
}

TEST_F(LightMethodsTest, drawOneImageOfCharacters)
{
    const DeformedScene characters({.rings = 12}, 5);
    scene_ = upload(characters.pack(), {.max_lights = 200});
    ASSERT_TRUE(renderer().prepareLightMethod(*scene_, gpu::LightMethod::all).ok());
    std::vector<gpu::LightChange> changes;
    for (uint32_t slot = 0; slot < 100; ++slot)
        changes.push_back(gpu::changeLight(*scene_, slot, randomLight(random_, 8)).value());
    const std::vector<TestPose> poses = characters.randomPoses(random_);
    const auto views = makeViews(poses);
    draw(*scene_, kOverview, {.poses = views, .lights = changes});
    expectOneImage(kOverview);
    EXPECT_GT(gpu::readLightCounts(*scene_).ranged, 50u);
}

TEST_F(LightMethodsTest, drawOneImageWithBricks)
{
    addGround();
    addLights(64, 8);
    constexpr std::array<uint32_t, 3> kVoxels{12, 6, 12};
    BrickModel bricks = brickModel(
        kVoxels, [](uint32_t, uint32_t y, uint32_t) { return y == 0; },
        [](auto, uint32_t) { return FaceLook{}; });
    bricks.grid.origin = {-6, -1, -6};
    bricks.grid.voxel_size = 1;
    setBricks(test_, bricks);
    load();
    // a scene for each method: the light of bricks changes from frame to frame
    const auto settle = [&](gpu::LightMethod method)
    {
        auto scene = upload(*pack_);
        EXPECT_TRUE(renderer().prepareLightMethod(*scene, method).ok());
        gpu::FrameTargets targets = makeTargets(160, 120);
        Image image;
        for (int frame = 0; frame < 4; ++frame)
            image = draw(*scene, targets, kOverview, {.light_method = method});
        return image.color;
    };
    EXPECT_EQ(settle(gpu::LightMethod::practical), settle(gpu::LightMethod::all));
}

TEST_F(LightMethodsTest, drawOneImageWhereListsOverflow)
{
    addGround();
    addLights(700, 40); // each light reaches nearly all cells
    load();
    expectOneImage(kOverview, {.width = 320, .height = 240});
    EXPECT_GT(gpu::readLightCounts(*scene_).overflows, 0u);
}

TEST_F(LightMethodsTest, drawNothingOfLightsThatAreOff)
{
    addGround();
    addLights(5, 6);
    for (LightRecord& record : test_.model().lights)
        record.intensity = 0;
    load();
    expectOneImage(kOverview);
    const shared::LightListCounts counts = gpu::readLightCounts(*scene_);
    EXPECT_EQ(counts.ranged + counts.unranged + counts.indices, 0u);
}

TEST_F(LightMethodsTest, drawLightsThatFramesAddChangeAndRemove)
{
    addGround();
    addLights(20, 6);
    load({.max_lights = 300});
    gpu::FrameTargets targets = makeTargets(160, 120);
    std::vector<LightRecord> now = test_.model().lights;
    now.resize(300); // all of intensity 0
    for (int frame = 0; frame < 8; ++frame)
    {
        std::vector<gpu::LightChange> changes;
        for (uint32_t i = 0; i < 40; ++i)
        {
            const uint32_t slot = random_() % 300;
            now[slot] = randomLight(random_, 6);
            if (random_() % 3 == 0)
                now[slot].intensity = 0;
            if (random_() % 8 == 0)
                now[slot].type = static_cast<uint32_t>(LightType::directional);
            changes.push_back(gpu::changeLight(*scene_, slot, now[slot]).value());
        }
        const Image image = draw(*scene_, targets, kOverview, {.lights = changes});
        const std::vector<uint32_t> on_gpu = lists();
        EXPECT_EQ(draw(*scene_, targets, kOverview, {.light_lister = gpu::LightLister::cpu}).color,
                  image.color);
        EXPECT_EQ(lists(), on_gpu);
        // as a scene that has had these lights all along: exposure is that of the scene as loaded
        std::vector<gpu::LightChange> all;
        const auto fresh = upload(*pack_, {.max_lights = 300});
        for (uint32_t slot = 0; slot < 300; ++slot)
            all.push_back(gpu::changeLight(*fresh, slot, now[slot]).value());
        EXPECT_EQ(draw(*fresh, kOverview, {.lights = all}).color, image.color) << frame;
    }
}

/// HEARTH_TEST_LIGHT_FRAMES: more frames than the few of a test run.
TEST_F(LightMethodsTest, thousandsOfLightsMayAllChangeInEachFrame)
{
    constexpr uint32_t kLights = shared::kMaxLights;
    const char* const more = std::getenv("HEARTH_TEST_LIGHT_FRAMES");
    const int frames = more == nullptr ? 12 : std::atoi(more);
    addGround();
    load({.max_lights = kLights});
    gpu::FrameTargets targets = makeTargets(128, 72);
    const VkDeviceSize bytes = scene_->arena.allocatedBytes();
    shared::LightLists twin;
    std::vector<shared::Light> lights(kLights);
    std::vector<gpu::LightChange> changes(kLights);
    for (int frame = 0; frame < frames; ++frame)
    {
        for (uint32_t slot = 0; slot < kLights; ++slot)
        {
            LightRecord record = randomLight(random_, 2);
            if (random_() % 4 == 0)
                record.intensity = 0;
            changes[slot] = gpu::changeLight(*scene_, slot, record).value();
            lights[slot] = changes[slot].record;
        }
        draw(*scene_, targets, kOverview, {.width = 128, .height = 72, .lights = changes});
        const shared::LightGridLayout grid = shared::makeLightGrid(
            shared::lightGridView(makeView(*scene_, kOverview, {.width = 128, .height = 72})));
        shared::LightListCounts counts;
        std::vector<uint32_t> rows(kLights), cells(shared::kMaxLightCells), indices(64u * 1024);
        twin.assign(grid, lights, {&counts, rows, cells, indices});
        std::vector<uint32_t> expected(shared::kLightCountWords);
        std::memcpy(expected.data(), &counts, sizeof(counts));
        expected.insert(expected.end(), rows.begin(), rows.begin() + counts.ranged);
        expected.insert(expected.end(), cells.begin(), cells.begin() + grid.grid.cell_count);
        if (counts.overflows == 0)
            expected.insert(expected.end(), indices.begin(), indices.begin() + counts.index_words);
        ASSERT_EQ(lists(), expected) << "frame " << frame;
    }
    EXPECT_EQ(scene_->arena.allocatedBytes(), bytes);
}

TEST_F(LightMethodsTest, statisticsCountWhatPixelsEvaluate)
{
    // a ground seen from straight above: places of pixels are known
    const uint32_t stone = test_.addMaterial(plainMaterial());
    test_.addInstance(test_.addMesh(withMaterial(makeQuad(100, 100), stone)), lying({}));
    addLights(192, 6);
    load();
    constexpr uint32_t kWidth = 160, kHeight = 120;
    const shared::Camera camera{.position = {0, 8, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}};
    gpu::FrameTargets targets = makeTargets(kWidth, kHeight);
    const auto pass =
        gpu::LightStatisticsPass::create(renderer().device(), renderer().layouts(), *scene_, targets);
    ASSERT_TRUE(pass.ok());
    const auto count = [&](gpu::LightMethod method)
    {
        draw(*scene_, targets, camera, {.light_method = method});
        EXPECT_TRUE(host()
                        .run(
                            [&](VkCommandBuffer commands)
                            {
                                pass->record(renderer().device(), commands, *scene_, targets, method);
                                return success();
                            })
                        .ok());
        return gpu::readLightCounts(*scene_);
    };
    const shared::LightListCounts cells = count(gpu::LightMethod::practical);
    const shared::LightListCounts all = count(gpu::LightMethod::all);
    const shared::LightListCounts again = count(gpu::LightMethod::practical);
    EXPECT_EQ(again.evaluated_low, cells.evaluated_low) << "counts begin anew in each frame";
    EXPECT_EQ(all.pixels, kWidth * kHeight);
    EXPECT_EQ(all.evaluated_low, kWidth * kHeight * all.ranged);
    EXPECT_EQ(all.longest, all.ranged);
    EXPECT_EQ(cells.reaching_low, all.reaching_low);
    EXPECT_LT(cells.evaluated_low, all.evaluated_low / 2);

    // the same by double and from the records
    uint32_t reaching = 0;
    const double half_height = 8 * std::tan(0.5 * double{camera.y_fov_rad});
    const double pixel = 2 * half_height / kHeight;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
        {
            const double place[] = {(x + 0.5 - kWidth / 2.0) * pixel, 0, (y + 0.5 - kHeight / 2.0) * pixel};
            for (const LightRecord& record : test_.model().lights)
            {
                const auto& m = record.world_from_light.m;
                double distance2 = 0, along = 0;
                for (size_t axis = 0; axis < 3; ++axis)
                {
                    const double offset = place[axis] - double{m[axis][3]};
                    distance2 += offset * offset;
                    along -= offset * double{m[axis][2]};
                }
                const double distance = std::sqrt(distance2);
                reaching += distance < double{record.range} &&
                            (record.type == static_cast<uint32_t>(LightType::point) ||
                             along > distance * std::cos(double{record.outer_cone_rad}));
            }
        }
    EXPECT_NEAR(all.reaching_low, reaching, 1e-3 * reaching) << "pixels on the edge of a light may differ";
}

} // namespace hearth::test
