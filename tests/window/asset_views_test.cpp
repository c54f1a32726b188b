// Tests the camera's position for each asset, and which instances are hidden. No display is needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/asset_views.h"

#include "runtime/viewer/camera_fit.h"
#include "tests/window/heap_pack.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

constexpr float kAspect = 1.5f;

viewer::AssetViews makeViews(const PackModel& model)
{
    const AlignedBytes bytes = model.bytes();
    const formats::PackView pack = makePackView(bytes);
    return viewer::makeAssetViews(pack, pack::PosePlayer(pack), kAspect);
}

} // namespace

TEST(AssetViews, frameEachAssetAsAPackOfItsOwn)
{
    const viewer::AssetViews views = makeViews(heapModel());
    ASSERT_EQ(views.list.size(), 2u);
    EXPECT_EQ(views.list[0].name, "Lager\xC3\xB6, 4 m");
    EXPECT_EQ(views.list[1].name, "Lag, 1 m");
    for (size_t i = 0; i < 2; ++i)
    {
        PackModel alone = heapModel();
        alone.instances.erase(alone.instances.begin() + static_cast<ptrdiff_t>(1 - i));
        const AlignedBytes bytes = alone.bytes();
        const shared::Camera expected = viewer::fitCamera(makePackView(bytes), kAspect);
        EXPECT_EQ(views.list[i].camera.position, expected.position);
        EXPECT_EQ(views.list[i].camera.target, expected.target);
    }
}

TEST(AssetViews, hideTheOthersWhereTheyStandInOnePlace)
{
    PackModel model = heapModel();
    EXPECT_TRUE(makeViews(model).stage.has_value());
    for (Float3* corner : {&model.assets[1].box_min, &model.assets[1].box_max})
        corner->x += 10;
    const viewer::AssetViews apart = makeViews(model);
    EXPECT_EQ(apart.list.size(), 2u) << "one can go there nevertheless";
    EXPECT_FALSE(apart.stage.has_value());
    model.assets.pop_back();
    EXPECT_TRUE(makeViews(model).list.empty()) << "there is nowhere to go";
}

TEST(AssetViews, theWholeSceneIsAPartOfItsOwn)
{
    EXPECT_EQ(viewer::AssetViews::partIndex(std::nullopt), 0u);
    EXPECT_EQ(viewer::AssetViews::partIndex(0), 1u);
    const viewer::AssetViews views = makeViews(heapModel());
    EXPECT_EQ(views.stage->cameras()[2].position, views.list[1].camera.position);
}

} // namespace hearth::test
