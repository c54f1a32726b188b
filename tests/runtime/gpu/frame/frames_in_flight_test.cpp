// Tests that frames which overlap show what frames one by one show, and that the geometry of a frame waits
// for no shading of the frame before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/runtime/gpu/frame/stage_spy.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <functional>
#include <random>

namespace hearth::test
{

namespace
{

constexpr uint32_t kWidth = 160, kHeight = 120;
constexpr VkDeviceSize kImageBytes = VkDeviceSize{kWidth} * kHeight * 4;

/// Device functions that submit frames without waiting for them.
struct SubmitTable
{
    PFN_vkCreateCommandPool vkCreateCommandPool;
    PFN_vkDestroyCommandPool vkDestroyCommandPool;
    PFN_vkAllocateCommandBuffers vkAllocateCommandBuffers;
    PFN_vkBeginCommandBuffer vkBeginCommandBuffer;
    PFN_vkEndCommandBuffer vkEndCommandBuffer;
    PFN_vkCreateFence vkCreateFence;
    PFN_vkDestroyFence vkDestroyFence;
    PFN_vkWaitForFences vkWaitForFences;
    PFN_vkQueueSubmit vkQueueSubmit;
    PFN_vkGetDeviceQueue vkGetDeviceQueue;
    PFN_vkCmdCopyImageToBuffer vkCmdCopyImageToBuffer;

    explicit SubmitTable(const gpu::Device& device)
    {
        const auto load = [&](auto& function, const char* name)
        {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
                device.vk.vkGetDeviceProcAddr(device.handle, name));
            HEARTH_ASSERT(function != nullptr);
        };
        load(vkCreateCommandPool, "vkCreateCommandPool");
        load(vkDestroyCommandPool, "vkDestroyCommandPool");
        load(vkAllocateCommandBuffers, "vkAllocateCommandBuffers");
        load(vkBeginCommandBuffer, "vkBeginCommandBuffer");
        load(vkEndCommandBuffer, "vkEndCommandBuffer");
        load(vkCreateFence, "vkCreateFence");
        load(vkDestroyFence, "vkDestroyFence");
        load(vkWaitForFences, "vkWaitForFences");
        load(vkQueueSubmit, "vkQueueSubmit");
        load(vkGetDeviceQueue, "vkGetDeviceQueue");
        load(vkCmdCopyImageToBuffer, "vkCmdCopyImageToBuffer");
    }
};

/// Submits frames in flight, and keeps the image of each.
class FrameQueue
{
public:
    FrameQueue(viewer::VulkanHost& host, const gpu::Device& device, uint32_t in_flight)
        : device_(device), vk_(device), arena_(device, 0), queue_(host.queue()), in_flight_(in_flight)
    {
        const VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                           host.queueFamily()};
        HEARTH_ASSERT(vk_.vkCreateCommandPool(device.handle, &info, nullptr, &pool_) == VK_SUCCESS);
    }
    ~FrameQueue()
    {
        for (const Frame& frame : frames_)
            vk_.vkDestroyFence(device_.handle, frame.fence, nullptr);
        vk_.vkDestroyCommandPool(device_.handle, pool_, nullptr);
    }
    FrameQueue(const FrameQueue&) = delete;
    FrameQueue& operator=(const FrameQueue&) = delete;

    /// Serial of the last frame that is known to have completed; waits for all but the frames in flight.
    uint64_t waitForTurn()
    {
        const size_t completed = frames_.size() - std::min<size_t>(frames_.size(), in_flight_ - 1);
        for (size_t frame = 0; frame < completed; ++frame)
            wait(frame);
        return completed;
    }

    /// Record a frame into targets, and submit it without waiting.
    void submit(const gpu::FrameTargets& targets, const std::function<void(VkCommandBuffer)>& record)
    {
        Frame frame;
        auto buffer =
            arena_.createBuffer(kImageBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::readback);
        HEARTH_ASSERT(buffer.ok());
        frame.image = std::move(*buffer);
        const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                               VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
        VkCommandBuffer commands;
        HEARTH_ASSERT(vk_.vkAllocateCommandBuffers(device_.handle, &info, &commands) == VK_SUCCESS);
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                             VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
        HEARTH_ASSERT(vk_.vkBeginCommandBuffer(commands, &begin) == VK_SUCCESS);
        record(commands);
        const VkBufferImageCopy region{
            0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {0, 0, 0}, {kWidth, kHeight, 1}};
        vk_.vkCmdCopyImageToBuffer(commands, targets.color().handle.get(),
                                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, frame.image.handle.get(), 1,
                                   &region);
        HEARTH_ASSERT(vk_.vkEndCommandBuffer(commands) == VK_SUCCESS);
        const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
        HEARTH_ASSERT(vk_.vkCreateFence(device_.handle, &fence, nullptr, &frame.fence) == VK_SUCCESS);
        VkSubmitInfo submission{};
        submission.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submission.commandBufferCount = 1;
        submission.pCommandBuffers = &commands;
        HEARTH_ASSERT(vk_.vkQueueSubmit(queue_, 1, &submission, frame.fence) == VK_SUCCESS);
        frames_.push_back(std::move(frame));
    }

    /// Wait for all frames, and return their images.
    std::vector<std::vector<std::byte>> finish()
    {
        std::vector<std::vector<std::byte>> images;
        for (size_t frame = 0; frame < frames_.size(); ++frame)
        {
            wait(frame);
            const std::byte* mapped = frames_[frame].image.mapped;
            images.emplace_back(mapped, mapped + kImageBytes);
        }
        return images;
    }

private:
    struct Frame
    {
        VkFence fence = VK_NULL_HANDLE;
        gpu::Buffer image;
    };

    void wait(size_t frame)
    {
        HEARTH_ASSERT(vk_.vkWaitForFences(device_.handle, 1, &frames_[frame].fence, VK_TRUE, ~uint64_t{0}) ==
                      VK_SUCCESS);
    }

    const gpu::Device& device_;
    SubmitTable vk_;
    gpu::MemoryArena arena_;
    VkQueue queue_;
    uint32_t in_flight_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::vector<Frame> frames_;
};

/// Inputs of a numbered frame of a scene.
using MakeFrame = std::function<gpu::FrameInput(const gpu::Scene& scene, uint32_t number)>;

shared::Camera movingCamera(uint32_t number)
{
    const float angle = 0.07f * static_cast<float>(number);
    return {.position = {8 * std::sin(angle), 2, 8 * std::cos(angle)}, .target = {}};
}

class FramesInFlightTest : public GpuTest
{
protected:
    static constexpr uint32_t kFrames = 8;

    /// Draw frames with so many in flight.
    std::vector<std::vector<std::byte>> drawFrames(const formats::PackView& pack, gpu::SceneOptions options,
                                                   uint32_t in_flight, const MakeFrame& make)
    {
        options.frames_in_flight = in_flight;
        const auto scene = upload(pack, options);
        gpu::FrameTargets targets = makeTargets(kWidth, kHeight);
        FrameQueue queue(host(), renderer().device(), in_flight);
        for (uint32_t number = 0; number < kFrames; ++number)
        {
            const uint64_t completed = queue.waitForTurn();
            if (scene->stream != nullptr)
                scene->stream->beginFrame(number + 1, completed);
            const gpu::FrameInput input = make(*scene, number);
            queue.submit(targets, [&](VkCommandBuffer commands)
                         { renderer().record(commands, *scene, targets, input); });
        }
        return queue.finish();
    }

    /// Record several frames into one command buffer, in which the validation layer sees all hazards.
    void recordTogether(const formats::PackView& pack, gpu::SceneOptions options, const MakeFrame& make)
    {
        constexpr uint32_t kTogether = 3;
        options.frames_in_flight = kTogether;
        const auto scene = upload(pack, options);
        gpu::FrameTargets targets = makeTargets(kWidth, kHeight);
        const Status status = host().run(
            [&](VkCommandBuffer commands)
            {
                for (uint32_t number = 0; number < kTogether; ++number)
                {
                    if (scene->stream != nullptr)
                        scene->stream->beginFrame(number + 1, 0);
                    const gpu::FrameInput input = make(*scene, number);
                    renderer().record(commands, *scene, targets, input);
                }
                return success();
            });
        EXPECT_TRUE(status.ok());
    }

    /// Expect the same images with two and three frames in flight as with one.
    void expectSame(const formats::PackView& pack, const gpu::SceneOptions& options, const MakeFrame& make)
    {
        const auto expected = drawFrames(pack, options, 1, make);
        for (const uint32_t in_flight : {2u, 3u})
            EXPECT_EQ(drawFrames(pack, options, in_flight, make), expected) << in_flight;
        EXPECT_NE(expected.front(), expected.back()) << "frames that are all the same show nothing";
        recordTogether(pack, options, make);
    }

    gpu::FrameInput makeInput(const gpu::Scene& scene, uint32_t number)
    {
        return {.view = makeView(scene, movingCamera(number), {.width = kWidth, .height = kHeight})};
    }
};

void addSun(TestScene& test)
{
    formats::LightRecord sun{};
    sun.type = static_cast<uint32_t>(formats::LightType::directional);
    sun.color = {1, 1, 1};
    sun.intensity = 2;
    sun.world_from_light = Affine3{};
    test.addLight(sun);
}

/// Rocks of two materials under a sun, the pack's only light.
formats::PackView buildRocks(TestScene& test)
{
    std::mt19937 random(5);
    formats::MaterialRecord masked = plainMaterial();
    masked.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
    const uint32_t materials[] = {test.addMaterial(plainMaterial()), test.addMaterial(masked)};
    for (uint32_t i = 0; i < 16; ++i)
    {
        const uint32_t mesh = test.addMesh(withMaterial(shapes::rock(8, 0.2f, i + 1), materials[i % 2]));
        test.addInstance(mesh, randomAffine(random, 3));
    }
    addSun(test);
    return test.build();
}

} // namespace

TEST_F(FramesInFlightTest, movingInstancesAndLightsWithShadows)
{
    TestScene test;
    const formats::PackView pack = buildRocks(test);
    std::vector<gpu::InstanceMove> moves;
    std::vector<gpu::LightChange> lights;
    expectSame(pack, {.shadows = {.max_maps = 4, .texels = 128}},
               [&](const gpu::Scene& scene, uint32_t number)
               {
                   moves.clear();
                   lights.clear();
                   for (uint32_t i = number % 3; i < 16; i += 3)
                       moves.push_back(
                           *gpu::moveInstance(scene, i,
                                              translated({static_cast<float>(i) * 0.2f - 1.5f,
                                                          std::sin(static_cast<float>(number + i)), 0})));
                   formats::LightRecord record = pack.lights()[0];
                   record.intensity = 1.0f + 0.1f * static_cast<float>(number);
                   lights.push_back(*gpu::changeLight(scene, 0, record));
                   gpu::FrameInput input = makeInput(scene, number);
                   input.moves = moves;
                   input.lights = lights;
                   return input;
               });
}

TEST_F(FramesInFlightTest, occlusionByAnEarlierFrame)
{
    TestScene test;
    const formats::PackView pack = buildRocks(test);
    expectSame(pack, {},
               [&](const gpu::Scene& scene, uint32_t number)
               {
                   gpu::FrameInput input = makeInput(scene, number);
                   input.occludes_by_last_frame = true;
                   return input;
               });
}

TEST_F(FramesInFlightTest, manyShadowMapsInRounds)
{
    // more maps than are culled side by side
    TestScene test;
    const formats::PackView pack = buildRocks(test);
    std::vector<gpu::ShadowSphere> spheres;
    for (int i = 0; i < 16; ++i)
        spheres.push_back({.center = {static_cast<float>(i % 4) - 1.5f, 0, static_cast<float>(i / 4) - 1.5f},
                           .radius = 0.7f});
    expectSame(pack, {.shadows = {.max_maps = 24, .texels = 64}},
               [&](const gpu::Scene& scene, uint32_t number)
               {
                   gpu::FrameInput input = makeInput(scene, number);
                   input.shadow_spheres = spheres;
                   return input;
               });
}

TEST_F(FramesInFlightTest, charactersInMotion)
{
    const DeformedScene deformed({.rings = 8}, 3);
    std::vector<TestPose> poses;
    std::vector<gpu::InstancePose> views;
    expectSame(deformed.pack(), {.shadows = {.max_maps = 4, .texels = 64}},
               [&](const gpu::Scene& scene, uint32_t number)
               {
                   std::mt19937 random(number);
                   poses = deformed.randomPoses(random);
                   views = makeViews(poses);
                   gpu::FrameInput input = makeInput(scene, number);
                   input.poses = views;
                   return input;
               });
}

TEST_F(FramesInFlightTest, streamedScenesConverge)
{
    TestScene test;
    const uint32_t mesh =
        test.addMesh(withMaterial(shapes::rock(60, 0.2f, 1), test.addMaterial(plainMaterial())));
    for (int i = 0; i < 4; ++i)
        test.addInstance(mesh, translated({static_cast<float>(i) * 2 - 3, 0, 0}));
    const formats::PackView pack = test.build();
    const pack::PageReader reader = [&](uint32_t page, std::span<std::byte> to, pack::ReadDone done)
    { done(pack.decodePage(page, to).ok()); };
    const MakeFrame make = [&](const gpu::Scene& scene, uint32_t)
    {
        return gpu::FrameInput{.view = makeView(scene, {.position = {0, 1, 5}, .target = {}},
                                                {.width = kWidth, .height = kHeight})};
    };
    const auto resident = drawFrames(pack, {}, 1, make);
    for (const uint32_t in_flight : {1u, 2u, 3u})
    {
        const auto images =
            drawFrames(pack, {.memory_budget = 8 << 20, .stream = {.read = reader}}, in_flight, make);
        EXPECT_EQ(images.back(), resident.back()) << in_flight;
    }
    recordTogether(pack, {.memory_budget = 8 << 20, .stream = {.read = reader}}, make);
}

TEST_F(FramesInFlightTest, bricksUnderALightThatChanges)
{
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(shapes::rock(20, 0.2f, 1), test.addMaterial(plainMaterial()))),
                     translated({2, 2, 2}));
    addSun(test);
    setBricks(test, brickModel({8, 8, 8}, makeShell({8, 8, 8}),
                               [](std::array<uint32_t, 3>, uint32_t) { return FaceLook{}; }));
    const formats::PackView pack = test.build();
    std::vector<gpu::LightChange> lights;
    gpu::EmissionScale scale{.box = {{-1, -1, -1}, {9, 9, 9}}, .factor = 1};
    expectSame(pack, {.bricks = {.faces_per_frame = 64}},
               [&](const gpu::Scene& scene, uint32_t number)
               {
                   formats::LightRecord record = pack.lights()[0];
                   record.intensity = 1.0f + static_cast<float>(number);
                   lights.assign(1, *gpu::changeLight(scene, 0, record));
                   gpu::FrameInput input = makeInput(scene, number);
                   input.lights = lights;
                   input.emission = {&scale, 1};
                   return input;
               });
}

namespace
{

/// Frames whose stages are followed.
struct SpiedFrames
{
    const char* name;
    gpu::MaterialTest materials;
    bool occludes_by_last_frame;
    bool defers_pyramid; ///< the pyramid of the last frame is made behind the culling
};

class SpiedFramesTest : public FramesInFlightTest, public testing::WithParamInterface<SpiedFrames>
{
};

INSTANTIATE_TEST_SUITE_P(, SpiedFramesTest,
                         testing::Values(SpiedFrames{"TwoPhases", gpu::MaterialTest::depth, false, false},
                                         SpiedFrames{"TwoPhasesById", gpu::MaterialTest::id, false, false},
                                         SpiedFrames{"LastFrame", gpu::MaterialTest::depth, true, false},
                                         SpiedFrames{"LastFrameById", gpu::MaterialTest::id, true, true}),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace

TEST_P(SpiedFramesTest, geometryWaitsForNoShading)
{
    TestScene test;
    const formats::PackView pack = buildRocks(test);
    const SpiedFrames& param = GetParam();
    auto created = gpu::Renderer::create(spyOnStages(host().description()),
                                         {.way = gpu::FrameWay::merged, .materials = param.materials});
    ASSERT_TRUE(created.ok());
    gpu::Renderer& spied = **created;
    const auto run = [&](const std::function<void(VkCommandBuffer)>& record)
    {
        ASSERT_TRUE(host()
                        .run(
                            [&](VkCommandBuffer commands)
                            {
                                record(commands);
                                return success();
                            })
                        .ok());
    };
    std::unique_ptr<gpu::Scene> scene;
    run(
        [&](VkCommandBuffer commands)
        {
            auto uploaded = spied.upload(pack, commands,
                                         {.frames_in_flight = 2, .shadows = {.max_maps = 4, .texels = 64}});
            ASSERT_TRUE(uploaded.ok());
            scene = std::move(*uploaded);
        });
    scene->staging.reset();
    auto targets = spied.createTargets({kWidth, kHeight});
    ASSERT_TRUE(targets.ok());
    constexpr VkPipelineStageFlags kGeometry = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                               VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                               VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
    const auto makeSpied = [&](uint32_t number)
    {
        gpu::FrameInput input = makeInput(*scene, number);
        input.occludes_by_last_frame = param.occludes_by_last_frame;
        return input;
    };
    const auto countWaits = [&](bool planted)
    {
        size_t waits = 0, geometry = 0, pyramids = 0;
        run(
            [&](VkCommandBuffer commands)
            {
                forgetCommands();
                markFragments("shading");
                spied.record(commands, *scene, *targets, makeSpied(0));
                markFragments("");
                // the caller copies the image
                addBarrier(VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
                addCommand(VK_PIPELINE_STAGE_TRANSFER_BIT);
                EXPECT_NE(spiedCommands().back().waiting, 0u) << "the copy waits for the shading";
                if (planted)
                    addBarrier(VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
                const size_t first = spiedCommands().size();
                spied.record(commands, *scene, *targets, makeSpied(1));
                for (size_t i = first; i < spiedCommands().size(); ++i)
                {
                    const SpiedCommand& command = spiedCommands()[i];
                    if (command.label == "pyramid")
                    {
                        ++pyramids;
                        if (!param.defers_pyramid)
                            break; // waits for this frame's own fragments
                        EXPECT_NE(command.waiting, 0u) << "waits for the last frame's";
                        continue;
                    }
                    geometry += (command.stages & kGeometry) != 0 ? 1 : 0;
                    waits += (command.waiting & kGeometry) != 0 ? 1 : 0;
                }
            });
        EXPECT_GT(geometry, 20u);
        EXPECT_GT(pyramids, 0u);
        return waits;
    };
    EXPECT_EQ(countWaits(false), 0u);
    EXPECT_GT(countWaits(true), 0u) << "a wait is found";
}

} // namespace hearth::test
