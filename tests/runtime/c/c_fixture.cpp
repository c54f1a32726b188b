// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/c/c_fixture.h"

#include "tests/runtime/scene_proxies.h"
#include "tests/support/shapes.h"

namespace hearth::test
{

namespace
{

void fillScene(TestScene& scene)
{
    std::mt19937 random(57);
    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = formats::kMaterialDoubleSided;
    const uint32_t plain = scene.addMaterial(plainMaterial());
    const uint32_t sheet = scene.addMaterial(two_sided);
    const uint32_t meshes[] = {scene.addMesh(withMaterial(shapes::rock(48, 0.3f), plain)),
                               scene.addMesh(withMaterial(shapes::terrain(64), sheet))};
    addProxy(scene.model(), meshes[0], shapes::rock(6, 0), 0.4f, true);
    scene.addInstance(meshes[0], Affine3{});
    for (size_t i = 1; i < 6; ++i)
        scene.addInstance(meshes[i % 2], randomAffine(random, 3));
}

} // namespace

hearth_result createTargets(hearth_renderer* renderer, uint32_t width, uint32_t height,
                            hearth_targets** targets)
{
    hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
    description.width = width;
    description.height = height;
    description.flags = HEARTH_TARGETS_KEEP_VISIBILITY;
    return hearth_targets_create(renderer, &description, targets);
}

hearth_frame makeFrame()
{
    hearth_frame frame = HEARTH_FRAME_INIT;
    frame.camera = {{4, 2, 5}, {0, 0, 0}, {0, 1, 0}, 0.9f, 0.05f};
    return frame;
}

void Reader::read(void* user, uint32_t page, void* destination, size_t size, hearth_page_read done)
{
    auto& reader = *static_cast<Reader*>(user);
    reader.threads.emplace_back(
        [&reader, page, destination, size, done]
        {
            const bool ok = page != reader.bad_page && hearth_pack_read_page(reader.pack, page, destination,
                                                                             size, nullptr, 0) == HEARTH_OK;
            hearth_read_done(done, ok ? 1 : 0);
        });
}

Reader::~Reader()
{
    for (std::thread& thread : threads)
        thread.join();
}

hearth_scene_options streamedBy(Reader& reader, uint64_t budget_bytes)
{
    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    options.memory_budget = budget_bytes;
    options.read = Reader::read;
    options.read_user = &reader;
    return options;
}

void CApiTest::SetUp()
{
    GpuTest::SetUp();
    fillScene(test_);
    view_.emplace(test_.build());
    bytes_ = test_.model().bytes();
    ASSERT_EQ(hearth_pack_open_memory(bytes_.span().data(), bytes_.size(), "test", &pack_, message_,
                                      sizeof(message_)),
              HEARTH_OK)
        << message_;
    caller_ = c_caller_create(host().deviceName().c_str());
    ASSERT_NE(caller_, nullptr);
    hearth_renderer_description description = c_caller_description(caller_);
    description.features = HEARTH_FEATURE_OVERDRAW;
    recreateRenderer(description);
}

void CApiTest::recreateRenderer(const hearth_renderer_description& description)
{
    ASSERT_EQ(hearth_renderer_destroy(renderer_), HEARTH_OK);
    renderer_ = nullptr;
    ASSERT_EQ(hearth_renderer_create(&description, &renderer_, message_, sizeof(message_)), HEARTH_OK)
        << message_;
}

void CApiTest::TearDown()
{
    EXPECT_EQ(hearth_renderer_destroy(renderer_), HEARTH_OK);
    EXPECT_EQ(hearth_pack_close(pack_), HEARTH_OK);
    if (caller_ != nullptr)
    {
        EXPECT_EQ(c_caller_message_count(caller_), 0u) << c_caller_message(caller_);
    }
    c_caller_destroy(caller_);
    GpuTest::TearDown();
}

c_image CApiTest::drawInC(const hearth_frame& frame, const hearth_scene_options& options)
{
    color_.assign(kWidth * kHeight, 0);
    visibility_.assign(kWidth * kHeight, 0);
    c_image image{};
    image.scene = options;
    image.frame = frame;
    image.width = kWidth;
    image.height = kHeight;
    image.in_parts = in_parts_ ? 1 : 0;
    image.colors = colors_.empty() ? nullptr : colors_.data();
    image.color_count = static_cast<uint32_t>(colors_.size());
    image.color = color_.data();
    image.visibility = visibility_.data();
    EXPECT_EQ(c_caller_draw(caller_, renderer_, pack_, &image), HEARTH_OK) << hearth_last_error(renderer_);
    return image;
}

Image CApiTest::drawInCpp(DrawOptions options)
{
    options.width = kWidth;
    options.height = kHeight;
    const std::unique_ptr<gpu::Scene> scene = upload(*view_, {.shadows = shadows_});
    std::vector<gpu::InstanceMove> moves;
    if (moved_)
    {
        const auto move = gpu::moveInstance(*scene, 0, *moved_);
        HEARTH_ASSERT(move.ok());
        moves.push_back(*move);
    }
    options.moves = moves;
    shared::Camera camera = kCamera;
    camera.shift = shift_;
    return draw(*scene, camera, options);
}

void CApiTest::expectEqual(const c_image& c, const Image& cpp) const
{
    EXPECT_EQ(color_, cpp.color);
    EXPECT_EQ(visibility_, cpp.visibility);
    EXPECT_EQ(c.counters.drawn_clusters, cpp.list.counters.drawn_clusters);
    EXPECT_EQ(c.counters.early_clusters, cpp.list.counters.early_clusters);
    EXPECT_EQ(c.counters.dropped_clusters, 0u);
    EXPECT_GT(c.counters.drawn_clusters, 0u);
}

} // namespace hearth::test
