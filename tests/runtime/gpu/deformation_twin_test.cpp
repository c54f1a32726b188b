// Tests the passes' decisions for deformed meshes against their C++ twins, every bit; and that streaming
// gives the same image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/statistics/cull_statistics_pass.h"
#include "tests/runtime/gpu/cull_twin.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/gpu_fixture.h"

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

/// Poses of all deformed instances; every second one is a free pose if `free` is set.
std::vector<TestPose> makePoses(const DeformedScene& test, bool free, std::mt19937& random)
{
    std::vector<TestPose> poses;
    for (const uint32_t instance : test.deformedInstances())
        poses.push_back(free && random() % 2 == 0 ? test.freePose(instance, random)
                                                  : test.randomPose(instance, random));
    return poses;
}

class DeformationTwinTest : public GpuTest
{
protected:
    Pyramid readPyramid(const gpu::FrameTargets& targets)
    {
        const auto [width, height] = targets.extent();
        const uint32_t count = pyramidOffset(width, height, pyramidLevels(width, height) + 1);
        return {targets.pyramidView(), read<float>(targets.pyramid(), count)};
    }

    CullStatistics count(const gpu::Scene& scene)
    {
        const gpu::Device& device = renderer().device();
        auto pass = gpu::CullStatisticsPass::create(device, scene);
        HEARTH_ASSERT(pass.ok());
        const Status status = host().run(
            [&](VkCommandBuffer commands)
            {
                pass->record(device, commands, scene);
                return success();
            });
        HEARTH_ASSERT(status.ok());
        return read<CullStatistics>(pass->statistics(), 1)[0];
    }

    void expectTwin(const gpu::Scene& scene, const Twin& twin, const Image& image)
    {
        EXPECT_TRUE(sameBits(read<InstanceState>(scene.buffers.states, twin.states.size()), twin.states));
        EXPECT_TRUE(sameBits(read<WorkResult>(scene.buffers.results, twin.results.size()), twin.results));
        EXPECT_TRUE(
            sameBits(read<BinDraw>(scene.frame().main.bin_draws, twin.bin_draws.size()), twin.bin_draws));
        EXPECT_TRUE(sameBits(image.list.slots, twin.visible));
        EXPECT_EQ(image.list.counters.early_clusters, twin.early_clusters);
        EXPECT_TRUE(sameBits(std::vector{count(scene)}, std::vector{twin.statistics}));
    }
};

} // namespace

TEST_F(DeformationTwinTest, cullingEqualsItsTwinBitForBit)
{
    std::mt19937 random(61);
    const DeformedScene test({.limbs = 8, .tentacles = 3, .blobs = 3, .rocks = 6}, 11);
    auto layout = gpu::makeSceneLayout(test.pack());
    ASSERT_TRUE(layout.ok());
    const auto scene = upload(test.pack());
    gpu::FrameTargets targets = makeTargets(96, 72);
    std::array<size_t, kOutcomeCount> outcomes{};
    size_t late = 0;
    Camera camera;
    for (int frame = 0; frame < 48; ++frame)
    {
        if (frame % 4 == 0)
            camera = randomCamera(random, 4);
        const auto poses = makePoses(test, frame % 3 == 0, random);
        const auto views = makeViews(poses);
        const DrawOptions options{
            .width = 96,
            .height = 72,
            .error_pixels = frame % 6 == 0 ? 0.0f : std::exp2(uniform(random, -2.0f, 5.0f)),
            .flags = static_cast<uint32_t>(frame % 5 == 4 ? random() & kCullEverything : kCullEverything),
            .poses = views};
        const Pyramid last = readPyramid(targets);
        const Image image = draw(*scene, targets, camera, options);
        applyPoses(views, *layout);
        const Twin twin =
            makeTwin(test.pack(), *layout, makeView(*scene, camera, options), last, readPyramid(targets));
        expectTwin(*scene, twin, image);
        for (uint32_t outcome = 0; outcome < kOutcomeCount; ++outcome)
            outcomes[outcome] += twin.statistics.clusters[outcome];
        late += twin.visible.size() - twin.early_clusters;
    }
    EXPECT_GT(late, 50u);
    for (const size_t clusters : outcomes)
        EXPECT_GT(clusters, 50u) << "a test that culls nothing is not tested";
}

TEST_F(DeformationTwinTest, aStreamedSceneAsksAsItsTwinAndEndsAsTheWholeImage)
{
    std::mt19937 random(62);
    const DeformedScene test({.limbs = 3, .tentacles = 1, .blobs = 1, .rocks = 2, .rings = 160}, 12);
    auto layout = gpu::makeSceneLayout(test.pack());
    ASSERT_TRUE(layout.ok());
    const auto whole = upload(test.pack());
    const pack::PageReader reader = [&](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
    { done(test.pack().decodePage(page, destination).ok()); };
    uint64_t bytes = 0;
    for (const formats::PageRecord& page : test.pack().pages())
        bytes += 2 * page.size;
    const auto streamed =
        upload(test.pack(), {.frames_in_flight = 1, .memory_budget = bytes, .stream = {.read = reader}});
    uint64_t serial = 0;
    size_t requested = 0;
    for (int view = 0; view < 6; ++view)
    {
        const auto poses = makePoses(test, view % 3 == 2, random);
        const auto views = makeViews(poses);
        applyPoses(views, *layout);
        const Camera camera = randomCamera(random, 3);
        const DrawOptions options{.error_pixels = 0.5f, .poses = views};
        const uint64_t first = serial + 1;
        Image image;
        for (int frame = 0; frame < 60 && streamed->stream->settledSerial() < first; ++frame)
        {
            streamed->stream->beginFrame(serial + 1, serial);
            ++serial;
            image = draw(*streamed, camera, options);
        }
        const auto requests = read<uint32_t>(streamed->frame().page_requests,
                                             test.pack().pages().size() + test.pack().materials().size() + 1);
        EXPECT_EQ(requests, makeRequestTwin(test.pack(), *layout, makeView(*streamed, camera, options)));
        for (const uint32_t request : requests)
            requested += request != 0 ? 1u : 0u;
        EXPECT_EQ(image.color, draw(*whole, camera, options).color) << "view " << view;
    }
    EXPECT_GT(requested, 10u);
}

} // namespace hearth::test
