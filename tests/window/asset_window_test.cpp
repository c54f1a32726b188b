// Tests choosing an asset on the panel, with the validation layer enabled.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/shading.h"
#include "runtime/viewer/window/viewer.h"
#include "tests/support/sandbox.h"
#include "tests/window/heap_pack.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

class AssetWindow : public ::testing::Test
{
protected:
    void open(const PackModel& model)
    {
        viewer_.reset(); // one at a time
        bytes_ = model.bytes();
        pack_.emplace(makePackView(bytes_));
        viewer::ViewOptions options;
        options.width = 160;
        options.height = 120;
        options.validate = true;
        // maps fit the whole pack, so their texels are not those of one asset's pack
        options.shadows.options.max_maps = 0;
        Result<std::unique_ptr<viewer::Viewer>> viewer = viewer::Viewer::create(options, *pack_);
        ASSERT_TRUE(viewer.ok()) << formatMessage(viewer.error());
        viewer_ = std::move(viewer).value();
        viewer_->settings().panel = false;
        play();
    }

    void play()
    {
        for (int i = 0; i < 4; ++i)
        {
            const Result<bool> drawn = viewer_->step(0);
            ASSERT_TRUE(drawn.ok()) << formatMessage(drawn.error());
        }
    }

    std::string image()
    {
        play();
        EXPECT_TRUE(viewer_->saveScreenshot(folder_ / "a.png").ok());
        EXPECT_EQ(viewer_->host().messages(), std::vector<std::string>());
        return folder_.read("a.png");
    }

    Sandbox folder_;
    AlignedBytes bytes_;
    std::optional<formats::PackView> pack_;
    std::unique_ptr<viewer::Viewer> viewer_;
};

} // namespace

TEST_F(AssetWindow, showsTheChosenOneAloneAndThenAllAgain)
{
    std::vector<std::string> alone;
    for (const size_t i : {0u, 1u})
    {
        PackModel model = heapModel();
        model.instances.erase(model.instances.begin() + static_cast<ptrdiff_t>(1 - i));
        model.assets.clear();
        open(model);
        alone.push_back(image());
    }
    open(heapModel());
    const std::string all = image();
    const shared::Camera start = viewer_->camera().camera();
    for (const size_t i : {0u, 1u, 0u})
    {
        viewer_->settings().asset = i;
        EXPECT_EQ(image(), alone[i]) << i;
        EXPECT_NE(image(), all);
    }
    viewer_->settings().memory_budget = uint64_t{4} << 20; // the scene is reloaded
    EXPECT_EQ(image(), alone[0]);
    viewer_->settings().asset.reset();
    EXPECT_EQ(image(), all);
    EXPECT_EQ(viewer_->camera().camera().position, start.position);
}

} // namespace hearth::test
