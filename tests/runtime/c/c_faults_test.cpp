// Tests that calls which run out of memory, or lose the device, change nothing: nothing leaks, the next try
// of the same call works, and the image is the same to the byte. HEARTH_TEST_FAULTS=all for more faults.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/c/c_fixture.h"
#include "tests/runtime/c/fault_injection.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string_view>

namespace hearth::test
{

namespace
{

/// Calls of a kind that fail, one at a time, and the code that is expected.
struct FaultKind
{
    FaultPlace place;
    VkResult result;
    hearth_result expected;
    const char* number; ///< of the issue
    uint64_t first = 0; ///< index of the first call that fails, unless all do
    uint64_t step = 0;  ///< between such indices; 0: it grows with the index
};

constexpr FaultKind kNoHeap{FaultPlace::heap, VK_ERROR_OUT_OF_HOST_MEMORY, HEARTH_ERROR_OUT_OF_MEMORY,
                            "E4005"};
// These three are alike to the library, and take turns. Each pipeline takes several calls.
constexpr FaultKind kNoHostMemory{
    FaultPlace::vulkan, VK_ERROR_OUT_OF_HOST_MEMORY, HEARTH_ERROR_OUT_OF_MEMORY, "E4005", 0, 5};
constexpr FaultKind kNoDeviceMemory{
    FaultPlace::vulkan, VK_ERROR_OUT_OF_DEVICE_MEMORY, HEARTH_ERROR_OUT_OF_DEVICE_MEMORY, "E4009", 1, 5};
constexpr FaultKind kLoss{FaultPlace::vulkan, VK_ERROR_DEVICE_LOST, HEARTH_ERROR_DEVICE_LOST, "E4010", 2, 5};
constexpr FaultKind kNoPiece{
    FaultPlace::hook, VK_ERROR_OUT_OF_DEVICE_MEMORY, HEARTH_ERROR_OUT_OF_DEVICE_MEMORY, "E4009", 0, 1};

/// As an option each of the first 500 calls fails, and every 20th up to 10,000.
bool failsAll()
{
    static const bool all = std::getenv("HEARTH_TEST_FAULTS") != nullptr;
    return all;
}

/// Return the index of the next call to fail.
uint64_t nextIndex(const FaultKind& kind, uint64_t index)
{
    if (failsAll())
        return index < 500 ? index + 1 : index + 20;
    return index + (kind.step > 0 ? kind.step : 1 + index / 4);
}

constexpr uint64_t kMaxIndex = 10000;

/// Draws the fixture's pack by calls that fail and are tried again.
class CFaultsTest : public CApiTest
{
protected:
    using Call = std::function<hearth_result()>;

    void SetUp() override
    {
        CApiTest::SetUp();
        if (IsSkipped())
            return;
        ASSERT_EQ(hearth_renderer_destroy(renderer_), HEARTH_OK);
        renderer_ = nullptr;
        plain_hooks_ = c_caller_memory(caller_);
    }

    /// Make a call while each of its calls of the kind fails in turn, until it succeeds.
    /// keeps_storage  failed tries may keep memory for the next one
    void attempt(std::string_view name, bool keeps_storage, const Call& call)
    {
        if (is_lost_)
            return;
        if (name == lost_in_)
        {
            const FaultScope scope({FaultPlace::vulkan, 0, VK_ERROR_DEVICE_LOST});
            const hearth_result result = call();
            const CallerScope expectations;
            EXPECT_EQ(result, HEARTH_ERROR_DEVICE_LOST) << name;
            is_lost_ = true;
            return;
        }
        uint64_t index = kind_ == nullptr || failsAll() ? 0 : kind_->first;
        for (; kind_ != nullptr && index <= kMaxIndex; index = nextIndex(*kind_, index))
        {
            const HeldResources before = heldResources();
            const FaultScope scope({kind_->place, index, kind_->result});
            const hearth_result result = call();
            const CallerScope expectations;
            if (!scope.hasFailed())
            {
                EXPECT_EQ(result, HEARTH_OK)
                    << name << ", try " << index << ": " << hearth_last_error(renderer_);
                return;
            }
            ++faults_;
            if (result == HEARTH_OK)
            {
                ADD_FAILURE() << name << " takes no notice of fault " << index;
                return;
            }
            EXPECT_EQ(result, kind_->expected)
                << name << ", fault " << index << ": " << hearth_last_error(renderer_);
            if (!keeps_storage)
            {
                EXPECT_EQ(heldResources(), before) << name << ", fault " << index;
            }
        }
        const FaultScope scope;
        const hearth_result result = call();
        const CallerScope expectations;
        ASSERT_EQ(result, HEARTH_OK) << name;
    }

    /// Submit what has been recorded, unless the device is lost by then.
    void submit(std::string_view name)
    {
        if (is_lost_)
            return;
        is_lost_ = lost_in_ == std::string("vkQueueSubmit of ").append(name);
        ASSERT_EQ(is_lost_ ? c_caller_discard(caller_) : c_caller_submit(caller_), VK_SUCCESS);
    }

    /// Record commands, which are discarded if that fails, and submit them.
    void attemptToRecord(std::string_view name, const std::function<hearth_result(VkCommandBuffer)>& record)
    {
        attempt(name, true,
                [&]
                {
                    VkCommandBuffer commands = VK_NULL_HANDLE;
                    {
                        const CallerScope scope;
                        commands = c_caller_begin(caller_);
                    }
                    const hearth_result result = record(commands);
                    const CallerScope scope;
                    if (result != HEARTH_OK)
                        EXPECT_EQ(c_caller_discard(caller_), VK_SUCCESS);
                    return result;
                });
        submit(name);
    }

    void createRenderer()
    {
        hearth_renderer_description description = c_caller_description(caller_);
        description.get_instance_proc_addr = interceptVulkan(description.get_instance_proc_addr);
        if (uses_hooks_)
            description.memory = faultingHooks(plain_hooks_);
        attempt("hearth_renderer_create", false,
                [&]
                {
                    const hearth_result result =
                        hearth_renderer_create(&description, &renderer_, message_, sizeof(message_));
                    expectMessage(result, message_);
                    return result;
                });
    }

    void expectMessage(hearth_result result, const char* message) const
    {
        const CallerScope scope;
        if (kind_ != nullptr && result != HEARTH_OK && result != HEARTH_ERROR_OUT_OF_MEMORY)
            EXPECT_THAT(message, testing::HasSubstr(kind_->number));
    }

    static void read(void* user, uint32_t page, void* destination, size_t size, hearth_page_read done)
    {
        const CallerScope scope;
        auto* const self = static_cast<CFaultsTest*>(user);
        hearth_read_done(done, hearth_pack_read_page(self->pack_, page, destination, size, nullptr, 0) ==
                                   HEARTH_OK);
    }

    void upload(bool streams)
    {
        hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
        options.shadows.max_maps = 4;
        options.shadows.texels = 64;
        options.shadows.splits = 2;
        options.shadows.split_far = 20;
        options.max_visible_clusters = 65536;
        if (streams)
        {
            options.memory_budget = 64 << 20;
            options.read = read;
            options.read_user = this;
        }
        attemptToRecord("hearth_scene_upload",
                        [&](VkCommandBuffer commands)
                        {
                            const hearth_result result =
                                hearth_scene_upload(renderer_, pack_, commands, &options, &scene_);
                            expectMessage(result, hearth_last_error(renderer_));
                            return result;
                        });
        const FaultScope scope;
        if (!is_lost_)
            EXPECT_EQ(hearth_scene_release_staging(scene_), HEARTH_OK);
    }

    void beginFrame()
    {
        ++serial_;
        attempt("hearth_scene_begin_frame", true,
                [&] { return hearth_scene_begin_frame(scene_, serial_, serial_ - 1); });
    }

    void prefetch(const hearth_frame& frame)
    {
        hearth_stream_counters counters = HEARTH_STREAM_COUNTERS_INIT;
        while (counters.settled_serial == 0 && serial_ < 100 && !is_lost_)
        {
            beginFrame();
            attemptToRecord("hearth_record_prefetch", [&](VkCommandBuffer commands)
                            { return hearth_record_prefetch(scene_, targets_, commands, &frame); });
            attempt("hearth_scene_get_stream_counters", true,
                    [&] { return hearth_scene_get_stream_counters(scene_, &counters); });
        }
    }

    /// Create all, draw some frames, and destroy all. Returns the image.
    std::vector<uint32_t> drawAll(bool streams)
    {
        serial_ = 0;
        createRenderer();
        attempt("hearth_targets_create", false,
                [&] { return createTargets(renderer_, kWidth, kHeight, &targets_); });
        upload(streams);
        attempt("hearth_scene_prepare_lights", true,
                [&] { return hearth_scene_prepare_lights(scene_, HEARTH_LIGHTS_ALL); });
        attempt("hearth_scene_prepare_picks", false, [&] { return hearth_scene_prepare_picks(scene_); });
        hearth_frame frame = makeFrame();
        const hearth_move move{.instance = 0,
                               .world_from_object = {{1, 0, 0, .1f}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
        const hearth_shadow_sphere sphere{.center = {0, 0.5f, 0}, .radius = 1, .light = 0, .texels = 0};
        frame.moves = &move;
        frame.move_count = 1;
        frame.shadow_spheres = &sphere;
        frame.shadow_sphere_count = 1;
        if (streams)
            prefetch(frame);
        for (uint32_t i = 0; i < 2; ++i)
        {
            if (streams)
                beginFrame();
            attemptToRecord("hearth_record_frame", [&](VkCommandBuffer commands)
                            { return hearth_record_frame(scene_, targets_, commands, &frame); });
        }
        return destroyAll();
    }

    /// Destroy all. Returns the image of the last frame; none of a device that is lost.
    std::vector<uint32_t> destroyAll()
    {
        std::vector<uint32_t> pixels;
        if (!is_lost_)
        {
            hearth_targets_info info = HEARTH_TARGETS_INFO_INIT;
            EXPECT_EQ(hearth_targets_get_info(targets_, &info), HEARTH_OK);
            pixels.resize(kWidth * kHeight);
            EXPECT_EQ(c_caller_read_color(caller_, &info.color, kWidth, kHeight, pixels.data()), VK_SUCCESS);
        }
        const FaultScope scope;
        EXPECT_EQ(hearth_scene_destroy(std::exchange(scene_, nullptr)), HEARTH_OK);
        EXPECT_EQ(hearth_targets_destroy(std::exchange(targets_, nullptr)), HEARTH_OK);
        EXPECT_EQ(hearth_renderer_destroy(std::exchange(renderer_, nullptr)), HEARTH_OK);
        return pixels;
    }

    /// Draw with faults of a kind: nothing is held afterwards, and the image is that of drawing without.
    void expectSameImage(const FaultKind& kind)
    {
        for (const bool streams : {false, true})
        {
            kind_ = nullptr;
            uses_hooks_ = false;
            const std::vector<uint32_t> expected = drawAll(streams);
            const HeldResources before = heldResources();
            kind_ = &kind;
            uses_hooks_ = kind.place == FaultPlace::hook || (kind.place == FaultPlace::heap && streams);
            EXPECT_EQ(drawAll(streams), expected);
            EXPECT_EQ(heldResources(), before);
            EXPECT_NE(std::ranges::count(expected, expected[0]), kWidth * kHeight) << "it shows something";
        }
        EXPECT_EQ(c_caller_live_pieces(caller_), 0u);
        RecordProperty("faults", static_cast<int>(faults_));
    }

    const FaultKind* kind_ = nullptr; ///< none: nothing fails
    bool uses_hooks_ = false;         ///< device memory comes from the caller
    std::string_view lost_in_;        ///< call whose first call of Vulkan loses the device
    bool is_lost_ = false;
    uint64_t faults_ = 0;
    uint64_t serial_ = 0;
    hearth_memory_hooks plain_hooks_{};
    hearth_targets* targets_ = nullptr;
    hearth_scene* scene_ = nullptr;
};

} // namespace

TEST_F(CFaultsTest, E4005_heapRunsOut)
{
    expectSameImage(kNoHeap);
    EXPECT_GT(faults_, 100u);
}

TEST_F(CFaultsTest, E4005_hostMemoryOfVulkanRunsOut)
{
    expectSameImage(kNoHostMemory);
    EXPECT_GT(faults_, 50u);
}

TEST_F(CFaultsTest, E4009_deviceMemoryRunsOut)
{
    expectSameImage(kNoDeviceMemory);
    EXPECT_GT(faults_, 50u);
}

TEST_F(CFaultsTest, E4009_hooksRunOut)
{
    expectSameImage(kNoPiece);
    EXPECT_GT(faults_, 20u);
}

TEST_F(CFaultsTest, E4010_everyCallMayLoseTheDevice)
{
    expectSameImage(kLoss);
    EXPECT_GT(faults_, 50u);
}

TEST_F(CFaultsTest, E4010_allIsMadeAgainFromThePackOnANewDevice)
{
    const std::vector<uint32_t> expected = drawAll(true);
    for (const char* const call :
         {"hearth_renderer_create", "hearth_targets_create", "hearth_scene_upload",
          "hearth_scene_prepare_lights", "hearth_scene_prepare_picks",
          "vkQueueSubmit of hearth_record_prefetch", "vkQueueSubmit of hearth_record_frame"})
    {
        const HeldResources before = heldResources();
        lost_in_ = call;
        EXPECT_TRUE(drawAll(true).empty()) << call;
        EXPECT_TRUE(is_lost_) << call;
        EXPECT_EQ(heldResources(), before) << call;
        lost_in_ = {};
        is_lost_ = false;
        EXPECT_EQ(c_caller_message_count(caller_), 0u) << c_caller_message(caller_);
        c_caller_destroy(caller_);
        caller_ = c_caller_create(host().deviceName().c_str());
        ASSERT_NE(caller_, nullptr);
        EXPECT_EQ(drawAll(true), expected) << call;
    }
}

TEST_F(CFaultsTest, E4005_packsPlayersAndQueriesRunOut)
{
    const HeldResources before = heldResources();
    kind_ = &kNoHeap;
    hearth_pack* pack = nullptr;
    hearth_queries* queries = nullptr;
    hearth_player* player = nullptr;
    const hearth_queries_options options = HEARTH_QUERIES_OPTIONS_INIT;
    const hearth_ray ray{.origin = {4, 2, 5}, .direction = {-4, -2, -5}, .t_min = 0, .t_max = 100};
    hearth_hit hit{}, expected{};
    hearth_player_info info = HEARTH_PLAYER_INFO_INIT;
    std::vector<std::byte> page(128 << 10);
    uint32_t record = 0;

    attempt("hearth_pack_open_memory", false,
            [&]
            {
                return hearth_pack_open_memory(bytes_.span().data(), bytes_.size(), "test", &pack, message_,
                                               sizeof(message_));
            });
    attempt("hearth_pack_check", false, [&] { return hearth_pack_check(pack, message_, sizeof(message_)); });
    attempt("hearth_pack_read_page", false,
            [&] { return hearth_pack_read_page(pack, 0, page.data(), page.size(), nullptr, 0); });
    attempt("hearth_queries_create", false,
            [&] { return hearth_queries_create(pack, &options, &queries, nullptr, 0); });
    attempt("hearth_queries_cast_rays", true,
            [&] { return hearth_queries_cast_rays(queries, &ray, 1, nullptr, &hit, nullptr, 0); });
    attempt("hearth_player_create", false, [&] { return hearth_player_create(pack, &player, nullptr, 0); });
    attempt("hearth_player_go_to", true,
            [&] { return hearth_player_go_to(player, nullptr, nullptr, 0, nullptr, 0); });
    attempt("hearth_player_get_info", true, [&] { return hearth_player_get_info(player, &info); });
    attempt("hearth_pack_get_count", true,
            [&] { return hearth_pack_get_count(pack, HEARTH_TABLE_MESHES, &record, nullptr, 0); });
    EXPECT_EQ(hearth_queries_cast_rays(queries, &ray, 1, nullptr, &expected, nullptr, 0), HEARTH_OK);
    EXPECT_EQ(hit.triangle, expected.triangle);
    EXPECT_NE(hit.instance, UINT32_MAX);
    const FaultScope scope;
    EXPECT_EQ(hearth_player_destroy(player), HEARTH_OK);
    EXPECT_EQ(hearth_queries_destroy(queries), HEARTH_OK);
    EXPECT_EQ(hearth_pack_close(pack), HEARTH_OK);
    EXPECT_EQ(heldResources(), before);
    EXPECT_GT(faults_, 30u);
}

} // namespace hearth::test
