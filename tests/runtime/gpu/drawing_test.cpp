// Tests drawn images: culling changes nothing, for any size, transforms and number of threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/pyramid_start.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <thread>

namespace hearth::test
{

namespace
{

using namespace shared;

/// Fill with overlapping rocks, sheared and mirrored, one of them two-sided.
void fillRocks(TestScene& scene, int count, uint32_t seed)
{
    std::mt19937 random(seed);
    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = formats::kMaterialDoubleSided;
    const uint32_t meshes[] = {
        scene.addMesh(withMaterial(shapes::rock(24, 0.3f), scene.addMaterial(plainMaterial()))),
        scene.addMesh(withMaterial(shapes::terrain(32), scene.addMaterial(two_sided)))};
    scene.addInstance(meshes[0], Affine3{});
    for (int i = 1; i < count; ++i)
        scene.addInstance(meshes[i % 4 == 3 ? 1 : 0], randomAffine(random, 4));
}

Camera lookingAtOrigin(Float3 position)
{
    return {.position = position, .target = {0, 0, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f};
}

/// New random places for some of the instances, half of them mirrored.
std::vector<gpu::InstanceMove> randomMoves(const gpu::Scene& scene, const formats::PackView& pack,
                                           std::mt19937& random)
{
    std::vector<gpu::InstanceMove> moves;
    for (uint32_t i = 0; i < pack.instances().size(); ++i)
    {
        if (random() % 4 != 0)
            continue;
        Affine3 place = randomAffine(random, 4);
        if (random() % 2 == 0)
            for (auto& row : place.m)
                row[0] = -row[0];
        const auto move = gpu::moveInstance(scene, i, place);
        HEARTH_ASSERT(move.ok());
        moves.push_back(*move);
    }
    return moves;
}

class DrawingTest : public GpuTest
{
protected:
    /// Fill the pyramid with noise, and mark it as seen from a random viewpoint.
    void writeNoise(gpu::FrameTargets& targets, std::mt19937& random)
    {
        const auto [width, height] = targets.extent();
        const OcclusionView view =
            makeOcclusionView(makeFrameView(randomCamera(random, 6), width, height, 1, 0));
        ASSERT_TRUE(
            viewer::writeNoise(host(), renderer().device(), targets, view, static_cast<uint32_t>(random()))
                .ok());
    }
};

} // namespace

TEST_F(DrawingTest, cullingIsLossless)
{
    TestScene test;
    fillRocks(test, 16, 21);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    uint64_t culled = 0;
    for (const Float3 eye : {Float3{9, 5, 7}, {0.3f, 0.2f, 0.1f}, {-4, 1, 0}, {0, 12, 0.001f}, {2, -3, 40}})
    {
        DrawOptions options{.width = 333, .height = 177, .error_pixels = 0, .flags = 0};
        const Image all = draw(*scene, lookingAtOrigin(eye), options);
        for (const uint32_t flags :
             {kCullInstances, kCullFrustum, kCullCone, kCullOcclusion, kCullEverything})
        {
            options.flags = flags;
            const Image some = draw(*scene, lookingAtOrigin(eye), options);
            EXPECT_EQ(some.seen(), all.seen()) << "eye " << eye.x << " flags " << flags;
            EXPECT_EQ(some.color, all.color);
            culled += all.list.slots.size() - some.list.slots.size();
        }
    }
    EXPECT_GT(culled, 1000u) << "a culling that culls nothing is not tested";
}

TEST_F(DrawingTest, cullingOffCentreIsLossless)
{
    TestScene test;
    fillRocks(test, 16, 21);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    Camera parallel = lookingAtOrigin({9, 5, 7});
    parallel.half_height = 2;
    parallel.z_far = 30;
    for (const auto& [lens, shift] : {std::pair{lookingAtOrigin({9, 5, 7}), Float2{0.3f, -0.2f}},
                                      {lookingAtOrigin({9, 5, 7}), {-3, 2}},
                                      {lookingAtOrigin({9, 5, 7}), {0, 7}},
                                      {parallel, {0.3f, -0.2f}},
                                      {parallel, {-2, 1.5f}}})
    {
        Camera camera = lens;
        camera.shift = shift;
        DrawOptions options{.width = 333, .height = 177, .error_pixels = 0, .flags = 0};
        const Image all = draw(*scene, camera, options);
        options.flags = kCullEverything;
        for (int frame = 0; frame < 2; ++frame) // the second by the depth of the first
        {
            const Image some = draw(*scene, camera, options);
            EXPECT_EQ(some.seen(), all.seen());
            EXPECT_EQ(some.color, all.color);
        }
    }
}

TEST_F(DrawingTest, offCentrePartsMakeUpAnImage)
{
    TestScene test;
    fillRocks(test, 16, 21);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    constexpr uint32_t kSide = 96;
    const Camera camera = lookingAtOrigin({4, 2, 3});
    const Image whole = draw(*scene, camera, {.width = 2 * kSide, .height = 2 * kSide});
    size_t different = 0, shown = 0;
    for (const uint32_t column : {0u, 1u})
        for (const uint32_t row : {0u, 1u})
        {
            Camera part = camera;
            part.y_fov_rad = 2 * std::atan(std::tan(camera.y_fov_rad / 2) / 2);
            part.shift = {column == 0 ? 1.0f : -1.0f, row == 0 ? -1.0f : 1.0f};
            const Image image = draw(*scene, part, {.width = kSide, .height = kSide});
            for (uint32_t y = 0; y < kSide; ++y)
                for (uint32_t x = 0; x < kSide; ++x)
                {
                    const size_t in_whole = size_t{row * kSide + y} * 2 * kSide + column * kSide + x;
                    different += image.color[y * kSide + x] != whole.color[in_whole];
                    shown += image.visibility[y * kSide + x] != kVisibilitySky;
                }
        }
    EXPECT_GT(shown, kSide * kSide);
    EXPECT_LT(different, kSide * kSide * 4 / 200) << "edges, where rounding decides";
}

TEST_F(DrawingTest, cullingIsLosslessWhateverWasDrawnBefore)
{
    std::mt19937 random(77);
    TestScene test;
    fillRocks(test, 12, 5);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    size_t frames = 0, drawn = 0, all = 0, late = 0;
    const auto compare = [&](uint32_t width, uint32_t height, int count)
    {
        gpu::FrameTargets targets = makeTargets(width, height);
        gpu::FrameTargets other = makeTargets(width, height);
        Camera camera = randomCamera(random, 6);
        for (int i = 0; i < count; ++i, ++frames)
        {
            switch (i % 4)
            {
            case 0: // a camera cut
                camera = i % 8 == 4 ? randomOrthographicCamera(random, 6) : randomCamera(random, 6);
                break;
            case 1: // anything may have been there
                writeNoise(targets, random);
                break;
            case 2:
                camera.position += {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
                break;
            default: // the same view again: the clusters drawn before occlude the rest
                break;
            }
            std::vector<gpu::InstanceMove> moves;
            if (i % 3 == 0)
                moves = randomMoves(*scene, pack, random);
            DrawOptions options{
                .width = width, .height = height, .error_pixels = i % 5 == 0 ? 0.0f : 2.0f, .moves = moves};
            const Image some = draw(*scene, targets, camera, options);
            options.flags = 0;
            const Image whole = draw(*scene, other, camera, options);
            ASSERT_EQ(some.seen(), whole.seen()) << width << "x" << height << " frame " << i;
            ASSERT_EQ(some.color, whole.color);
            drawn += some.list.slots.size();
            late += some.list.slots.size() - some.list.counters.early_clusters;
            all += whole.list.slots.size();
        }
    };
    compare(64, 48, 350);
    compare(1, 1, 40);
    compare(97, 131, 98);
    compare(333, 777, 10);
    compare(1920, 1080, 2);
    EXPECT_EQ(frames, 500u);
    EXPECT_LT(drawn * 5, all * 3) << "a culling that culls nothing is not tested";
    EXPECT_GT(late, frames) << "a late phase that finds nothing is not tested";
}

TEST_F(DrawingTest, littleIsDrawnThatIsNotSeen)
{
    // a crowd that occludes most of itself
    std::mt19937 random(3);
    TestScene test;
    const uint32_t mesh =
        test.addMesh(withMaterial(shapes::rock(48, 0.2f), test.addMaterial(plainMaterial())));
    for (int x = -4; x <= 4; ++x)
        for (int z = 0; z < 14; ++z)
            test.addInstance(mesh, translated({static_cast<float>(x) * 1.7f + uniform(random, -0.2f, 0.2f),
                                               uniform(random, -0.2f, 0.2f), static_cast<float>(z) * -2.5f}));
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    gpu::FrameTargets targets = makeTargets(640, 360);
    const Camera camera{.position = {0, 0.5f, 7}, .target = {0, 0, 0}, .z_near = 0.05f};
    // Clusters are small relative to the rocks. At one pixel of error they are large, and 1.73 times as many
    // are drawn as are visible.
    const DrawOptions options{.width = 640, .height = 360, .error_pixels = 0.25f};
    draw(*scene, targets, camera, options);
    const Image image = draw(*scene, targets, camera, options);
    std::set<std::pair<uint32_t, uint32_t>> owners;
    for (const auto& [instance, cluster, triangle] : image.seen())
        if (instance != kVisibilitySky)
            owners.emplace(instance, cluster);
    EXPECT_GT(owners.size(), 200u);
    EXPECT_LE(static_cast<double>(image.list.slots.size()), 1.6 * static_cast<double>(owners.size()));
}

TEST_F(DrawingTest, coneCullingRemovesTheFarSideOfARock)
{
    TestScene test;
    const uint32_t mesh =
        test.addMesh(withMaterial(shapes::rock(32, 0.0f), test.addMaterial(plainMaterial())));
    test.addInstance(mesh, Affine3{});
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    DrawOptions options{.error_pixels = 0, .flags = 0};
    const size_t all = draw(*scene, lookingAtOrigin({0, 0, 5}), options).list.slots.size();
    options.flags = kCullCone;
    const size_t facing = draw(*scene, lookingAtOrigin({0, 0, 5}), options).list.slots.size();
    EXPECT_LT(facing, all * 7 / 10);
    EXPECT_GE(facing, all * 4 / 10);
    Camera parallel = lookingAtOrigin({0, 0, 5});
    parallel.half_height = 1.5f;
    parallel.z_far = 10;
    const size_t facing_parallel = draw(*scene, parallel, options).list.slots.size();
    EXPECT_LT(facing_parallel, all * 7 / 10);
    EXPECT_GE(facing_parallel, all * 4 / 10);
}

/// Parallel rays are the limit of those of a lens that goes away and narrows.
TEST_F(DrawingTest, orthographicImagesAreThoseOfAFarLens)
{
    TestScene test;
    fillRocks(test, 16, 21);
    test.addLight(sun({0.3f, -1, -0.4f}));
    const formats::PackView pack = test.build();
    const auto scene = upload(pack, {.shadows = {.max_maps = 2, .texels = 2048, .splits = 1}});
    const gpu::ShadowSphere sphere{.center = {}, .radius = 8};
    DrawOptions options{.width = 160, .height = 120, .shadow_spheres = {&sphere, 1}};
    for (const Float2 shift : {Float2{}, Float2{0.25f, -0.5f}})
        for (const float error_pixels : {0.0f, 2.0f})
        {
            Camera parallel = lookingAtOrigin({4, 5, 7});
            parallel.z_near = 1;
            parallel.half_height = 3;
            parallel.z_far = 30;
            parallel.shift = shift;
            options.error_pixels = error_pixels;
            const Image image = draw(*scene, parallel, options);
            // floats hold places 8 km away to a hundredth of a pixel
            std::vector<size_t> other, unlike; // pixels: of other triangles, of other colours
            for (const float back : {100.0f, 8000.0f})
            {
                Camera lens = parallel;
                lens.position = parallel.position * (1 + back / length(parallel.position));
                lens.half_height = 0;
                lens.z_near = back - 10;
                lens.y_fov_rad = 2 * std::atan(parallel.half_height / length(lens.position));
                const Image far = draw(*scene, lens, options);
                const auto seen = image.seen(), seen_far = far.seen();
                other.push_back(0);
                unlike.push_back(0);
                for (size_t i = 0; i < image.color.size(); ++i)
                {
                    other.back() += seen[i] != seen_far[i] ? 1 : 0;
                    int step = 0;
                    for (int c = 0; c < 3; ++c)
                        step =
                            std::max(step, std::abs(channel(image.color[i], c) - channel(far.color[i], c)));
                    unlike.back() += step > 4 ? 1 : 0;
                }
            }
            const size_t shown =
                image.color.size() - static_cast<size_t>(std::count(image.visibility.begin(),
                                                                    image.visibility.end(), kVisibilitySky));
            EXPECT_GT(shown, image.color.size() / 8);
            EXPECT_LT(other[1], shown * 4 / 100) << "8 km, shift " << shift.x << ", error " << error_pixels;
            EXPECT_LT(unlike[1], shown * 2 / 100);
            EXPECT_LT(4 * other[1], other[0]) << "100 m";
            EXPECT_LT(4 * unlike[1], unlike[0]);
        }
}

TEST_F(DrawingTest, everySizeIsDrawn)
{
    TestScene test;
    fillRocks(test, 5, 4);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    for (const auto& [width, height] : {std::pair{1u, 1u}, {2u, 1u}, {1u, 97u}, {333u, 777u}, {64u, 64u}})
    {
        const Image image = draw(*scene, lookingAtOrigin({6, 4, 6}), {.width = width, .height = height});
        EXPECT_EQ(image.color.size(), size_t{width} * height);
        EXPECT_NE(image.visibility[height / 2 * width + width / 2], kVisibilitySky);
    }
}

TEST_F(DrawingTest, framesRepeatExactly)
{
    TestScene test;
    fillRocks(test, 9, 8);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const Image first = draw(*scene, lookingAtOrigin({6, 4, 6}));
    draw(*scene, lookingAtOrigin({-2, 7, 1}), {.width = 64, .height = 64, .error_pixels = 30});
    const Image again = draw(*scene, lookingAtOrigin({6, 4, 6}));
    EXPECT_EQ(first.visibility, again.visibility);
    EXPECT_EQ(first.color, again.color);
}

TEST_F(DrawingTest, frontFacesAreCounterClockwiseAlsoWhenMirrored)
{
    TestScene test;
    const uint32_t mesh = test.addMesh(withMaterial(makeQuad(1, 1), test.addMaterial(plainMaterial())));
    Affine3 mirrored = translated({1, 0, 0});
    mirrored.m[0][0] = -1;
    test.addInstance(mesh, translated({-1, 0, 0}));
    test.addInstance(mesh, mirrored);
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const auto instancesSeen = [&](const Image& image)
    {
        uint32_t seen = 0;
        for (const auto& [instance, cluster, triangle] : image.seen())
            if (instance != kVisibilitySky)
                seen |= 1u << instance;
        return seen;
    };
    EXPECT_EQ(instancesSeen(draw(*scene, lookingAtOrigin({0, 0, 4}), {.flags = 0})), 3u);
    EXPECT_EQ(instancesSeen(draw(*scene, lookingAtOrigin({0, 0, -4}), {.flags = 0})), 0u);
}

TEST_F(DrawingTest, nearerSurfacesHideThoseBehindThem)
{
    TestScene test;
    const uint32_t mesh = test.addMesh(withMaterial(makeQuad(2, 2), test.addMaterial(plainMaterial())));
    test.addInstance(mesh, translated({0, 0, -1}));
    test.addInstance(mesh, translated({0, 0, 1}));
    test.addInstance(mesh, translated({0, 0, 0}));
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const Image image = draw(*scene, lookingAtOrigin({0, 0, 4}));
    EXPECT_EQ(image.seen()[60 * 160 + 80][0], 1u);
}

TEST_F(DrawingTest, blendedSurfacesCoverAsManyPixelsAsTheirAlphaSays)
{
    for (const float alpha : {0.0f, 0.25f, 0.5f, 1.0f})
    {
        TestScene test;
        formats::MaterialRecord glass = plainMaterial();
        glass.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::blend);
        glass.base_color.w = alpha;
        test.addInstance(test.addMesh(withMaterial(makeQuad(100, 100), test.addMaterial(glass))), Affine3{});
        const formats::PackView pack = test.build();
        const auto scene = upload(pack);
        const Image image = draw(*scene, lookingAtOrigin({0, 0, 4}), {.width = 64, .height = 64});
        const auto covered =
            4096 - std::count(image.visibility.begin(), image.visibility.end(), kVisibilitySky);
        EXPECT_EQ(covered, static_cast<long>(4096 * alpha));
    }
}

TEST_F(DrawingTest, maskedSurfacesHaveTheHolesOfTheirTexture)
{
    TestScene test;
    formats::MaterialRecord leaf = plainMaterial();
    leaf.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
    // left half opaque, right half a hole
    leaf.base_color_texture =
        makeTextureRef(test.addImage(formats::TexelFormat::rgba8_srgb, 2, 1, {0xFFFFFFFF, 0x00FFFFFF}));
    leaf.base_color_texture.nearest = 1;
    test.addInstance(test.addMesh(withMaterial(makeQuad(2, 2), test.addMaterial(leaf))), Affine3{});
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const Image image = draw(*scene, lookingAtOrigin({0, 0, 4}));
    EXPECT_NE(image.visibility[60 * 160 + 70], kVisibilitySky);
    EXPECT_EQ(image.visibility[60 * 160 + 90], kVisibilitySky);
}

TEST_F(DrawingTest, geometryInEverySliceOfThePoolIsDrawn)
{
    // One triangle per page, in pages of 64 KiB that hold nothing else: 2100 of them are more than one slice.
    constexpr uint32_t kPages = 2100;
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(makeQuad(1, 1), test.addMaterial(plainMaterial()))),
                     Affine3{});
    const formats::PackView small = test.build();
    const auto page = small.decodePage(0);
    ASSERT_TRUE(page.ok());

    PackModel model = test.model();
    const formats::PageRecord page_record = model.pages[0];
    const formats::ClusterRecord cluster = model.clusters[0];
    model.pages.clear();
    model.clusters.clear();
    model.decoded_pages.clear();
    for (uint32_t i = 0; i < kPages; ++i)
    {
        std::vector<std::byte> bytes = *page;
        bytes.resize(formats::kMaxPageBytes);
        model.decoded_pages.push_back(std::move(bytes));
        model.pages.push_back(page_record);
        model.pages.back().clusters = {i, 1};
        model.clusters.push_back(cluster);
        model.clusters.back().page = i;
        // a row of quads to the right, one behind the other
        model.clusters.back().base[0] +=
            static_cast<int32_t>(static_cast<float>(i) / model.meshes[0].grid_step);
        model.clusters.back().cone_cutoff = formats::kNoCone;
    }
    model.meshes[0].clusters.count = kPages;
    model.meshes[0].pages.count = kPages;
    model.sealPages();
    const AlignedBytes bytes = model.bytes();
    auto reader = formats::ContainerReader::fromBytes(bytes.span(), "test", formats::Check::structure);
    ASSERT_TRUE(reader.ok());
    const auto pack = formats::PackView::read(std::move(*reader));
    ASSERT_TRUE(pack.ok());

    const auto scene = upload(*pack);
    EXPECT_EQ(scene->used_slices, kPoolSlices);
    for (const uint32_t quad : {0u, 2047u, 2048u, kPages - 1})
    {
        const auto x = static_cast<float>(quad);
        const Camera camera{.position = {x, 0, 3}, .target = {x, 0, 0}};
        const Image image = draw(*scene, camera, {.width = 32, .height = 32});
        EXPECT_EQ(image.seen()[16 * 32 + 16][1], quad);
        EXPECT_GT(channel(image.at(16, 16), 0), 100) << "the quad faces the light";
    }
}

TEST_F(DrawingTest, theNumberOfThreadsChangesNothing)
{
    TestScene test;
    fillRocks(test, 9, 8);
    const formats::PackView pack = test.build();
    std::vector<Image> images;
    for (const char* threads : {"0", "1", "2", "4"})
    {
        // read by lavapipe when a device is created; other drivers just draw the same four times
        ::setenv("LP_NUM_THREADS", threads, 1);
        TearDownTestSuite();
        SetUpTestSuite();
        const auto scene = upload(pack);
        images.push_back(draw(*scene, lookingAtOrigin({6, 4, 6})));
        EXPECT_EQ(images.back().visibility, images.front().visibility) << threads;
        EXPECT_EQ(images.back().color, images.front().color) << threads;
    }
    ::unsetenv("LP_NUM_THREADS");
}

namespace
{

/// Draw a few frames with an instance, a device and a renderer of its own, and append their colours.
void drawAlone(const formats::PackView& pack, std::vector<std::vector<std::byte>>& images)
{
    auto host = viewer::VulkanHost::create({.device_name = "", .validate = true});
    ASSERT_TRUE(host.ok()) << formatMessage(host.error());
    auto renderer = gpu::Renderer::create((*host)->description());
    ASSERT_TRUE(renderer.ok()) << formatMessage(renderer.error());
    std::unique_ptr<gpu::Scene> scene;
    const Status uploaded = (*host)->run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene, (*renderer)->upload(pack, commands));
            return success();
        });
    ASSERT_TRUE(uploaded.ok()) << formatMessage(uploaded.error());
    auto targets = (*renderer)->createTargets({96, 72}, {.keeps_visibility = true});
    ASSERT_TRUE(targets.ok());
    for (const Float3 eye : {Float3{6, 4, 6}, {-2, 7, 1}, {9, 1, -3}})
    {
        const FrameView view = makeFrameView(lookingAtOrigin(eye), 96, 72, 1, scene->instance_count);
        const Status drawn = (*host)->run(
            [&](VkCommandBuffer commands)
            {
                (*renderer)->record(commands, *scene, *targets, {.view = view});
                return success();
            });
        ASSERT_TRUE(drawn.ok()) << formatMessage(drawn.error());
        auto color = (*host)->read((*renderer)->device(), targets->color(), 4);
        ASSERT_TRUE(color.ok());
        images.push_back(std::move(*color));
    }
    EXPECT_EQ((*host)->messages(), std::vector<std::string>{});
}

} // namespace

TEST_F(DrawingTest, renderersOfOneProcessKnowNothingOfEachOther)
{
    TestScene test, other_test;
    fillRocks(test, 9, 8);
    fillRocks(other_test, 7, 3);
    const formats::PackView packs[] = {test.build(), other_test.build()};
    std::vector<std::vector<std::byte>> alone[2], together[2];
    for (size_t i = 0; i < 2; ++i)
        drawAlone(packs[i], alone[i]);
    std::thread other([&] { drawAlone(packs[1], together[1]); });
    drawAlone(packs[0], together[0]);
    other.join();
    for (size_t i = 0; i < 2; ++i)
    {
        ASSERT_EQ(alone[i].size(), 3u);
        EXPECT_EQ(together[i], alone[i]);
    }
    EXPECT_NE(alone[0], alone[1]);
}

TEST_F(DrawingTest, aMistakeIsReportedByTheValidationLayer)
{
    // Checks the test setup: tests that expect silence are meaningful only if errors are reported.
    const gpu::Device& device = renderer().device();
    gpu::MemoryArena arena(device);
    auto buffer = arena.createBuffer(64, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::device);
    ASSERT_TRUE(buffer.ok());
    const Status status = host().run(
        [&](VkCommandBuffer commands)
        {
            // Two writes to the same bytes without a barrier: a hazard that only synchronization validation
            // reports.
            device.vk.vkCmdFillBuffer(commands, buffer->handle.get(), 0, VK_WHOLE_SIZE, 1);
            device.vk.vkCmdFillBuffer(commands, buffer->handle.get(), 0, VK_WHOLE_SIZE, 2);
            return success();
        });
    ASSERT_TRUE(status.ok());
    ASSERT_EQ(host().messages().size(), 1u);
    EXPECT_NE(host().messages()[0].find("SYNC-HAZARD-WRITE-AFTER-WRITE"), std::string::npos);
    host().clearMessages();
}

} // namespace hearth::test
