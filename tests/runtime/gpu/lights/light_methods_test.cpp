// Tests that the device lists lights of cells as the CPU does, word for word, and that all light methods draw
// one image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/statistics/light_statistics_pass.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/runtime/gpu/lights/all_lights_test.h"
#include "tests/runtime/gpu/lights/light_words.h"
#include "tests/runtime/gpu/lights/random_light.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/lattice_texture.h"

#include <algorithm>
#include <numbers>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

class LightMethodsTest : public AllLightsTest
{
protected:
    /// Add ground with rocks, some of them of glass or unlit, and two sheets: the first has holes by an alpha
    /// mask, the second is blended.
    void addGround()
    {
        // all materials have a texture: so those that are lit have one variant of the shading pipelines
        formats::MaterialRecord plain = plainMaterial();
        plain.base_color_texture = makeTextureRef(
            test_.addImage(formats::TexelFormat::rgba8_srgb, 64, 32, makeLatticeTexels(64, 32)));
        const uint32_t stone = test_.addMaterial(plain);
        formats::MaterialRecord glass = plain;
        glass.base_color = {0.6f, 0.8f, 1, 0.5f};
        glass.roughness = 0.2f;
        glass.alpha_mode = shared::kAlphaBlend;
        formats::MaterialRecord metal = plain;
        metal.metallic = 1;
        metal.roughness = 0.3f;
        metal_ = test_.addMaterial(metal);
        formats::MaterialRecord unlit = plain;
        unlit.flags |= formats::kMaterialUnlit;
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(24, 24), stone)), lying({}));
        const uint32_t rocks[] = {
            test_.addMesh(withMaterial(shapes::rock(12, 0.3f), stone)),
            test_.addMesh(withMaterial(shapes::rock(12, 0.1f, 2), test_.addMaterial(glass))),
            test_.addMesh(withMaterial(shapes::rock(12, 0, 3), metal_)),
            test_.addMesh(withMaterial(shapes::rock(12, 0.2f, 4), test_.addMaterial(unlit)))};
        for (uint32_t i = 0; i < 9; ++i)
            test_.addInstance(rocks[i == 4 ? 3 : i % 3], translated({static_cast<float>(i % 3) * 5 - 5, 0.6f,
                                                                     static_cast<float>(i / 3) * 5 - 6}));
        first_sheet_ = static_cast<uint32_t>(test_.model().instances.size());
        for (const uint32_t mode : {shared::kAlphaMask, shared::kAlphaBlend})
        {
            formats::MaterialRecord cloth = plain;
            cloth.base_color.w = mode == shared::kAlphaMask ? 1 : 0.7f;
            cloth.alpha_mode = mode;
            cloth.alpha_cutoff = 0.5f;
            cloth.flags |= formats::kMaterialDoubleSided;
            test_.addInstance(test_.addMesh(withMaterial(makeQuad(4, 2), test_.addMaterial(cloth))),
                              translated({mode == shared::kAlphaMask ? 2.5f : -2.0f, 1.2f, 2.5f}));
        }
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
        prepareAll(*scene_);
    }

    static void prepareAll(gpu::Scene& scene)
    {
        for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
            ASSERT_TRUE(renderer().prepareLightMethod(scene, static_cast<gpu::LightMethod>(method)).ok());
    }

    /// Compare images: those of methods that add the same terms in one order are equal; others round stored
    /// surfaces and sums, by 1 of 255 in all but a thousandth of the pixels, and by 2 at most. Those that
    /// approximate are kMaxMean off on average.
    static void expectSame(const Image& image, const Image& expected, gpu::LightMethod method)
    {
        const gpu::LightMethodFacts& facts = gpu::lightMethodFacts(method);
        if (facts.approximates)
        {
            EXPECT_LT(meanDifference(image, expected), kMaxMean) << facts.name;
            EXPECT_EQ(countLost(image, expected), 0u) << facts.name;
            return;
        }
        if (facts.path == gpu::LightPath::materials || facts.path == gpu::LightPath::light_bits)
        {
            EXPECT_EQ(image.color, expected.color) << facts.name;
            return;
        }
        ASSERT_EQ(image.color.size(), expected.color.size());
        size_t off_by_two = 0;
        int largest = 0;
        for (size_t i = 0; i < image.color.size(); ++i)
        {
            int difference = 0;
            for (int c = 0; c < 3; ++c)
                difference = std::max(difference,
                                      std::abs(channel(image.color[i], c) - channel(expected.color[i], c)));
            largest = std::max(largest, difference);
            off_by_two += difference >= 2 ? 1 : 0;
        }
        EXPECT_LE(largest, 2) << facts.name;
        EXPECT_LE(1000 * off_by_two, image.color.size()) << facts.name;
    }

    /// Return the number of pixels that are black in place of a colour.
    static size_t countLost(const Image& image, const Image& expected)
    {
        const auto sum = [](uint32_t color)
        { return channel(color, 0) + channel(color, 1) + channel(color, 2); };
        size_t lost = 0;
        for (size_t i = 0; i < image.color.size(); ++i)
            lost += sum(image.color[i]) == 0 && sum(expected.color[i]) > 60 ? 1 : 0;
        return lost;
    }

    /// Return how far channels are off, of 255.
    static double meanDifference(const Image& image, const Image& expected)
    {
        EXPECT_EQ(image.color.size(), expected.color.size());
        double sum = 0;
        for (size_t i = 0; i < image.color.size(); ++i)
            for (int c = 0; c < 3; ++c)
                sum += std::abs(channel(image.color[i], c) - channel(expected.color[i], c));
        return sum / (3.0 * static_cast<double>(image.color.size()));
    }

    enum class Methods
    {
        all,
        that_read_lists, ///< in place of volumes of lights, each drawn
    };

    /// Compare the lists of both processors in a frame, and the images of methods. The last frame is the
    /// default method's.
    void expectOneImage(const shared::Camera& camera, const DrawOptions& options = {},
                        Methods methods = Methods::all)
    {
        DrawOptions drawn = options;
        drawn.light_method = gpu::LightMethod::all;
        const Image expected = draw(*scene_, camera, drawn);
        for (size_t method = gpu::kLightMethodCount; method-- > 0;)
        {
            const gpu::LightMethodFacts& facts = gpu::kLightMethods[method];
            if (methods == Methods::that_read_lists && facts.light_list == shared::kLightListVolumes)
                continue;
            for (const gpu::LightLister lister : {gpu::LightLister::gpu, gpu::LightLister::cpu})
            {
                if (lister == gpu::LightLister::cpu && facts.areas != gpu::LightAreas::cells)
                    continue;
                drawn.light_method = static_cast<gpu::LightMethod>(method);
                drawn.light_lister = lister;
                const Image image = draw(*scene_, camera, drawn);
                expectSame(image, expected, drawn.light_method);
                if (lister == gpu::LightLister::gpu)
                    on_gpu_ = readLightWords(*scene_);
                else
                    EXPECT_EQ(readLightWords(*scene_), on_gpu_) << facts.name;
            }
        }
    }

    static constexpr double kMaxMean = 4;
    TestScene test_;
    std::mt19937 random_{3};
    std::optional<formats::PackView> pack_;
    std::unique_ptr<gpu::Scene> scene_;
    std::vector<uint32_t> on_gpu_;
    uint32_t first_sheet_ = 0; ///< instance
    uint32_t metal_ = 0;       ///< material
};

constexpr shared::Camera kOverview{.position = {8, 4, 9}, .target = {0, 0, 0}};
constexpr shared::Camera kParallel{.position = {8, 4, 9}, .target = {0, 0, 0}, .half_height = 4, .z_far = 40};

} // namespace

/// The other tests compare images of this ground.
TEST_F(LightMethodsTest, drawGroundThatShowsThroughAMaskAndThroughABlendedSheet)
{
    addGround();
    load();
    const Image image = draw(*scene_, kOverview);
    const auto seen = image.seen();
    for (const uint32_t sheet : {first_sheet_, first_sheet_ + 1})
    {
        size_t pixels = 0, ends = 0; // of the sheet; of its runs in rows
        for (size_t i = 0; i + 1 < seen.size(); ++i)
        {
            pixels += seen[i][0] == sheet ? 1 : 0;
            ends += seen[i][0] == sheet && seen[i + 1][0] != sheet ? 1 : 0;
        }
        EXPECT_GT(pixels, 200u) << sheet;
        EXPECT_GT(ends, 2 * uint32_t{image.height} / 3) << "holes end runs, and there are fewer rows";
    }
}

TEST_F(LightMethodsTest, drawOneImageByAFewLights)
{
    addGround();
    addLights(4, 8);
    load();
    expectOneImage(kOverview);
    expectOneImage(kParallel);
}

/// Methods that light surfaces apart from their materials light these where they are shaded.
TEST_F(LightMethodsTest, drawOneImageOfLacquer)
{
    addGround();
    formats::MaterialLayersRecord lacquer = formats::neutralLayers(metal_);
    lacquer.clearcoat = 0.8f;
    lacquer.clearcoat_roughness = 0.2f;
    test_.model().material_layers = {lacquer};
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

/// Volumes are marked in the stencil: what one light leaves there would light the pixels of the next ones.
TEST_F(LightMethodsTest, drawOneImageWithTheEyeInOnAndBeforeEachVolume)
{
    addGround();
    const auto add = [&](LightType type, float range, float cone, const Float3& direction)
    {
        LightRecord record = light(type, {0, 1.5f, 0}, direction, 1 + 0.01f * range * range);
        record.range = range;
        record.outer_cone_rad = cone;
        record.inner_cone_rad = 0.5f * cone;
        test_.addLight(record);
    };
    for (const float range : {0.001f, 0.5f, 3.0f, 40.0f, 10'000.0f})
    {
        add(LightType::point, range, 0, {0, -1, 0});
        for (const float share : {0.01f, 0.3f, 0.5f, 0.51f, 0.9f, 1.0f})
            add(LightType::spot, range, 0.5f * share * std::numbers::pi_v<float>, {0.3f, -1, 0.1f});
    }
    load();
    // within all of them; on the ball of 3 m, and near it; on the axis of the cones, behind and before them
    for (const Float3 position :
         {Float3{0, 1.5f, 0.001f}, Float3{0, 1.5f, 3}, Float3{0, 1.5f, 3.0001f}, Float3{0, 1.5f, 2.9f},
          Float3{0.1f, 1.2f, 0.05f}, Float3{-0.6f, 3.5f, -0.2f}, Float3{0, 1.5f, 3.9f}, Float3{12, 5, 12}})
        expectOneImage({.position = position, .target = {0.2f, 0, -1}});
}

TEST_F(LightMethodsTest, drawOneImageByAThousandLightsInAllSizes)
{
    addGround();
    addLights(1024, 3);
    load();
    for (const auto& [width, height] : {std::pair{1u, 1u}, {64u, 48u}, {161u, 90u}})
        expectOneImage(kOverview, {.width = width, .height = height});
}

TEST_F(LightMethodsTest, drawOneImageOfCharacters)
{
    const DeformedScene characters({.rings = 12}, 5);
    scene_ = upload(characters.pack(), {.max_lights = 200});
    prepareAll(*scene_);
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
        return image;
    };
    const Image expected = settle(gpu::LightMethod::all);
    for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
        expectSame(settle(static_cast<gpu::LightMethod>(method)), expected,
                   static_cast<gpu::LightMethod>(method));
}

TEST_F(LightMethodsTest, drawOneImageWhereListsOverflow)
{
    addGround();
    addLights(700, 40); // each light reaches nearly all cells
    load();
    expectOneImage(kOverview, {.width = 320, .height = 240}, Methods::that_read_lists);
    EXPECT_GT(gpu::readLightCounts(*scene_).overflows, 0u);
}

TEST_F(LightMethodsTest, drawOneImageWhereListsOfTilesAndSlotsOverflow)
{
    addGround();
    const uint32_t sheet =
        test_.addMesh(withMaterial(makeQuad(0.2f, 0.2f), test_.addMaterial(plainMaterial())));
    for (uint32_t i = 0; i < 400; ++i)
        test_.addInstance(sheet, lying({static_cast<float>(i % 20) * 0.3f - 3, 0.3f,
                                        static_cast<float>(i / 20) * 0.3f - 3}));
    addLights(160, 100);
    for (LightRecord& record : test_.model().lights)
        record.type = static_cast<uint32_t>(LightType::point);
    load();
    constexpr shared::Camera kFromAbove{.position = {0, 6, 0.1f}, .target = {0, 0, 0}};
    // there is room for 160 x 256 indices, and each of 300 tiles and 400 slots has 160
    for (const gpu::LightMethod method : {gpu::LightMethod::tiled_forward, gpu::LightMethod::forward})
    {
        DrawOptions options{.width = 640, .height = 480, .light_method = gpu::LightMethod::all};
        const Image expected = draw(*scene_, kFromAbove, options);
        options.light_method = method;
        EXPECT_EQ(draw(*scene_, kFromAbove, options).color, expected.color);
        EXPECT_GT(gpu::readLightCounts(*scene_).overflows, 0u);
    }
}

TEST_F(LightMethodsTest, drawOneImageInTheFrameThatAddsTheFirstLight)
{
    addGround();
    const auto draw_first = [&](gpu::LightMethod method)
    {
        load({.max_lights = 4});
        LightRecord record = light(LightType::point, {0, 2, 0}, {0, -1, 0}, 10);
        record.range = 8;
        const gpu::LightChange lamp = gpu::changeLight(*scene_, 2, record).value();
        gpu::FrameTargets targets = makeTargets(160, 120);
        const Image dark = draw(*scene_, targets, kOverview, {.light_method = method});
        Image lit = draw(*scene_, targets, kOverview, {.lights = {&lamp, 1}, .light_method = method});
        EXPECT_NE(lit.color, dark.color);
        return lit;
    };
    const Image expected = draw_first(gpu::LightMethod::all);
    for (size_t i = 0; i < gpu::kLightMethodCount; ++i)
    {
        const auto method = static_cast<gpu::LightMethod>(i);
        expectSame(draw_first(method), expected, method);
    }
}

/// A frame after one of another method finds its marks, words and counts.
TEST_F(LightMethodsTest, drawOneImageWhenTheMethodChangesFromFrameToFrame)
{
    addGround();
    addSuns();
    addLights(192, 5);
    load();
    gpu::FrameTargets targets = makeTargets(160, 120);
    DrawOptions options{.light_method = gpu::LightMethod::all};
    const Image expected = draw(*scene_, targets, kOverview, options);
    for (int frame = 0; frame < 24; ++frame)
    {
        options.light_method = static_cast<gpu::LightMethod>(random_() % gpu::kLightMethodCount);
        expectSame(draw(*scene_, targets, kOverview, options), expected, options.light_method);
    }
}

TEST_F(LightMethodsTest, drawOneImageInAllCullingsAndInParts)
{
    addGround();
    addLights(192, 5);
    load();
    const Image expected = draw(*scene_, kOverview, {.light_method = gpu::LightMethod::all});
    for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
        for (const bool occlusion : {false, true})
            for (const bool last_frame : {false, true})
                for (const bool in_parts : {false, true})
                {
                    gpu::FrameTargets targets = makeTargets(160, 120);
                    const uint32_t flags = occlusion ? shared::kCullEverything
                                                     : shared::kCullEverything & ~shared::kCullOcclusion;
                    const gpu::FrameInput input{
                        .view = makeView(*scene_, kOverview, {.flags = flags}),
                        .shading = {.light_method = static_cast<gpu::LightMethod>(method)},
                        .occludes_by_last_frame = last_frame};
                    const Status status = host().run(
                        [&](VkCommandBuffer commands)
                        {
                            if (in_parts)
                            {
                                renderer().recordCull(commands, *scene_, targets, input);
                                renderer().recordVisibility(commands, *scene_, targets, input);
                                renderer().recordMaterials(commands, *scene_, targets, input);
                            }
                            else
                                renderer().record(commands, *scene_, targets, input);
                            return success();
                        });
                    ASSERT_TRUE(status.ok());
                    SCOPED_TRACE(testing::Message() << occlusion << last_frame << in_parts);
                    expectSame(readImage(*scene_, targets), expected, static_cast<gpu::LightMethod>(method));
                }
}

/// One image of sums has the colour of diffuse light for all light.
TEST_F(LightMethodsTest, prepassesWithOneImageOfSumsDifferByTheColourOfHighlights)
{
    const auto difference = [&](gpu::LightMethod method, float metallic, const Float3& lamp_color)
    {
        TestScene test;
        formats::MaterialRecord material = plainMaterial();
        material.metallic = metallic;
        material.roughness = 0.6f;
        test.addInstance(test.addMesh(withMaterial(makeQuad(24, 24), test.addMaterial(material))), lying({}));
        for (const float x : {-2.0f, 2.0f})
        {
            LightRecord lamp = light(LightType::point, {x, 2, 0}, {0, -1, 0}, 30);
            lamp.range = 20;
            if (x > 0)
                lamp.color = lamp_color;
            test.addLight(lamp);
        }
        const formats::PackView pack = test.build();
        const auto scene = upload(pack);
        prepareAll(*scene);
        const Image exact = draw(*scene, kOverview, {.light_method = gpu::LightMethod::prepass});
        return meanDifference(draw(*scene, kOverview, {.light_method = method}), exact);
    };
    for (const gpu::LightMethod method :
         {gpu::LightMethod::classic_prepass, gpu::LightMethod::encoded_prepass})
    {
        const double plain = difference(method, 0, {1, 1, 1});
        EXPECT_LT(plain, 1) << "all light has one colour, and little of it is specular";
        EXPECT_GT(difference(method, 1, {1, 0.1f, 0}), 4 * plain);
    }
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
        const std::vector<uint32_t> on_gpu = readLightWords(*scene_);
        EXPECT_EQ(draw(*scene_, targets, kOverview, {.light_lister = gpu::LightLister::cpu}).color,
                  image.color);
        EXPECT_EQ(readLightWords(*scene_), on_gpu);
        for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
        {
            const auto drawn = static_cast<gpu::LightMethod>(method);
            expectSame(draw(*scene_, targets, kOverview, {.light_method = drawn}), image, drawn);
        }
        // as a scene that has had these lights all along: exposure is that of the scene as loaded
        std::vector<gpu::LightChange> all;
        const auto fresh = upload(*pack_, {.max_lights = 300});
        for (uint32_t slot = 0; slot < 300; ++slot)
            all.push_back(gpu::changeLight(*fresh, slot, now[slot]).value());
        EXPECT_EQ(draw(*fresh, kOverview, {.lights = all}).color, image.color) << frame;
    }
}

} // namespace hearth::test
