// Tests frames in each of which all of 4096 lights change, come or go: lists are those of the CPU, and no
// memory is left behind. HEARTH_TEST_LIGHT_FRAMES sets how many frames there are.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/lights/light_words.h"
#include "tests/runtime/gpu/lights/random_light.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>
#include <malloc.h>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

constexpr uint32_t kLights = shared::kMaxLights;
constexpr DrawOptions kSize{.width = 128, .height = 72};
constexpr shared::Camera kOverview{.position = {8, 4, 9}, .target = {0, 0, 0}};

/// Memory that the objects of a renderer take from the process.
class CountedMemory
{
public:
    /// Blocks that are in use.
    int64_t blocks() const { return blocks_; }

    const VkAllocationCallbacks& callbacks() const { return callbacks_; }

private:
    static VKAPI_ATTR void* VKAPI_CALL allocate(void* user, size_t size, size_t alignment,
                                                VkSystemAllocationScope)
    {
        ++static_cast<CountedMemory*>(user)->blocks_;
        return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    }
    static VKAPI_ATTR void* VKAPI_CALL reallocate(void* user, void* block, size_t size, size_t alignment,
                                                  VkSystemAllocationScope scope)
    {
        if (size == 0)
            return release(user, block), nullptr;
        void* const grown = allocate(user, size, alignment, scope);
        if (block != nullptr)
        {
            std::memcpy(grown, block, std::min(size, ::malloc_usable_size(block)));
            release(user, block);
        }
        return grown;
    }
    static VKAPI_ATTR void VKAPI_CALL release(void* user, void* block)
    {
        if (block != nullptr)
            --static_cast<CountedMemory*>(user)->blocks_;
        std::free(block);
    }

    std::atomic<int64_t> blocks_ = 0;
    VkAllocationCallbacks callbacks_{this, allocate, reallocate, release, nullptr, nullptr};
};

/// Return the bytes that the process has allocated and not freed. Those that lie in memory say less: what was
/// freed once hides a leak for hundreds of frames.
uint64_t allocatedBytes()
{
    const struct mallinfo2 info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
}

/// Memory that must be the same after thousands of frames as after a few.
struct MemoryInUse
{
    VkDeviceSize scene = 0, targets = 0; ///< bytes of the device
    int64_t blocks = 0;                  ///< of Vulkan objects

    bool operator==(const MemoryInUse&) const = default;
};

class LightFramesTest : public GpuTest
{
protected:
    static void SetUpTestSuite()
    {
        GpuTest::SetUpTestSuite();
        replaceRenderer(testRendererOptions(), &counted_.callbacks());
    }
    static void TearDownTestSuite()
    {
        GpuTest::TearDownTestSuite();
        EXPECT_EQ(counted_.blocks(), 0);
    }

    void addGround()
    {
        const uint32_t stone = test_.addMaterial(plainMaterial());
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(24, 24), stone)), lying({}));
        const uint32_t rock = test_.addMesh(withMaterial(shapes::rock(12, 0.3f), stone));
        for (uint32_t i = 0; i < 9; ++i)
            test_.addInstance(rock, translated({static_cast<float>(i % 3) * 5 - 5, 0.6f,
                                                static_cast<float>(i / 3) * 5 - 6}));
    }

    /// Change all lights: a random share of them is on, of all types, with ranges and without.
    void changeLights()
    {
        const uint32_t busy = random_() % 257;
        for (uint32_t slot = 0; slot < kLights; ++slot)
        {
            LightRecord record = randomLight(random_, 2);
            if (random_() % 1024 == 0)
                record.type = static_cast<uint32_t>(LightType::directional);
            if (random_() % 1024 == 0)
                record.range = 0;
            if (random_() % 256 >= busy)
                record.intensity = 0;
            changes_[slot] = gpu::changeLight(*scene_, slot, record).value();
            lights_[slot] = changes_[slot].record;
        }
    }

    /// Return the words of the lists that the CPU makes of the lights.
    std::vector<uint32_t> listOnCpu()
    {
        const shared::LightGridLayout grid =
            shared::makeLightGrid(shared::lightGridView(makeView(*scene_, kOverview, kSize)));
        shared::LightListCounts counts;
        std::vector<uint32_t> rows(kLights), cells(shared::kMaxLightCells), indices(64u * 1024);
        twin_.assign(grid, lights_, {&counts, rows, cells, indices});
        std::vector<uint32_t> words(shared::kLightCountWords);
        std::memcpy(words.data(), &counts, sizeof(counts));
        words.insert(words.end(), rows.begin(), rows.begin() + counts.unranged + counts.ranged);
        words.insert(words.end(), cells.begin(), cells.begin() + grid.grid.cell_count);
        if (counts.overflows == 0)
            words.insert(words.end(), indices.begin(), indices.begin() + counts.index_words);
        most_ = std::max(most_, counts.ranged);
        return words;
    }

    MemoryInUse memoryInUse(const gpu::FrameTargets& targets) const
    {
        return {scene_->arena.allocatedBytes(), targets.allocatedBytes(), counted_.blocks()};
    }

    /// Draw the frames. Memory in use is the same at the end as after the first of them.
    /// check  called after each frame
    void drawFrames(const formats::PackView& pack, const std::function<void(int frame, bool warm)>& check)
    {
        const char* const more = std::getenv("HEARTH_TEST_LIGHT_FRAMES");
        const int frames = more == nullptr ? 100 : std::atoi(more);
        const int warm_up = std::min(frames / 3, 500);
        scene_ = upload(pack, {.max_lights = kLights});
        gpu::FrameTargets targets = makeTargets(kSize.width, kSize.height);
        MemoryInUse warm;
        for (int frame = 0; frame < frames; ++frame)
        {
            changeLights();
            DrawOptions options = kSize;
            options.lights = changes_;
            image_ = draw(*scene_, targets, kOverview, options);
            check(frame, frame >= warm_up);
            if (HasFatalFailure())
                return;
            if (frame == warm_up)
                warm = memoryInUse(targets);
        }
        EXPECT_EQ(memoryInUse(targets), warm);
        EXPECT_GT(warm.blocks, 0);
    }

    static inline CountedMemory counted_;
    TestScene test_;
    std::unique_ptr<gpu::Scene> scene_;
    std::mt19937 random_{3};
    std::vector<gpu::LightChange> changes_{kLights};
    std::vector<shared::Light> lights_{kLights};
    shared::LightLists twin_;
    uint32_t most_ = 0; ///< lights with a range in any frame
    Image image_;       ///< of the last frame
};

} // namespace

TEST_F(LightFramesTest, listAllLightsAsTheyChangeComeAndGo)
{
    addGround();
    const formats::PackView pack = test_.build();
    drawFrames(pack,
               [&](int frame, bool)
               {
                   ASSERT_EQ(readLightWords(*scene_), listOnCpu()) << "frame " << frame;
                   ASSERT_EQ(host().messages(), std::vector<std::string>{}) << "frame " << frame;
               });
    EXPECT_GT(most_, 2000u);

    // as a scene that has had the last frame's lights from the start
    const auto fresh = upload(pack, {.max_lights = kLights});
    DrawOptions options = kSize;
    options.lights = changes_;
    EXPECT_EQ(draw(*fresh, kOverview, options).color, image_.color);
}

/// Without validation, whose layer keeps 3 KB for each command buffer that was ever allocated.
TEST_F(LightFramesTest, leaveNoMemoryBehind)
{
    if (kSanitized)
        GTEST_SKIP() << "a sanitizer has an allocator of its own";
    auto plain_host = viewer::VulkanHost::create({});
    ASSERT_TRUE(plain_host.ok());
    gpu::DeviceDescription description = (*plain_host)->description();
    description.allocator = &counted_.callbacks();
    auto plain_renderer = gpu::Renderer::create(description, testRendererOptions());
    ASSERT_TRUE(plain_renderer.ok());
    exchangeDevice(*plain_host, *plain_renderer);
    addGround();
    const formats::PackView pack = test_.build();
    std::optional<uint64_t> warm, now;
    drawFrames(pack,
               [&](int, bool is_warm)
               {
                   now = allocatedBytes();
                   if (is_warm && !warm)
                       warm = now;
               });
    scene_.reset();
    exchangeDevice(*plain_host, *plain_renderer);
    ASSERT_TRUE(warm);
    RecordProperty("warm_bytes", std::to_string(*warm));
    RecordProperty("final_bytes", std::to_string(*now));
    EXPECT_LT(*now, *warm + (16u << 10));
}

} // namespace hearth::test
