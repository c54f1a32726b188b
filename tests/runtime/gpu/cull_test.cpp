// Tests the culling passes against their C++ twin: every bit of every buffer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/statistics/cull_statistics_pass.h"
#include "tests/runtime/gpu/cull_twin.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>

namespace hearth::test
{

namespace
{

using namespace shared;

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Fill with rocks, terrain and foliage with every kind of bin, at random places with sheared and mirrored
/// transforms.
void fillScene(TestScene& scene, std::mt19937& random, int instances, float reach)
{
    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = formats::kMaterialDoubleSided;
    formats::MaterialRecord masked = plainMaterial();
    masked.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
    const uint32_t plain = scene.addMaterial(plainMaterial());
    const uint32_t sheet = scene.addMaterial(two_sided);
    const uint32_t holes = scene.addMaterial(masked);

    mesh::SourceMesh mixed = withMaterial(shapes::rock(12, 0.3f, 5), plain);
    for (size_t t = 0; t < mixed.triangle_materials.size(); t += 3)
        mixed.triangle_materials[t] = t % 2 == 0 ? holes : sheet;
    const uint32_t meshes[] = {scene.addMesh(withMaterial(shapes::rock(16, 0.2f), plain)),
                               scene.addMesh(withMaterial(shapes::terrain(24), sheet)),
                               scene.addMesh(withMaterial(shapes::foliage(300), holes)),
                               scene.addMesh(mixed)};
    for (int i = 0; i < instances; ++i)
        scene.addInstance(meshes[random() % 4], randomAffine(random, reach));
}

class CullTest : public GpuTest
{
protected:
    void expectTwin(const formats::PackView& pack, const gpu::Scene& scene, const gpu::SceneLayout& layout,
                    const shared::Camera& camera, const DrawOptions& options)
    {
        gpu::FrameTargets targets = makeTargets(options.width, options.height);
        expectTwin(pack, scene, layout, targets, camera, options);
    }

    /// Compare a frame with the twin. Targets that have drawn before bring their pyramid along.
    void expectTwin(const formats::PackView& pack, const gpu::Scene& scene, const gpu::SceneLayout& layout,
                    gpu::FrameTargets& targets, const shared::Camera& camera, const DrawOptions& options)
    {
        const Pyramid last = readPyramid(targets);
        const Image image = draw(scene, targets, camera, options);
        const FrameView view = makeView(scene, camera, options);
        const Twin twin = makeTwin(pack, layout, view, last, readPyramid(targets));
        EXPECT_TRUE(sameBits(read<InstanceState>(scene.buffers.states, twin.states.size()), twin.states));
        EXPECT_TRUE(sameBits(read<WorkResult>(scene.buffers.results, twin.results.size()), twin.results));
        EXPECT_TRUE(sameBits(read<uint32_t>(scene.buffers.totals, twin.totals.size()), twin.totals));
        EXPECT_TRUE(
            sameBits(read<BinDraw>(scene.frame().main.bin_draws, twin.bin_draws.size()), twin.bin_draws));
        EXPECT_TRUE(sameBits(read<uint32_t>(scene.frame().main.material_draws, twin.material_draws.size()),
                             twin.material_draws));
        EXPECT_TRUE(sameBits(image.list.slots, twin.visible));
        EXPECT_EQ(image.list.counters.early_clusters, twin.early_clusters);
        expectStatistics(scene, twin, layout.instanced_clusters);
        drawn_ += twin.visible.size();
        late_ += twin.visible.size() - twin.early_clusters;
    }

    void expectStatistics(const gpu::Scene& scene, const Twin& twin, uint64_t instanced_clusters)
    {
        const gpu::Device& device = renderer().device();
        auto pass = gpu::CullStatisticsPass::create(device, scene);
        ASSERT_TRUE(pass.ok());
        ASSERT_TRUE(host()
                        .run(
                            [&](VkCommandBuffer commands)
                            {
                                pass->record(device, commands, scene);
                                return success();
                            })
                        .ok());
        const auto counted = read<CullStatistics>(pass->statistics(), 1);
        EXPECT_TRUE(sameBits(counted, {twin.statistics}));
        for (uint32_t outcome = 0; outcome < kOutcomeCount; ++outcome)
            outcomes_[outcome] += counted[0].clusters[outcome];
        const viewer::CullReport report = viewer::makeCullReport(
            counted[0], {static_cast<uint32_t>(twin.visible.size()), 0, twin.early_clusters, 0}, 0, 0);
        EXPECT_EQ(report.instances.tested, scene.instance_count);
        const viewer::CullCounts& clusters = report.clusters;
        EXPECT_EQ(clusters.tested, instanced_clusters);
        EXPECT_EQ(clusters.tested, clusters.instance + clusters.lod + clusters.frustum + clusters.cone +
                                       clusters.occlusion + clusters.drawn);
    }

    Pyramid readPyramid(const gpu::FrameTargets& targets)
    {
        const auto [width, height] = targets.extent();
        const uint32_t count = pyramidOffset(width, height, pyramidLevels(width, height) + 1);
        return {targets.pyramidView(), read<float>(targets.pyramid(), count)};
    }

    size_t late_ = 0;
    size_t drawn_ = 0;
    std::array<size_t, kOutcomeCount> outcomes_{};
};

} // namespace

TEST_F(CullTest, equalsItsTwinBitForBitOnRandomScenes)
{
    std::mt19937 random(7);
    for (const float reach : {4.0f, 60.0f})
    {
        TestScene test;
        fillScene(test, random, 70, reach);
        const formats::PackView pack = test.build();
        const auto layout = gpu::makeSceneLayout(pack);
        ASSERT_TRUE(layout.ok());
        const auto scene = upload(pack);
        for (int view = 0; view < 24; ++view)
        {
            const float error = view % 6 == 0 ? 0.0f : std::exp2(uniform(random, -2.0f, 6.0f));
            const auto flags =
                static_cast<uint32_t>(view % 3 == 0 ? random() & kCullEverything : kCullEverything);
            std::vector<LodKnot> curve;
            if (view % 4 == 1)
                curve = {{0.5f, 0.7f}, {reach, 1.3f}, {2 * reach, 0.2f}};
            expectTwin(
                pack, *scene, *layout,
                view % 4 == 3 ? randomOrthographicCamera(random, reach) : randomCamera(random, reach),
                {.width = 64, .height = 48, .error_pixels = error, .flags = flags, .lod_curve = curve});
        }
    }
    EXPECT_GT(drawn_, 1000u);
}

TEST_F(CullTest, equalsItsTwinWhateverTheFrameBeforeLeft)
{
    std::mt19937 random(19);
    TestScene test;
    fillScene(test, random, 90, 5);
    const formats::PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    const auto scene = upload(pack);
    for (const auto& [width, height] : {std::pair{64u, 48u}, {1u, 1u}, {333u, 77u}})
    {
        gpu::FrameTargets targets = makeTargets(width, height);
        Camera camera = randomCamera(random, 5);
        for (int frame = 0; frame < 12; ++frame)
        {
            // in some frames the camera moves a little, in some it jumps
            if (frame % 3 == 0)
                camera = frame == 6 ? randomOrthographicCamera(random, 5) : randomCamera(random, 5);
            camera.position.x += 0.2f;
            const auto flags = static_cast<uint32_t>(
                frame % 4 == 3 ? kCullOcclusion | (random() & kCullEverything) : kCullEverything);
            expectTwin(pack, *scene, *layout, targets, camera,
                       {.width = width, .height = height, .error_pixels = 2, .flags = flags});
        }
    }
    EXPECT_GT(drawn_, 1000u);
    EXPECT_GT(late_, 100u) << "a late phase that finds nothing is not tested";
    for (const size_t clusters : outcomes_)
        EXPECT_GT(clusters, 100u) << "a test that culls nothing is not counted";
}

TEST_F(CullTest, thePyramidHoldsTheFarthestDepthOfEveryTexel)
{
    // quads that face the camera: the whole surface has one depth
    std::mt19937 random(23);
    TestScene test;
    const uint32_t mesh = test.addMesh(withMaterial(makeQuad(1, 1), test.addMaterial(plainMaterial())));
    std::vector<float> distances;
    Camera camera;
    camera.position = {0, 0, 16};
    for (int i = 0; i < 60; ++i)
    {
        const Float3 place{uniform(random, -6, 6), uniform(random, -5, 5), static_cast<float>(i % 24) * 0.5f};
        test.addInstance(mesh, translated(place));
        distances.push_back(camera.position.z - place.z);
    }
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {2u, 1u}, {1u, 97u}, {31u, 33u}, {333u, 777u}, {640u, 360u}})
    {
        gpu::FrameTargets targets = makeTargets(width, height);
        const Image image = draw(*scene, targets, camera, {.width = width, .height = height});
        ASSERT_EQ(image.list.counters.early_clusters, image.list.counters.drawn_clusters)
            << "nothing hides in the first frame";
        std::vector<float> depth;
        for (const auto& [instance, cluster, triangle] : image.seen())
            depth.push_back(instance == kVisibilitySky ? 0.0f : camera.z_near / distances[instance]);
        const std::vector<float> expected = makePyramid(depth, width, height);
        const std::vector<float> texels = readPyramid(targets).texels;
        ASSERT_EQ(texels.size(), expected.size());
        for (size_t i = 0; i < texels.size(); ++i)
            ASSERT_NEAR(texels[i], expected[i], 1e-6f * expected[i])
                << width << "x" << height << " texel " << i;
    }
}

TEST_F(CullTest, equalsItsTwinWhereManyBlocksAreScanned)
{
    std::mt19937 random(11);
    TestScene test;
    const uint32_t material = test.addMaterial(plainMaterial());
    const uint32_t mesh = test.addMesh(withMaterial(makeQuad(1, 1), material));
    // one work item each: 300 blocks of the scan, more than one workgroup handles in one step
    for (int i = 0; i < 300 * 1024 + 5; ++i)
        test.addInstance(mesh, translated({uniform(random, -90, 90), uniform(random, -90, 90), 0}));
    const formats::PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    ASSERT_EQ(layout->items.size(), 300u * 1024 + 5);
    const auto scene = upload(pack);
    shared::Camera camera;
    camera.position = {0, 0, 70};
    expectTwin(pack, *scene, *layout, camera, {.width = 64, .height = 48});
    EXPECT_GT(drawn_, 10000u);
    EXPECT_LT(drawn_, 300u * 1024);
}

TEST_F(CullTest, leavesOutTheLastClustersWhereTheListIsFull)
{
    std::mt19937 random(3);
    TestScene test;
    fillScene(test, random, 20, 3);
    const formats::PackView pack = test.build();
    shared::Camera camera;
    camera.position = {0, 0, 15};
    const auto whole = upload(pack);
    const Image all = draw(*whole, camera);
    const auto capacity = static_cast<uint32_t>(all.list.slots.size() / 2);
    ASSERT_GT(capacity, 10u);

    const auto small = upload(pack, {.max_visible_clusters = capacity});
    const Image half = draw(*small, camera);
    EXPECT_EQ(half.list.counters.drawn_clusters, all.list.counters.drawn_clusters);
    EXPECT_EQ(half.list.counters.dropped_clusters, all.list.slots.size() - capacity);
    ASSERT_EQ(half.list.slots.size(), capacity);
    EXPECT_EQ(std::memcmp(half.list.slots.data(), all.list.slots.data(), capacity * sizeof(VisibleCluster)),
              0);
}

TEST_F(CullTest, drawsNothingOfAnEmptyScene)
{
    TestScene test;
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const Image image = draw(*scene, {});
    EXPECT_EQ(image.list.counters.drawn_clusters, 0u);
    for (const uint32_t id : image.visibility)
        ASSERT_EQ(id, kVisibilitySky);
    // the sky: brighter above than below
    EXPECT_GT(channel(image.at(80, 2), 2), channel(image.at(80, 117), 2));
}

} // namespace hearth::test
