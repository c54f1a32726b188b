// Tests that violations of hearth.h's rules and invalid files are rejected with a message and change nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/c/c_fixture.h"

#include <fstream>
#include <limits>

namespace hearth::test
{

namespace
{

using testing::HasSubstr;
using testing::StartsWith;

std::string writeTemporary(const std::string& name, std::span<const std::byte> bytes)
{
    const std::string path = testing::TempDir() + name;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
}

/// Fixture with a scene and targets.
class CFrameRulesTest : public CApiTest
{
protected:
    void SetUp() override
    {
        CApiTest::SetUp();
        ASSERT_EQ(createTargets(renderer_, 16, 16, &targets_), HEARTH_OK);
    }

    void TearDown() override
    {
        EXPECT_EQ(hearth_renderer_destroy(renderer_), HEARTH_ERROR_IN_USE);
        EXPECT_EQ(hearth_scene_destroy(scene_), HEARTH_OK);
        EXPECT_EQ(hearth_targets_destroy(targets_), HEARTH_OK);
        CApiTest::TearDown();
    }

    hearth_result upload(const hearth_scene_options& options)
    {
        const VkCommandBuffer commands = c_caller_begin(caller_);
        const hearth_result result = hearth_scene_upload(renderer_, pack_, commands, &options, &scene_);
        EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);
        return result;
    }

    /// Message if recording is rejected, else "".
    std::string record(const hearth_frame& frame)
    {
        const VkCommandBuffer commands = c_caller_begin(caller_);
        const hearth_result result = hearth_record_frame(scene_, targets_, commands, &frame);
        EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);
        EXPECT_TRUE(result == HEARTH_OK || result == HEARTH_ERROR_USAGE) << result;
        return result == HEARTH_OK ? "" : hearth_last_error(renderer_);
    }

    hearth_targets* targets_ = nullptr;
    hearth_scene* scene_ = nullptr;
};

} // namespace

TEST_F(CApiTest, aBadPackIsNamedWithWhatToDo)
{
    hearth_pack* pack = nullptr;
    EXPECT_EQ(hearth_pack_open("/nowhere/a.hearth", &pack, message_, sizeof(message_)),
              HEARTH_ERROR_FILE_MISSING);
    EXPECT_THAT(message_, StartsWith("/nowhere/a.hearth: error: "));
    EXPECT_THAT(message_, HasSubstr("hint: check the path"));

    std::vector<std::byte> damaged(bytes_.span().begin(), bytes_.span().end());
    damaged[view_->container().find(formats::kChunkClusters)->offset] ^= std::byte{1};
    const std::string path = writeTemporary("c_api_damaged.hearth", damaged);
    EXPECT_EQ(hearth_pack_open(path.c_str(), &pack, message_, sizeof(message_)), HEARTH_ERROR_FILE_MALFORMED);
    EXPECT_THAT(message_, StartsWith(path));
    EXPECT_THAT(message_, HasSubstr("hint: cook the asset again"));

    char cut[8];
    EXPECT_EQ(hearth_pack_open(path.c_str(), &pack, cut, sizeof(cut)), HEARTH_ERROR_FILE_MALFORMED);
    EXPECT_EQ(std::string(cut), path.substr(0, 7));
    EXPECT_EQ(hearth_pack_open(path.c_str(), &pack, nullptr, 0), HEARTH_ERROR_FILE_MALFORMED);
    EXPECT_EQ(pack, nullptr);
}

TEST_F(CApiTest, opensAFileAndReadsItsPages)
{
    const std::string path = writeTemporary("c_api.hearth", bytes_.span());
    hearth_pack* pack = nullptr;
    ASSERT_EQ(hearth_pack_open(path.c_str(), &pack, message_, sizeof(message_)), HEARTH_OK) << message_;
    const uint32_t size = view_->pages()[1].size;
    std::vector<std::byte> page(size), expected(size);
    EXPECT_EQ(hearth_pack_read_page(pack, 1, page.data(), size, nullptr, 0), HEARTH_OK);
    ASSERT_TRUE(view_->decodePage(1, expected).ok());
    EXPECT_EQ(page, expected);

    EXPECT_EQ(hearth_pack_read_page(pack, 1, page.data(), size - 1, message_, sizeof(message_)),
              HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("destination " + std::to_string(size - 1)));
    EXPECT_EQ(hearth_pack_read_page(pack, 1 << 20, page.data(), size, message_, sizeof(message_)),
              HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("no page 1048576"));
    EXPECT_EQ(hearth_pack_close(pack), HEARTH_OK);
}

TEST_F(CApiTest, aPageThatLiesIsRefusedWhereverItIsRead)
{
    // correct hashes, and a triangle with an invalid vertex index
    const uint32_t bad_page = view_->meshes()[0].pages.first + 1;
    const formats::ClusterRecord& cluster = view_->clusters()[view_->pages()[bad_page].clusters.first];
    const formats::MeshRecord& mesh = view_->meshes()[0];
    PackModel model = test_.model();
    model.decoded_pages.clear();
    for (uint32_t page = 0; page < view_->pages().size(); ++page)
        model.decoded_pages.push_back(view_->decodePage(page).value());
    const uint32_t indices = formats::clusterBytes(formats::clusterVertexLayout(cluster, mesh.attributes),
                                                   cluster.vertex_count, 0);
    ASSERT_LT(cluster.vertex_count, 255);
    model.decoded_pages[bad_page][cluster.page_word * 4 + indices] = std::byte{255};
    model.sealPages();
    const AlignedBytes bytes = model.bytes();
    ASSERT_EQ(hearth_pack_close(pack_), HEARTH_OK);
    pack_ = nullptr;
    ASSERT_EQ(hearth_pack_open_memory(bytes.span().data(), bytes.size(), "liar", &pack_, message_,
                                      sizeof(message_)),
              HEARTH_OK)
        << message_;

    std::vector<std::byte> page(formats::kMaxPageBytes, std::byte{7});
    const std::vector<std::byte> before = page;
    EXPECT_EQ(hearth_pack_read_page(pack_, bad_page, page.data(), page.size(), message_, sizeof(message_)),
              HEARTH_ERROR_FILE_MALFORMED);
    EXPECT_THAT(message_, HasSubstr("triangle 0 names vertex 255"));
    EXPECT_EQ(page, before);
    EXPECT_EQ(hearth_pack_read_page(pack_, 0, page.data(), page.size(), nullptr, 0), HEARTH_OK);
    const std::string why = message_;
    message_[0] = '\0';
    EXPECT_EQ(hearth_pack_check(pack_, message_, sizeof(message_)), HEARTH_ERROR_FILE_MALFORMED);
    EXPECT_EQ(message_, why);

    hearth_scene* scene = nullptr;
    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    const VkCommandBuffer commands = c_caller_begin(caller_);
    EXPECT_EQ(hearth_scene_upload(renderer_, pack_, commands, &options, &scene), HEARTH_ERROR_FILE_MALFORMED);
    EXPECT_EQ(hearth_last_error(renderer_), why);
    EXPECT_EQ(c_caller_discard(caller_), VK_SUCCESS);
    EXPECT_EQ(scene, nullptr);

    // if streamed, the group that the page refines stays coarse
    Reader reader{.pack = pack_, .threads = {}};
    hearth_frame frame = makeFrame();
    frame.error_pixels = 0;
    const c_image image = drawInC(frame, streamedBy(reader));
    EXPECT_EQ(image.streaming.failures, 1u);
    EXPECT_GT(image.counters.drawn_clusters, 0u);
}

TEST_F(CApiTest, aWholePackIsCheckedWhenItIsAskedFor)
{
    EXPECT_EQ(hearth_pack_check(pack_, message_, sizeof(message_)), HEARTH_OK);
    EXPECT_EQ(hearth_pack_check(nullptr, message_, sizeof(message_)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("pack is NULL"));
}

TEST_F(CApiTest, nullArgumentsAreRefused)
{
    hearth_pack* pack = nullptr;
    hearth_renderer* renderer = nullptr;
    hearth_targets* targets = nullptr;
    hearth_scene* scene = nullptr;
    const hearth_renderer_description description = c_caller_description(caller_);
    EXPECT_EQ(hearth_pack_open(nullptr, &pack, message_, sizeof(message_)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, testing::StrEq("hearth_pack_open: error: path or pack is NULL [E1000] "
                                         "hint: see hearth.h"));
    EXPECT_EQ(hearth_pack_open("a", nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_open_memory(nullptr, 1, "a", &pack, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_open_memory(bytes_.span().data() + 8, 8, "a", &pack, nullptr, 0),
              HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_pack_read_page(nullptr, 0, message_, 1, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_renderer_create(nullptr, &renderer, message_, sizeof(message_)), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_, HasSubstr("description is NULL"));
    EXPECT_EQ(hearth_renderer_create(&description, nullptr, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(createTargets(nullptr, 1, 1, &targets), HEARTH_ERROR_USAGE);
    EXPECT_EQ(createTargets(renderer_, 1, 1, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(createTargets(renderer_, 1, 0, &targets), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("width or height is 0"));
    EXPECT_EQ(hearth_targets_get_info(nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_upload(renderer_, nullptr, nullptr, nullptr, &scene), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_release_staging(nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_prepare_lights(nullptr, HEARTH_LIGHTS_ALL), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_get_info(nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_begin_frame(nullptr, 1, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_get_stream_counters(nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_get_shadow_counters(nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_scene_retry_failed(nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_frame(nullptr, nullptr, nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_prefetch(nullptr, nullptr, nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_cull(nullptr, nullptr, nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_visibility(nullptr, nullptr, nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_materials(nullptr, nullptr, nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_targets_get_part_info(nullptr, HEARTH_PART_CULL, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_missing(nullptr, nullptr, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_describe_passes(nullptr, nullptr, nullptr, nullptr, 0, nullptr), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_counters(nullptr, nullptr, VK_NULL_HANDLE, 0), HEARTH_ERROR_USAGE);
    EXPECT_STREQ(hearth_last_error(nullptr), "");
    EXPECT_EQ(hearth_pack_close(nullptr), HEARTH_OK);
    EXPECT_EQ(hearth_renderer_destroy(nullptr), HEARTH_OK);
    EXPECT_EQ(hearth_scene_destroy(nullptr), HEARTH_OK);
    EXPECT_EQ(hearth_targets_destroy(nullptr), HEARTH_OK);
}

TEST_F(CApiTest, otherVersionsAreRefused)
{
    EXPECT_EQ(hearth_api_version(), HEARTH_API_VERSION);
    hearth_renderer* renderer = nullptr;
    hearth_renderer_description description = c_caller_description(caller_);
    description.struct_size += 8;
    EXPECT_EQ(hearth_renderer_create(&description, &renderer, message_, sizeof(message_)),
              HEARTH_ERROR_USAGE);
    EXPECT_THAT(message_,
                HasSubstr("description has a struct_size of " + std::to_string(sizeof(description) + 8)));
    EXPECT_THAT(message_, HasSubstr("compile with the hearth.h of the library"));

    description = c_caller_description(caller_);
    for (const uint32_t version : {0x00020000u, HEARTH_API_VERSION + 1u, 0u})
    {
        description.api_version = version;
        EXPECT_EQ(hearth_renderer_create(&description, &renderer, message_, sizeof(message_)),
                  HEARTH_ERROR_USAGE);
        EXPECT_THAT(message_, HasSubstr("the library is 1.8"));
    }
    description = c_caller_description(caller_);
    description.features = 1u << 31;
    EXPECT_EQ(hearth_renderer_create(&description, &renderer, nullptr, 0), HEARTH_ERROR_USAGE);
    description = c_caller_description(caller_);
    description.frame_way = HEARTH_FRAME_ONE_SET + 1;
    EXPECT_EQ(hearth_renderer_create(&description, &renderer, nullptr, 0), HEARTH_ERROR_USAGE);
    description = c_caller_description(caller_);
    description.device = VK_NULL_HANDLE;
    EXPECT_EQ(hearth_renderer_create(&description, &renderer, nullptr, 0), HEARTH_ERROR_USAGE);
    EXPECT_EQ(renderer, nullptr);
}

TEST_F(CApiTest, everyResultHasAText)
{
    for (hearth_result result = HEARTH_OK; result <= HEARTH_ERROR_OUT_OF_DEVICE_MEMORY; ++result)
        EXPECT_STRNE(hearth_result_string(result), hearth_result_string(-1)) << result;
    EXPECT_STREQ(hearth_result_string(HEARTH_OK), "ok");
    EXPECT_NE(hearth_result_string(12345), nullptr);
}

TEST_F(CFrameRulesTest, framesThatBreakRulesAreRefused)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    ASSERT_EQ(upload(HEARTH_SCENE_OPTIONS_INIT), HEARTH_OK) << hearth_last_error(renderer_);
    const hearth_lod_knot torn[] = {{1, 1}, {2, 4}};
    const hearth_shadow_sphere flat{.center = {0, 0, 0}, .radius = 0, .light = 0, .texels = 0};
    hearth_light_change no_light{};
    no_light.light = 1000;
    hearth_light_change no_type{};
    no_type.type = 4;
    const hearth_emission_scale negative{.box_min = {0, 0, 0}, .box_max = {1, 1, 1}, .factor = -1};
    const hearth_move nowhere{1000, {}};
    const auto refused = [&](const auto& change)
    {
        hearth_frame frame = makeFrame();
        change(frame);
        return record(frame);
    };
    using F = hearth_frame;
    EXPECT_THAT(refused([](F& f) { f.struct_size = 4; }), HasSubstr("frame has a struct_size of 4"));
    EXPECT_THAT(refused([](F& f) { f.camera.position[1] = kNan; }), HasSubstr("not finite"));
    EXPECT_THAT(refused([](F& f) { f.camera.y_fov_rad = 3.2f; }), HasSubstr("y_fov_rad"));
    EXPECT_THAT(refused([](F& f) { f.camera.y_fov_rad = 0; }), HasSubstr("half_height"));
    EXPECT_THAT(refused([](F& f) { f.camera.y_fov_rad = 0, f.half_height = 1, f.z_far = f.camera.z_near; }),
                HasSubstr("z_far"));
    EXPECT_THAT(refused(
                    [&](F& f)
                    {
                        f.camera.y_fov_rad = 0, f.half_height = 1, f.z_far = 9;
                        f.lod_knots = torn, f.lod_knot_count = 1;
                    }),
                HasSubstr("no lod_knots"));
    EXPECT_THAT(refused([](F& f) { f.shift[1] = std::nanf(""); }), HasSubstr("shift"));
    EXPECT_THAT(refused([](F& f) { f.camera.z_near = 0; }), HasSubstr("z_near"));
    EXPECT_THAT(refused([](F& f) { f.error_pixels = -1; }), HasSubstr("error_pixels"));
    EXPECT_THAT(refused([](F& f) { f.depth_scale = kNan; }), HasSubstr("depth_scale"));
    EXPECT_THAT(refused([](F& f) { f.cull_flags = 16; }), HasSubstr("cull_flags"));
    EXPECT_THAT(refused([](F& f) { f.debug_view = 22; }), HasSubstr("debug_view"));
    EXPECT_THAT(refused([](F& f) { f.debug_view = HEARTH_VIEW_GI; }), HasSubstr("has bricks"));
    EXPECT_THAT(refused([](F& f) { f.constant_sky = 2; }), HasSubstr("constant_sky"));
    EXPECT_THAT(refused([](F& f) { f.light_lists = 2; }), HasSubstr("light_lists"));
    EXPECT_THAT(refused([](F& f) { f.light_method = 99; }), HasSubstr("light_method"));
    EXPECT_THAT(refused([](F& f) { f.light_method = HEARTH_LIGHTS_ALL; }), HasSubstr("prepare_lights"));
    EXPECT_THAT(refused([](F& f) { f.exposure_stops = kNan; }), HasSubstr("exposure_stops"));
    EXPECT_THAT(refused([](F& f) { f.exposure_stops = 1; }), HasSubstr("HEARTH_FEATURE_GRADING"));
    EXPECT_THAT(refused([](F& f) { f.exposure_key = 0; }), HasSubstr("exposure_key"));
    EXPECT_THAT(refused([](F& f) { f.automatic_exposure = 2; }), HasSubstr("automatic_exposure"));
    EXPECT_THAT(refused([](F& f) { f.automatic_exposure = 1; }), HasSubstr("HEARTH_TARGETS_BLOOM"));
    EXPECT_THAT(refused([](F& f) { f.filter_density = 2; }), HasSubstr("filter_density"));
    EXPECT_THAT(refused([](F& f) { f.bloom_mode = 2; }), HasSubstr("bloom_mode"));
    EXPECT_THAT(refused([](F& f) { f.bloom_strength = 0.1f; }), HasSubstr("HEARTH_TARGETS_BLOOM"));
    EXPECT_THAT(refused([](F& f) { f.ambient_occlusion = 4; }), HasSubstr("ambient_occlusion"));
    EXPECT_THAT(refused([](F& f) { f.specular_occlusion = 3; }), HasSubstr("specular_occlusion"));
    EXPECT_THAT(refused([](F& f) { f.debug_view = HEARTH_VIEW_SHADOW_MAPS; }), HasSubstr("with shadows"));
    EXPECT_THAT(refused([](F& f) { f.shaded_area = 3; }), HasSubstr("shaded_area"));
    EXPECT_THAT(refused([](F& f) { f.move_count = 1; }), HasSubstr("moves is NULL"));
    EXPECT_THAT(refused([](F& f) { f.pose_count = 1; }), HasSubstr("poses is NULL"));
    EXPECT_THAT(refused([](F& f) { f.shadow_sphere_count = 1; }), HasSubstr("shadow_spheres is NULL"));
    EXPECT_THAT(refused([](F& f) { f.light_count = 1; }), HasSubstr("lights is NULL"));
    EXPECT_THAT(refused([&](F& f) { f.lights = &no_light, f.light_count = 1; }), HasSubstr("light 1000"));
    EXPECT_THAT(refused([&](F& f) { f.lights = &no_type, f.light_count = 1; }), HasSubstr("type"));
    EXPECT_THAT(refused([](F& f) { f.lamp_weight_count = 1; }), HasSubstr("lamp_weights is NULL"));
    for (const auto& [weight, mention] : std::initializer_list<std::pair<hearth_lamp_weight, const char*>>{
             {{0, 0, {1, 1, 1}}, "lamp weight 0"},
             {{HEARTH_LAMP_LIGHT, 1000, {1, 1, 1}}, "light 1000"},
             {{HEARTH_LAMP_LIGHT, 0, {1, -1, 1}}, "negative"},
             {{HEARTH_LAMP_EMISSION, 0, {1, 1, 1}}, "no receivers"}})
        EXPECT_THAT(refused([&](F& f) { f.lamp_weights = &weight, f.lamp_weight_count = 1; }),
                    HasSubstr(mention));
    for (const auto& [daylight, mention] :
         std::initializer_list<std::pair<hearth_daylight, const char*>>{{{-1, 0, 3, 0}, "elevation"},
                                                                        {{45, NAN, 3, 0}, "azimuth"},
                                                                        {{45, 0, 1, 0}, "turbidity"},
                                                                        {{45, 0, 3, 1}, "reserved"}})
        EXPECT_THAT(refused([&](F& f) { f.daylight = &daylight; }), HasSubstr(mention));
    EXPECT_THAT(refused([](F& f) { f.color_image = 1; }), HasSubstr("color_image"));
    EXPECT_THAT(refused([](F& f) { f.emission_count = 1; }), HasSubstr("emissions is NULL"));
    EXPECT_THAT(refused([&](F& f) { f.emissions = &negative, f.emission_count = 1; }),
                HasSubstr("emission 0"));
    EXPECT_THAT(refused([&](F& f) { f.emissions = &negative, f.emission_count = 9; }), HasSubstr("above 8"));
    EXPECT_THAT(refused([&](F& f) { f.shadow_spheres = &flat, f.shadow_sphere_count = 1; }),
                HasSubstr("shadow sphere 0"));
    EXPECT_THAT(refused([](F& f) { f.lod_knot_count = 1; }), HasSubstr("lod_knots is NULL"));
    EXPECT_THAT(refused([&](F& f) { f.lod_knots = torn, f.lod_knot_count = 9; }), HasSubstr("above 8"));
    EXPECT_THAT(refused([&](F& f) { f.lod_knots = torn, f.lod_knot_count = 2; }),
                HasSubstr("knot 2 grows faster than the distance"));
    EXPECT_THAT(refused([&](F& f) { f.moves = &nowhere, f.move_count = 1; }),
                StartsWith("hearth_record_frame|instance 1000: error: there are 6"));
    EXPECT_EQ(refused([](F&) {}), "");
}

TEST_F(CFrameRulesTest, aSceneWithoutABudgetDoesNotStream)
{
    ASSERT_EQ(upload(HEARTH_SCENE_OPTIONS_INIT), HEARTH_OK) << hearth_last_error(renderer_);
    hearth_stream_counters counters = HEARTH_STREAM_COUNTERS_INIT;
    const hearth_frame frame = makeFrame();
    EXPECT_EQ(hearth_scene_begin_frame(scene_, 1, 0), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("no memory_budget"));
    EXPECT_EQ(hearth_scene_get_stream_counters(scene_, &counters), HEARTH_ERROR_USAGE);
    hearth_shadow_counters shadows = HEARTH_SHADOW_COUNTERS_INIT;
    EXPECT_EQ(hearth_scene_get_shadow_counters(scene_, &shadows), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("no shadows"));
    EXPECT_EQ(hearth_scene_retry_failed(scene_), HEARTH_ERROR_USAGE);
    const VkCommandBuffer commands = c_caller_begin(caller_);
    EXPECT_EQ(hearth_record_prefetch(scene_, targets_, commands, &frame), HEARTH_ERROR_USAGE);
    EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);
}

TEST_F(CFrameRulesTest, shadowCountersHaveTheBitsOfDepths)
{
    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    options.shadows.max_maps = 4;
    options.shadows.depth_bits = 16;
    // with splits within 2 cm texels are finer than steps of 16 bits
    for (const float split_far : {100.0f, 0.02f})
    {
        options.shadows.split_near = 0.01f;
        options.shadows.split_far = split_far;
        ASSERT_EQ(upload(options), HEARTH_OK) << hearth_last_error(renderer_);
        hearth_shadow_counters counters = HEARTH_SHADOW_COUNTERS_INIT;
        EXPECT_EQ(hearth_scene_get_shadow_counters(scene_, &counters), HEARTH_OK);
        EXPECT_EQ(counters.depth_bits, split_far == 100 ? 16u : 32u);
        EXPECT_EQ(hearth_scene_destroy(scene_), HEARTH_OK);
        scene_ = nullptr;
    }
}

TEST_F(CFrameRulesTest, missingClustersAreCountedForTargetsThatAskForIt)
{
    const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    ASSERT_EQ(upload(options), HEARTH_OK) << hearth_last_error(renderer_);
    hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
    description.width = description.height = 16;
    description.occlusion = HEARTH_OCCLUSION_LAST_FRAME;
    description.flags = HEARTH_TARGETS_COUNT_MISSING;
    hearth_targets* counting = nullptr;
    ASSERT_EQ(hearth_targets_create(renderer_, &description, &counting), HEARTH_OK);
    hearth_frame frame = makeFrame();
    frame.occlusion = HEARTH_OCCLUSION_LAST_FRAME;
    for (hearth_targets* targets : {targets_, counting})
    {
        const VkCommandBuffer commands = c_caller_begin(caller_);
        EXPECT_EQ(hearth_record_missing(scene_, targets, commands), HEARTH_ERROR_USAGE);
        EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("no whole frame"));
        EXPECT_EQ(hearth_record_frame(scene_, targets, commands, &frame), HEARTH_OK)
            << hearth_last_error(renderer_);
        const bool counts = targets == counting;
        EXPECT_EQ(hearth_record_missing(scene_, targets, commands), counts ? HEARTH_OK : HEARTH_ERROR_USAGE);
        if (!counts)
        {
            EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("HEARTH_TARGETS_COUNT_MISSING"));
        }
        EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    }
    EXPECT_EQ(hearth_targets_destroy(counting), HEARTH_OK);
}

TEST_F(CFrameRulesTest, framesOfAStreamedSceneComeInOrder)
{
    Reader reader{.pack = pack_, .threads = {}};
    ASSERT_EQ(upload(streamedBy(reader)), HEARTH_OK) << hearth_last_error(renderer_);
    const auto refused = [&](uint64_t serial, uint64_t completed_serial) -> std::string
    {
        const hearth_result result = hearth_scene_begin_frame(scene_, serial, completed_serial);
        return result == HEARTH_OK ? "" : hearth_last_error(renderer_);
    };
    EXPECT_THAT(record(makeFrame()), HasSubstr("begins with hearth_scene_begin_frame"));
    EXPECT_THAT(refused(0, 0), HasSubstr("serial 0 is not above 0"));
    EXPECT_THAT(refused(5, 5), HasSubstr("completed_serial 5 is not below serial 5"));
    EXPECT_EQ(refused(5, 3), "");
    EXPECT_THAT(refused(6, 3), HasSubstr("frame 5 has not been recorded"));
    EXPECT_EQ(record(makeFrame()), "");
    EXPECT_THAT(record(makeFrame()), HasSubstr("begins with hearth_scene_begin_frame"));
    EXPECT_THAT(refused(5, 4), HasSubstr("serial 5 is not above 5"));
    EXPECT_THAT(refused(6, 2), HasSubstr("completed_serial fell from 3 to 2"));
    EXPECT_EQ(refused(6, 5), "");
}

TEST_F(CFrameRulesTest, sceneOptionsThatBreakRulesAreRefused)
{
    Reader reader{.pack = pack_, .threads = {}};
    const auto refused = [&](const auto& change) -> std::string
    {
        hearth_scene_options options = streamedBy(reader);
        change(options);
        return upload(options) == HEARTH_OK ? "" : hearth_last_error(renderer_);
    };
    using O = hearth_scene_options;
    EXPECT_THAT(refused([](O& o) { o.struct_size = 0; }), HasSubstr("options has a struct_size of 0"));
    EXPECT_THAT(refused([](O& o) { o.max_visible_clusters = 0; }), HasSubstr("max_visible_clusters"));
    EXPECT_THAT(refused([](O& o) { o.read = nullptr; }), HasSubstr("read callback"));
    EXPECT_THAT(refused([](O& o) { o.max_loads = 0; }), HasSubstr("max_loads"));
    EXPECT_THAT(refused([](O& o) { o.frames_in_flight = 17; }), HasSubstr("frames_in_flight"));
    const auto shadows = [&](const auto& change)
    {
        return refused(
            [&](O& o)
            {
                o.shadows.max_maps = 4;
                change(o.shadows);
            });
    };
    using S = hearth_shadow_options;
    EXPECT_THAT(shadows([](S& s) { s.max_maps = 65; }), HasSubstr("shadows.max_maps"));
    EXPECT_THAT(shadows([](S& s) { s.texels = 1000; }), HasSubstr("shadows.texels"));
    EXPECT_THAT(shadows([](S& s) { s.kernel = 4; }), HasSubstr("shadows.kernel"));
    EXPECT_THAT(shadows([](S& s) { s.splits = 9; }), HasSubstr("shadows.splits"));
    EXPECT_THAT(shadows([](S& s) { s.error_bias = 0.5f; }), HasSubstr("shadows.error_bias"));
    EXPECT_THAT(shadows([](S& s) { s.split_far = s.split_near; }), HasSubstr("shadows.split_near"));
    EXPECT_THAT(shadows([](S& s) { s.split_blend = 2; }), HasSubstr("shadows.split_blend"));
    EXPECT_THAT(shadows([](S& s) { s.spot_near = 0; }), HasSubstr("shadows.spot_near"));
    EXPECT_THAT(shadows([](S& s) { s.moving_layers = 2; }), HasSubstr("shadows.moving_layers"));
    EXPECT_THAT(shadows([](S& s) { s.depth_bits = 24; }), HasSubstr("shadows.depth_bits"));
    EXPECT_THAT(shadows([](S& s) { s.casters = 2; }), HasSubstr("shadows.casters"));
    EXPECT_EQ(scene_, nullptr);
    EXPECT_EQ(upload(streamedBy(reader, 16)), HEARTH_ERROR_STREAMING_BUDGET);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("[E4006] hint: raise the budget"));
}

TEST_F(CFrameRulesTest, whatIsUsedCannotBeDestroyed)
{
    ASSERT_EQ(upload(HEARTH_SCENE_OPTIONS_INIT), HEARTH_OK) << hearth_last_error(renderer_);
    EXPECT_EQ(hearth_pack_close(pack_), HEARTH_ERROR_IN_USE);
    EXPECT_STREQ(hearth_pack_last_error(pack_), "hearth_pack_close: error: 1 scene is alive [E1000] "
                                                "hint: destroy it before the pack");
    hearth_player* player = nullptr;
    ASSERT_EQ(hearth_player_create(pack_, &player, nullptr, 0), HEARTH_OK);
    EXPECT_EQ(hearth_pack_close(pack_), HEARTH_ERROR_IN_USE);
    EXPECT_THAT(hearth_pack_last_error(pack_), HasSubstr("1 scene and 1 player are alive [E1000] "
                                                         "hint: destroy them before the pack"));
    EXPECT_EQ(hearth_player_destroy(player), HEARTH_OK);
    EXPECT_EQ(hearth_renderer_destroy(renderer_), HEARTH_ERROR_IN_USE);
    EXPECT_THAT(hearth_last_error(renderer_),
                HasSubstr("hearth_renderer_destroy: error: 1 scene and 1 set of "
                          "targets are alive [E1000] hint: destroy them before "
                          "the renderer"));
    hearth_targets* targets = nullptr;
    EXPECT_EQ(createTargets(renderer_, 1u << 20, 16, &targets), HEARTH_ERROR_DEVICE_LIMIT);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("1048576x16"));
    EXPECT_EQ(targets, nullptr);
    EXPECT_EQ(record(makeFrame()), "") << "the renderer is as it was";
}

TEST_F(CFrameRulesTest, targetsBelongToTheFirstSceneUntilItIsDestroyed)
{
    Reader reader{.pack = pack_, .threads = {}};
    hearth_scene* second = nullptr;
    ASSERT_EQ(upload(HEARTH_SCENE_OPTIONS_INIT), HEARTH_OK) << hearth_last_error(renderer_);
    std::swap(scene_, second);
    ASSERT_EQ(upload(streamedBy(reader)), HEARTH_OK) << hearth_last_error(renderer_);
    std::swap(scene_, second);
    EXPECT_EQ(record(makeFrame()), "");
    EXPECT_EQ(record(makeFrame()), "") << "an image may be drawn again";

    const hearth_frame frame = makeFrame();
    ASSERT_EQ(hearth_scene_begin_frame(second, 1, 0), HEARTH_OK);
    VkCommandBuffer commands = c_caller_begin(caller_);
    EXPECT_EQ(hearth_record_frame(second, targets_, commands, &frame), HEARTH_ERROR_USAGE);
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("the targets belong to another scene"));
    EXPECT_THAT(hearth_last_error(renderer_), HasSubstr("create targets for each scene"));
    EXPECT_EQ(hearth_record_cull(second, targets_, commands, &frame), HEARTH_ERROR_USAGE);
    EXPECT_EQ(hearth_record_prefetch(second, targets_, commands, &frame), HEARTH_OK) << "it draws nothing";
    EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);
    EXPECT_EQ(record(makeFrame()), "") << "they are still the first scene's";

    ASSERT_EQ(hearth_scene_destroy(scene_), HEARTH_OK);
    scene_ = second;
    ASSERT_EQ(hearth_scene_begin_frame(scene_, 2, 1), HEARTH_OK);
    EXPECT_EQ(record(makeFrame()), "");
}

} // namespace hearth::test
