// Tests that frames recorded part by part equal frames recorded at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/shading.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

namespace hearth::test
{

namespace
{

using gpu::FramePart;
using gpu::partImages;

class FramePartsTest : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        formats::MaterialRecord masked = plainMaterial();
        masked.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
        const uint32_t materials[] = {test_.addMaterial(plainMaterial()), test_.addMaterial(masked)};
        std::mt19937 random(3);
        for (uint32_t i = 0; i < 12; ++i)
        {
            const uint32_t mesh = test_.addMesh(withMaterial(shapes::rock(8, 0.2f, i + 1), materials[i % 2]));
            test_.addInstance(mesh, randomAffine(random, 4));
        }
        pack_ = test_.build();
    }

    /// Record one part in a command buffer of its own.
    void run(const std::function<void(VkCommandBuffer)>& record)
    {
        const Status status = host().run(
            [&](VkCommandBuffer commands)
            {
                record(commands);
                return success();
            });
        ASSERT_TRUE(status.ok());
    }

    Image drawInParts(const gpu::Scene& scene, gpu::FrameTargets& targets, const gpu::FrameInput& input)
    {
        const gpu::Renderer& r = renderer();
        run([&](VkCommandBuffer commands) { r.recordCull(commands, scene, targets, input); });
        run([&](VkCommandBuffer commands) { r.recordVisibility(commands, scene, targets, input); });
        copyVisibility(targets);
        run([&](VkCommandBuffer commands) { r.recordMaterials(commands, scene, targets, input); });
        return readImage(scene, targets);
    }

    /// Draw all parts in one command buffer. Only their own barriers are between them; the validation layer
    /// checks these.
    Image drawInOneBuffer(const gpu::Scene& scene, gpu::FrameTargets& targets, const gpu::FrameInput& input)
    {
        run(
            [&](VkCommandBuffer commands)
            {
                renderer().recordCull(commands, scene, targets, input);
                renderer().recordVisibility(commands, scene, targets, input);
                renderer().recordMaterials(commands, scene, targets, input);
            });
        return readImage(scene, targets);
    }

    /// Copy the visibility buffer between two parts, as a caller may, with barriers made only from the image
    /// states that the parts report.
    void copyVisibility(const gpu::FrameTargets& targets)
    {
        const gpu::ImageState drawn = partImages(FramePart::visibility, true).visibility.after;
        const gpu::ImageState wanted = partImages(FramePart::materials, true).visibility.before;
        const gpu::ImageState copied{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                     VK_ACCESS_TRANSFER_READ_BIT};
        run([&](VkCommandBuffer commands) { transition(commands, targets.visibility(), drawn, copied); });
        const auto pixels = host().read(renderer().device(), targets.visibility(), 4);
        ASSERT_TRUE(pixels.ok());
        between_.resize(pixels->size() / 4);
        std::memcpy(between_.data(), pixels->data(), pixels->size());
        run([&](VkCommandBuffer commands) { transition(commands, targets.visibility(), copied, wanted); });
    }

    void transition(VkCommandBuffer commands, const gpu::Image& image, const gpu::ImageState& from,
                    const gpu::ImageState& to)
    {
        VkImageMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barrier.srcAccessMask = from.access;
        barrier.dstAccessMask = to.access;
        barrier.oldLayout = from.layout;
        barrier.newLayout = to.layout;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.handle.get();
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        renderer().device().vk.vkCmdPipelineBarrier(commands, from.stages, to.stages, 0, 0, nullptr, 0,
                                                    nullptr, 1, &barrier);
    }

    /// Compare several frames of a moving camera, recorded in several command buffers and in one.
    void expectSame(const DrawOptions& options, const gpu::SceneOptions& scene_options = {})
    {
        const auto whole = upload(*pack_, scene_options), parts = upload(*pack_, scene_options);
        gpu::FrameTargets whole_targets = makeTargets(options.width, options.height);
        gpu::FrameTargets parts_targets = makeTargets(options.width, options.height);
        for (uint64_t frame = 1; frame <= 4; ++frame)
        {
            const shared::Camera camera{.position = {static_cast<float>(frame), 2, 9}, .target = {}};
            if (whole->stream != nullptr)
                whole->stream->beginFrame(frame, frame - 1);
            const Image expected = draw(*whole, whole_targets, camera, options);
            if (parts->stream != nullptr)
                parts->stream->beginFrame(frame, frame - 1);
            const gpu::FrameInput input{.view = makeView(*parts, camera, options),
                                        .shading = {.debug_view = options.debug_view, .area = options.area}};
            const bool in_one = frame % 2 == 0;
            const Image image = in_one ? drawInOneBuffer(*parts, parts_targets, input)
                                       : drawInParts(*parts, parts_targets, input);
            EXPECT_EQ(image.visibility, expected.visibility);
            EXPECT_EQ(image.color, expected.color);
            EXPECT_EQ(image.list.counters.drawn_clusters, expected.list.counters.drawn_clusters);
            if (!in_one)
            {
                EXPECT_EQ(between_, expected.visibility);
            }
        }
    }

    TestScene test_;
    std::optional<formats::PackView> pack_;
    std::vector<uint32_t> between_; ///< visibility buffer between two parts
};

} // namespace

TEST_F(FramePartsTest, areTheFrameWithTilesAndWithout)
{
    for (const gpu::ShadedArea area : {gpu::ShadedArea::wholeFrame, gpu::ShadedArea::tiles})
        expectSame({.area = area});
}

TEST_F(FramePartsTest, areTheFrameInOnePhase)
{
    expectSame({.flags = shared::kCullFrustum | shared::kCullCone});
}

TEST_F(FramePartsTest, areTheDebugViews)
{
    expectSame({.debug_view = shared::kViewClusters});
    expectSame({.debug_view = shared::kViewOverdraw});
}

TEST_F(FramePartsTest, areTheFrameOfAStreamedScene)
{
    const pack::PageReader reader =
        [this](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
    { done(pack_->decodePage(page, destination).ok()); };
    expectSame({}, {.frames_in_flight = 1, .memory_budget = 8 << 20, .stream = {.read = reader}});
}

} // namespace hearth::test
