// Tests that the ways through a frame draw the same image, and what a frame shows that culls against the last
// one's depth alone.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/debug_views.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>

namespace hearth::test
{

namespace
{

using gpu::FrameWay;
using gpu::MaterialTest;
using gpu::ShadedArea;

/// Rocks of many materials, some of them with holes.
void fillRocks(TestScene& test, uint32_t materials, uint32_t spare)
{
    std::mt19937 random(7);
    for (uint32_t i = 0; i < materials; ++i)
    {
        formats::MaterialRecord material = plainMaterial();
        material.base_color = {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1),
                               i % 4 == 3 ? 0.5f : 1.0f};
        if (i % 4 == 3)
            material.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::blend);
        const uint32_t mesh =
            test.addMesh(withMaterial(shapes::rock(8, 0.2f, i + 1), test.addMaterial(material)));
        test.addInstance(mesh, randomAffine(random, 3));
        // numbers beyond the stencil's bits
        for (uint32_t j = 0; j < spare; ++j)
            test.addMaterial(plainMaterial());
    }
}

class FrameWaysTest : public GpuTest
{
protected:
    static void TearDownTestSuite()
    {
        renderers_.clear();
        GpuTest::TearDownTestSuite();
    }

    /// Draw three frames by the renderer of the options, and return the last one: the third may be the first
    /// that culls against an earlier one.
    Image drawBy(const gpu::RendererOptions& options, const formats::PackView& pack, const DrawOptions& shown,
                 bool last_frame = false, bool in_parts = false)
    {
        gpu::Renderer& r = findRenderer(options);
        const std::unique_ptr<gpu::Scene> scene = uploadBy(r, pack);
        gpu::FrameTargets targets = makeTargetsBy(r, {shown.width, shown.height});
        for (int frame = 0; frame < 3; ++frame)
            run(
                [&](VkCommandBuffer commands)
                {
                    const gpu::FrameInput input{
                        .view = makeView(*scene, kCamera, shown),
                        .shading = {.debug_view = shown.debug_view, .area = shown.area},
                        .occludes_by_last_frame = last_frame};
                    if (!in_parts)
                        return r.record(commands, *scene, targets, input);
                    r.recordCull(commands, *scene, targets, input);
                    r.recordVisibility(commands, *scene, targets, input);
                    r.recordMaterials(commands, *scene, targets, input);
                });
        return readImage(*scene, targets);
    }

    std::unique_ptr<gpu::Scene> uploadBy(gpu::Renderer& r, const formats::PackView& pack)
    {
        std::unique_ptr<gpu::Scene> scene;
        run(
            [&](VkCommandBuffer commands)
            {
                auto uploaded = r.upload(pack, commands, {.shadows = {.max_maps = 4}});
                HEARTH_ASSERT(uploaded.ok());
                scene = std::move(*uploaded);
            });
        scene->staging.reset();
        return scene;
    }

    static gpu::FrameTargets makeTargetsBy(const gpu::Renderer& r, VkExtent2D extent,
                                           bool counts_missing = false)
    {
        auto targets = r.createTargets(extent, {.keeps_visibility = true, .counts_missing = counts_missing});
        HEARTH_ASSERT(targets.ok());
        return std::move(*targets);
    }

    void run(const std::function<void(VkCommandBuffer)>& record)
    {
        HEARTH_ASSERT(host()
                          .run(
                              [&](VkCommandBuffer commands)
                              {
                                  record(commands);
                                  return success();
                              })
                          .ok());
    }

    static gpu::Renderer& findRenderer(const gpu::RendererOptions& options)
    {
        auto& renderer = renderers_[{options.way, options.materials}];
        if (renderer == nullptr)
        {
            auto created = gpu::Renderer::create(host().description(), options);
            HEARTH_ASSERT(created.ok() && (*created)->prepareOverdraw().ok());
            renderer = std::move(*created);
        }
        return *renderer;
    }

    static constexpr shared::Camera kCamera{.position = {4, 2, 7}, .target = {}};

private:
    static std::map<std::pair<std::optional<FrameWay>, MaterialTest>, std::unique_ptr<gpu::Renderer>>
        renderers_;
};

std::map<std::pair<std::optional<FrameWay>, MaterialTest>, std::unique_ptr<gpu::Renderer>>
    FrameWaysTest::renderers_;

} // namespace

TEST_F(FrameWaysTest, everyWayDrawsTheSameImage)
{
    TestScene test;
    fillRocks(test, 12, 40);
    const formats::PackView pack = test.build();
    const Image expected = drawBy({.way = FrameWay::merged}, pack, {});
    EXPECT_GT(std::set<uint32_t>(expected.color.begin(), expected.color.end()).size(), 100u);
    constexpr uint32_t kNoOcclusion = shared::kCullEverything & ~shared::kCullOcclusion;
    for (const FrameWay way : {FrameWay::separate, FrameWay::one_set})
        for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
            for (const ShadedArea area : {ShadedArea::wholeFrame, ShadedArea::tiles})
            {
                const gpu::RendererOptions options{.way = way, .materials = materials};
                const Image images[] = {drawBy(options, pack, {.area = area}),
                                        drawBy(options, pack, {.flags = kNoOcclusion, .area = area}),
                                        drawBy(options, pack, {.area = area}, true),
                                        drawBy(options, pack, {.area = area}, false, true),
                                        drawBy(options, pack, {.area = area}, true, true)};
                for (const Image& image : images)
                    EXPECT_EQ(image.color, expected.color);
                EXPECT_EQ(images[0].visibility, expected.visibility);
                EXPECT_EQ(images[3].visibility, expected.visibility);
            }
}

TEST_F(FrameWaysTest, joinedSetsFollowTheTargets)
{
    TestScene test;
    fillRocks(test, 6, 0);
    const formats::PackView pack = test.build();
    gpu::Renderer& renderer = findRenderer({.way = FrameWay::one_set});
    const auto scene = uploadBy(renderer, pack);
    const auto draw = [&](gpu::FrameTargets& targets)
    {
        const auto [width, height] = targets.extent();
        const gpu::FrameInput input{.view = makeView(*scene, kCamera, {.width = width, .height = height})};
        run([&](VkCommandBuffer commands) { renderer.record(commands, *scene, targets, input); });
        auto color = host().read(renderer.device(), targets.color(), 4);
        HEARTH_ASSERT(color.ok());
        return std::move(*color);
    };
    std::optional<gpu::FrameTargets> targets[] = {makeTargetsBy(renderer, {160, 120}),
                                                  makeTargetsBy(renderer, {96, 128})};
    const auto first = draw(*targets[0]), second = draw(*targets[1]);
    EXPECT_NE(first.size(), second.size());
    // each of the two frames in flight sees both targets, in turn and twice in a row
    for (const size_t number : {0u, 0u, 1u, 1u, 0u, 1u, 1u, 0u, 0u, 0u})
        EXPECT_EQ(draw(*targets[number]), number == 0 ? first : second);
    // others may get the memory of targets that are gone
    targets[0].reset();
    targets[0].emplace(makeTargetsBy(renderer, {160, 120}));
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(draw(*targets[0]), first);
}

TEST_F(FrameWaysTest, materialsByIdAreMaterialsByDepth)
{
    for (const uint32_t spare : {0u, 40u})
    {
        TestScene test;
        fillRocks(test, 12, spare);
        const formats::PackView pack = test.build();
        for (const ShadedArea area : {ShadedArea::wholeFrame, ShadedArea::tiles})
        {
            const DrawOptions shown{.area = area};
            const Image depth = drawBy({.materials = MaterialTest::depth}, pack, shown);
            const Image id = drawBy({.materials = MaterialTest::id}, pack, shown);
            EXPECT_EQ(id.color, depth.color) << spare;
            EXPECT_EQ(id.visibility, depth.visibility);
        }
    }
}

TEST_F(FrameWaysTest, everyDebugViewIsTheSame)
{
    TestScene test;
    fillRocks(test, 6, 0);
    const formats::PackView pack = test.build();
    for (const shared::DebugView& view : shared::kDebugViews)
    {
        if (shared::viewNeedsBricks(view.number))
            continue;
        const DrawOptions shown{.debug_view = view.number};
        const Image expected = drawBy({.materials = MaterialTest::depth}, pack, shown);
        EXPECT_EQ(drawBy({.materials = MaterialTest::id}, pack, shown).color, expected.color) << view.name;
        for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
            for (const FrameWay way : {FrameWay::separate, FrameWay::one_set})
                EXPECT_EQ(drawBy({.way = way, .materials = materials}, pack, shown).color, expected.color)
                    << view.name;
    }
}

TEST_F(FrameWaysTest, atRestTheLastFramesDepthIsEnough)
{
    TestScene test;
    fillRocks(test, 12, 0);
    const formats::PackView pack = test.build();
    const Image whole = drawBy({}, pack, {});
    for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
    {
        const Image image = drawBy({.materials = materials}, pack, {}, true);
        EXPECT_EQ(image.color, whole.color);
        EXPECT_LT(image.list.counters.drawn_clusters,
                  drawBy({}, pack, {.flags = shared::kCullFrustum}).list.counters.drawn_clusters);
    }
}

TEST_F(FrameWaysTest, whatAnEarlierFramesDepthHidesIsCounted)
{
    TestScene test;
    fillRocks(test, 40, 0);
    const formats::PackView pack = test.build();
    for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
    {
        gpu::Renderer& r = findRenderer({.materials = materials});
        const auto scene = uploadBy(r, pack), uncounted = uploadBy(r, pack), whole = uploadBy(r, pack);
        gpu::FrameTargets targets = makeTargetsBy(r, {160, 120}, true);
        gpu::FrameTargets uncounted_targets = makeTargetsBy(r, {160, 120});
        gpu::FrameTargets whole_targets = makeTargetsBy(r, {160, 120});
        size_t wrong_pixels = 0, missing = 0;
        for (int frame = 0; frame < 12; ++frame)
        {
            const float angle = 0.12f * static_cast<float>(frame);
            const shared::Camera camera{.position = {6 * std::sin(angle), 1, 6 * std::cos(angle)},
                                        .target = {}};
            const auto record =
                [&](gpu::Scene& of, gpu::FrameTargets& into, bool by_earlier, const DrawOptions& shown = {})
            {
                const gpu::FrameInput input{.view = makeView(of, camera, shown),
                                            .occludes_by_last_frame = by_earlier};
                run([&](VkCommandBuffer commands) { r.record(commands, of, into, input); });
                return readImage(of, into);
            };
            const Image expected = record(*whole, whole_targets, false);
            const Image image = record(*scene, targets, true);
            EXPECT_EQ(record(*uncounted, uncounted_targets, true).color, image.color) << "counting is seen";
            run([&](VkCommandBuffer commands) { r.recordMissing(commands, *scene, targets); });
            auto list = viewer::readVisibleList(host(), r, *scene);
            ASSERT_TRUE(list.ok());
            std::set<std::pair<uint32_t, uint32_t>> left_out;
            for (size_t slot = list->counters.early_clusters; slot < list->slots.size(); ++slot)
                left_out.emplace(list->slots[slot].instance, list->slots[slot].cluster);
            missing += left_out.size();
            // every pixel that lacks something lacks a counted cluster
            const auto shown = image.seen(), should = expected.seen();
            for (size_t pixel = 0; pixel < shown.size(); ++pixel)
                if (shown[pixel] != should[pixel])
                {
                    ++wrong_pixels;
                    EXPECT_TRUE(left_out.contains({should[pixel][0], should[pixel][1]})) << frame;
                }
            if (left_out.empty())
            {
                EXPECT_EQ(image.color, expected.color);
            }
        }
        EXPECT_GT(missing, 10u);
        EXPECT_GT(wrong_pixels, 0u) << "a camera that moves finds something";
    }
}

TEST_F(FrameWaysTest, imagesOfAFrameAreSmall)
{
    // at 1280 x 720, where the device allocates nothing lazily
    auto targets = renderer().createTargets({1280, 720}, {});
    ASSERT_TRUE(targets.ok());
    const VkDeviceSize images = targets->visibility().bytes + targets->depth().bytes +
                                targets->color().bytes + targets->pyramid().size;
    EXPECT_LE(images, VkDeviceSize{16} << 20);
    EXPECT_LE(targets->allocatedBytes(), VkDeviceSize{20} << 20) << "with lists of tiles and gathered light";
}

TEST_F(FrameWaysTest, targetsForFewDemandsDrawTheSame)
{
    TestScene test;
    fillRocks(test, 3, 0);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const Image expected = draw(*scene, kCamera, {});
    for (const auto occlusion : {gpu::OcclusionCulling::off, gpu::OcclusionCulling::last_frame})
    {
        auto targets = renderer().createTargets(
            {160, 120},
            {.occlusion = occlusion, .keeps_visibility = false, .gathers_light = false, .may_split = false});
        ASSERT_TRUE(targets.ok());
        const bool off = occlusion == gpu::OcclusionCulling::off;
        gpu::FrameInput input{.view =
                                  makeView(*scene, kCamera,
                                           {.flags = off ? shared::kCullEverything & ~shared::kCullOcclusion
                                                         : shared::kCullEverything}),
                              .occludes_by_last_frame = !off};
        EXPECT_EQ(targets->allows({.occlusion = gpu::OcclusionCulling::two_phase}), false);
        // the depth of material numbers needs a second pass for the pyramid
        if (!targets->allows({.occlusion = occlusion}))
            continue;
        run([&](VkCommandBuffer commands) { renderer().record(commands, *scene, *targets, input); });
        auto color = host().read(renderer().device(), targets->color(), 4);
        ASSERT_TRUE(color.ok());
        EXPECT_EQ(std::memcmp(color->data(), expected.color.data(), color->size()), 0);
    }
}

TEST_F(FrameWaysTest, framesThatKeepTheDepthDrawTheSame)
{
    TestScene test;
    fillRocks(test, 3, 0);
    const formats::PackView pack = test.build();
    gpu::RendererOptions options = testRendererOptions();
    options.materials = gpu::MaterialTest::id;
    std::vector<std::vector<std::byte>> colors;
    for (const bool keeps_depth : {false, true})
    {
        options.keeps_depth = keeps_depth;
        replaceRenderer(options);
        const auto scene = upload(pack);
        for (const bool by_last_frame : {false, true})
        {
            auto targets = renderer().createTargets({160, 120}, {.may_split = false});
            ASSERT_TRUE(targets.ok());
            // each frame culls against the depth that the one before has left
            for (int frame = 0; frame < 3; ++frame)
                run(
                    [&](VkCommandBuffer commands)
                    {
                        renderer().record(
                            commands, *scene, *targets,
                            {.view = makeView(*scene, kCamera, {}), .occludes_by_last_frame = by_last_frame});
                    });
            auto color = host().read(renderer().device(), targets->color(), 4);
            ASSERT_TRUE(color.ok());
            colors.push_back(std::move(*color));
        }
    }
    EXPECT_EQ(colors[0], colors[2]);
    EXPECT_EQ(colors[1], colors[3]);
    replaceRenderer(testRendererOptions());
}

} // namespace hearth::test
