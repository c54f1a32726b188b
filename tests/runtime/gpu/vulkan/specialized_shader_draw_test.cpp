// Tests that specialized shaders compute what drivers make of the whole modules and the same constants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/pipelines.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/runtime/shaders/test_shaders.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/surfaces/lattice_texture.h"

#include <bit>
#include <random>
#include <set>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

class SpecializedShaderDrawTest : public GpuTest
{
protected:
    /// Run branches.comp on a device.
    static std::vector<uint32_t> runBranches(const gpu::Device& device, std::span<const uint32_t> constants)
    {
        const gpu::SetBinding bindings[] = {gpu::storageBinding(0, VK_SHADER_STAGE_COMPUTE_BIT)};
        const auto layout = gpu::createSetLayout(device, bindings);
        HEARTH_ASSERT(layout.ok());
        const gpu::NumberedSet sets[] = {{0, layout->get()}};
        const auto pipeline = gpu::createComputePipeline(device, shaders::branches_comp, sets, 0, constants);
        HEARTH_ASSERT(pipeline.ok());
        gpu::MemoryArena arena(device);
        const auto results = arena.createBuffer(
            kInvocations * sizeof(uint32_t),
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::device);
        const auto pool = gpu::createDescriptorPool(device, 1, {.storages = 1});
        HEARTH_ASSERT(results.ok() && pool.ok());
        const auto set = gpu::allocateSet(device, pool->get(), layout->get());
        HEARTH_ASSERT(set.ok());
        gpu::DescriptorWriter(*set).storage(0, *results).write(device);
        const Status status = host().run(
            [&](VkCommandBuffer commands) -> Status
            {
                device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                            pipeline->pipeline.get());
                device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                                  pipeline->layout.get(), 0, 1, &*set, 0, nullptr);
                device.vk.vkCmdDispatch(commands, kInvocations / 64, 1, 1);
                gpu::barrier(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                             VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
                             VK_ACCESS_TRANSFER_READ_BIT);
                return success();
            });
        HEARTH_ASSERT(status.ok());
        const auto bytes = host().read(device, *results);
        HEARTH_ASSERT(bytes.ok());
        std::vector<uint32_t> words(kInvocations);
        std::memcpy(words.data(), bytes->data(), words.size() * sizeof(uint32_t));
        return words;
    }

    /// Draw a pack with specialized shaders, then with whole ones, which are on a device of their own.
    void expectOneImage(const formats::PackView& pack, const shared::Camera& camera,
                        const DrawOptions& options = {})
    {
        const Image specialized = draw(*upload(pack), camera, options);
        auto created = viewer::VulkanHost::create({.device_name = "", .validate = true});
        ASSERT_TRUE(created.ok());
        std::unique_ptr<viewer::VulkanHost> whole_host = std::move(*created);
        gpu::DeviceDescription description = whole_host->description();
        description.specializes_shaders = false;
        auto whole = gpu::Renderer::create(description, testRendererOptions());
        ASSERT_TRUE(whole.ok());
        std::unique_ptr<gpu::Renderer> whole_renderer = std::move(*whole);
        exchangeDevice(whole_host, whole_renderer);
        const Image expected = draw(*upload(pack), camera, options);
        exchangeDevice(whole_host, whole_renderer);
        EXPECT_TRUE(whole_host->messages().empty());
        EXPECT_EQ(specialized.color, expected.color);
        EXPECT_EQ(specialized.seen(), expected.seen());
        EXPECT_GT(std::set(expected.color.begin(), expected.color.end()).size(), 200u)
            << "there is little to compare";
    }

    static constexpr uint32_t kInvocations = 1024;
};

} // namespace

TEST_F(SpecializedShaderDrawTest, computesTheWordsOfTheWholeModule)
{
    gpu::DeviceDescription description = host().description();
    description.specializes_shaders = false;
    const auto whole = gpu::makeDevice(description);
    ASSERT_TRUE(whole.ok());
    std::mt19937 random(5);
    const auto below = [&random](uint32_t end) { return static_cast<uint32_t>(random() % end); };
    std::set<std::vector<uint32_t>> different;
    for (int round = 0; round < 60; ++round)
    {
        const uint32_t constants[] = {below(5),
                                      below(2),
                                      below(7),
                                      below(2) != 0 ? 3u : 0xFFFFFFF0u,
                                      std::bit_cast<uint32_t>(static_cast<float>(below(9))),
                                      below(3)};
        const std::vector<uint32_t> words = runBranches(renderer().device(), constants);
        ASSERT_EQ(words, runBranches(*whole, constants)) << round;
        different.insert(words);
    }
    EXPECT_GT(different.size(), 40u);
}

TEST_F(SpecializedShaderDrawTest, drawsTheImageOfTheWholeModulesWithLayersLampsAndBricks)
{
    TestScene test;
    formats::MaterialRecord tiles = plainMaterial();
    tiles.base_color_texture =
        makeTextureRef(test.addImage(formats::TexelFormat::rgba8_srgb, 64, 32, makeLatticeTexels(64, 32)));
    tiles.roughness = 0.3f;
    const uint32_t floor = test.addMaterial(tiles);
    const uint32_t white = test.addMaterial(plainMaterial());
    formats::MaterialLayersRecord layers = formats::neutralLayers(floor);
    layers.clearcoat = 0.8f;
    test.model().material_layers = {layers};
    test.addInstance(test.addMesh(withMaterial(makeQuad(12, 12), floor)), lying({0, 0, 0}));
    test.addInstance(test.addMesh(withMaterial(makeQuad(2, 1.5f), white)), translated({1, 0.8f, 1}));
    test.addLight(sun({0.2f, -1, -0.3f}));
    test.addLight(light(LightType::point, {2, 2, 2}, {0, -1, 0}, 6));
    BrickModel bricks = brickModel(
        {24, 16, 24}, [](uint32_t x, uint32_t y, uint32_t) { return y < 2 || x < 2; },
        [](std::array<uint32_t, 3>, uint32_t side) {
            return FaceLook{{0.4f, 0.5f, 0.6f}, side == 1 ? Float3{1, 0.1f, 0.1f} : Float3{}};
        });
    bricks.grid.origin = {-6, -1, -6};
    bricks.grid.voxel_size = 0.5f;
    setBricks(test, bricks);
    const formats::PackView pack = test.build();
    const shared::Camera camera{.position = {2, 3, 7}, .target = {0, 0.5f, 0}};
    expectOneImage(pack, camera);
    expectOneImage(pack, camera, {.gi = false});
}

TEST_F(SpecializedShaderDrawTest, drawsTheImageOfTheWholeModulesWithCharacters)
{
    const DeformedScene deformed({.rings = 8}, 1);
    std::mt19937 random(3);
    const std::vector<TestPose> poses = deformed.randomPoses(random);
    const std::vector<gpu::InstancePose> views = makeViews(poses);
    expectOneImage(deformed.pack(), {.position = {5, 3, 6}, .target = {0, 0, 0}}, {.poses = views});
}

} // namespace hearth::test
