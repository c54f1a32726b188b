// Tests hearth.hpp: handles can be moved, and destroy what they own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/hearth.hpp"
#include "tests/runtime/c/c_fixture.h"

#include <type_traits>

namespace hearth::test
{

namespace
{

static_assert(std::is_nothrow_move_constructible_v<Scene> && std::is_nothrow_move_assignable_v<Scene>);
static_assert(!std::is_copy_constructible_v<Pack> && !std::is_copy_assignable_v<Renderer>);
static_assert(sizeof(Targets) == sizeof(hearth_targets*));

using CWrapperTest = CApiTest;

} // namespace

TEST_F(CWrapperTest, messagesAreStrings)
{
    Pack pack;
    std::string message;
    EXPECT_EQ(Pack::open("/nowhere/a.hearth", pack, &message), HEARTH_ERROR_FILE_MISSING);
    EXPECT_THAT(message, testing::StartsWith("/nowhere/a.hearth: error: "));
    EXPECT_FALSE(pack);
    Renderer renderer;
    hearth_renderer_description description = c_caller_description(caller_);
    description.api_version = 0;
    EXPECT_EQ(Renderer::create(description, renderer, &message), HEARTH_ERROR_USAGE);
    EXPECT_THAT(message, testing::HasSubstr("the library is 1.8"));
}

TEST_F(CWrapperTest, handlesMove)
{
    Pack pack;
    ASSERT_EQ(Pack::openMemory(bytes_.span().data(), bytes_.size(), "test", pack), HEARTH_OK);
    hearth_pack* const handle = pack.get();
    Pack moved(std::move(pack));
    EXPECT_EQ(moved.get(), handle);
    EXPECT_FALSE(pack); // NOLINT(bugprone-use-after-move): a moved-from handle is empty
    pack = std::move(moved);
    EXPECT_EQ(pack.get(), handle);
    Pack& same = pack;
    pack = std::move(same);
    EXPECT_EQ(pack.get(), handle);
    EXPECT_EQ(pack.release(), handle);
    EXPECT_EQ(hearth_pack_close(handle), HEARTH_OK);
}

TEST_F(CWrapperTest, drawsAndDestroysInOrder)
{
    Renderer renderer;
    ASSERT_EQ(Renderer::create(c_caller_description(caller_), renderer), HEARTH_OK);
    Targets targets;
    hearth_targets_description size = HEARTH_TARGETS_DESCRIPTION_INIT;
    size.width = 64;
    size.height = 48;
    size.flags = HEARTH_TARGETS_KEEP_VISIBILITY;
    ASSERT_EQ(Targets::create(renderer, size, targets), HEARTH_OK);
    hearth_targets_info images = HEARTH_TARGETS_INFO_INIT;
    EXPECT_EQ(targets.getInfo(images), HEARTH_OK);
    EXPECT_EQ(images.color.format, VK_FORMAT_R8G8B8A8_SRGB);
    EXPECT_EQ(images.visibility.format, VK_FORMAT_R32_UINT);
    EXPECT_EQ(images.color.after.layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    EXPECT_EQ(images.width, 64u);

    Scene scene;
    const hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    ASSERT_EQ(Scene::upload(renderer, Pack(), c_caller_begin(caller_), options, scene), HEARTH_ERROR_USAGE);
    EXPECT_THAT(renderer.lastError(), testing::HasSubstr("pack, commands or scene is NULL"));
    EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);

    Pack pack;
    ASSERT_EQ(Pack::openMemory(bytes_.span().data(), bytes_.size(), "test", pack), HEARTH_OK);
    for (int i = 0; i < 2; ++i) // the second replaces the first
    {
        ASSERT_EQ(Scene::upload(renderer, pack, c_caller_begin(caller_), options, scene), HEARTH_OK);
        ASSERT_EQ(c_caller_submit(caller_), VK_SUCCESS);
        EXPECT_EQ(scene.releaseStaging(), HEARTH_OK);
    }
    hearth_scene_info info = HEARTH_SCENE_INFO_INIT;
    EXPECT_EQ(scene.getInfo(info), HEARTH_OK);
    EXPECT_EQ(info.instance_count, 6u);
    EXPECT_LT(info.box_min[0], info.box_max[0]);
    EXPECT_GT(info.allocated_bytes, 0u);
    VkCommandBuffer commands = c_caller_begin(caller_);
    EXPECT_EQ(scene.record(targets, commands, makeFrame()), HEARTH_OK);
    EXPECT_EQ(scene.recordCull(targets, commands, makeFrame()), HEARTH_OK);
    EXPECT_EQ(scene.recordVisibility(targets, commands, makeFrame()), HEARTH_OK);
    EXPECT_EQ(scene.recordMaterials(targets, commands, makeFrame()), HEARTH_OK);
    EXPECT_EQ(c_caller_submit(caller_), VK_SUCCESS);

    scene.reset();
    EXPECT_EQ(hearth_pack_close(pack.release()), HEARTH_OK) << "the scene is gone";
}

} // namespace hearth::test
