// Tests that no light leaves a mark in the stencil, by methods that draw the volumes of lights: it would
// light the pixels of the next ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/statistics/light_statistics_pass.h"
#include "tests/runtime/gpu/lights/stencil_spy.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <numbers>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

constexpr uint32_t kWidth = 160, kHeight = 120;

class LightStencilTest : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        gpu::RendererOptions options = testRendererOptions();
        options.deferred = true;
        auto created = gpu::Renderer::create(spyOnStencil(host().description()), options);
        ASSERT_TRUE(created.ok());
        watched_ = std::move(*created);
    }
    void TearDown() override
    {
        if (watched_ != nullptr)
            endStencilCounts(watched_->device());
        targets_.reset();
        scene_.reset();
        watched_.reset();
        GpuTest::TearDown();
    }

    /// Add ground with rocks: each second one is mirrored, and each third one unlit.
    void addGround()
    {
        const uint32_t stone = test_.addMaterial(plainMaterial());
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(24, 24), stone)), lying({}));
        formats::MaterialRecord glow = plainMaterial();
        glow.flags |= formats::kMaterialUnlit;
        const uint32_t rocks[] = {
            test_.addMesh(withMaterial(shapes::rock(12, 0.3f), stone)),
            test_.addMesh(withMaterial(shapes::rock(12, 0.2f, 2), test_.addMaterial(glow)))};
        for (uint32_t i = 0; i < 9; ++i)
        {
            Affine3 placed =
                translated({static_cast<float>(i % 3) * 5 - 5, 0.6f, static_cast<float>(i / 3) * 5 - 6});
            if (i % 2 == 1)
                placed.m[0][0] = -1;
            test_.addInstance(rocks[i % 3 == 2 ? 1 : 0], placed);
        }
    }

    /// Add a light around a place, from 1 mm to 10 km.
    void addLight(LightType type, float range, float cone, bool is_mirrored)
    {
        LightRecord record = light(type, {0, 1.5f, 0}, {0.3f, -1, 0.1f}, 1 + 0.01f * range * range);
        record.range = range;
        record.outer_cone_rad = cone;
        record.inner_cone_rad = 0.5f * cone;
        for (auto& row : record.world_from_light.m)
            row[0] *= is_mirrored ? -1.0f : 1.0f;
        test_.addLight(record);
        ranges_.push_back(type == LightType::point ? range : 0);
    }

    void load()
    {
        pack_.emplace(test_.build());
        ASSERT_TRUE(host()
                        .run(
                            [&](VkCommandBuffer commands) -> Status
                            {
                                HEARTH_ASSIGN_OR_RETURN(scene_, watched_->upload(*pack_, commands));
                                return success();
                            })
                        .ok());
        scene_->staging.reset();
        auto targets = watched_->createTargets({kWidth, kHeight}, {.light_paths = gpu::kAllLightPaths});
        ASSERT_TRUE(targets.ok());
        targets_.emplace(std::move(*targets));
        beginStencilCounts(watched_->device(), static_cast<uint32_t>(ranges_.size()));
    }

    /// Draw a frame, and return the marks around each of its lights.
    std::vector<StencilMarks> draw(const shared::Camera& camera, gpu::LightMethod method)
    {
        const gpu::FrameInput input{.view = makeView(*scene_, camera, {.width = kWidth, .height = kHeight}),
                                    .shading = {.light_method = method}};
        EXPECT_TRUE(host()
                        .run(
                            [&](VkCommandBuffer commands)
                            {
                                resetStencilCounts(watched_->device(), commands);
                                watched_->record(commands, *scene_, *targets_, input);
                                return success();
                            })
                        .ok());
        return readStencilCounts(watched_->device());
    }

    TestScene test_;
    std::vector<float> ranges_; ///< of lamps; 0: a spot
    std::optional<formats::PackView> pack_;
    std::unique_ptr<gpu::Renderer> watched_;
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::FrameTargets> targets_;
};

} // namespace

TEST_F(LightStencilTest, isZeroBehindEachLightWithTheEyeInOnAndBeforeItsVolume)
{
    addGround();
    for (const float range : {0.001f, 0.5f, 3.0f, 40.0f, 10'000.0f})
    {
        addLight(LightType::point, range, 0, false);
        for (const float share : {0.01f, 0.3f, 0.5f, 0.51f, 0.9f, 1.0f})
            for (const bool is_mirrored : {false, true})
                addLight(LightType::spot, range, 0.5f * share * std::numbers::pi_v<float>, is_mirrored);
    }
    load();
    // within all of them; on the ball of 3 m, and near it; on the axis of the cones, behind and before them
    constexpr Float3 kEyes[] = {{0, 1.5f, 0.001f}, {0, 1.5f, 3},        {0, 1.5f, 3.0001f},
                                {0, 1.5f, 2.9f},   {0.1f, 1.2f, 0.05f}, {-0.6f, 3.5f, -0.2f},
                                {0, 1.5f, 3.9f},   {12, 5, 12}};
    const auto large = std::count_if(ranges_.begin(), ranges_.end(), [](float range) { return range >= 40; });
    for (size_t i = 0; i < gpu::kLightMethodCount; ++i)
    {
        const auto method = static_cast<gpu::LightMethod>(i);
        const gpu::LightMethodFacts& facts = gpu::lightMethodFacts(method);
        if (facts.light_list != shared::kLightListVolumes)
            continue;
        ASSERT_TRUE(watched_->prepareLightMethod(*scene_, method).ok());
        for (const Float3& eye : kEyes)
        {
            const std::vector<StencilMarks> marks = draw({.position = eye, .target = {0.2f, 0, -1}}, method);
            ASSERT_EQ(marks.size(), ranges_.size()) << facts.name;
            for (size_t light = 0; light < marks.size(); ++light)
                EXPECT_FALSE(marks[light].left) << facts.name << ", light " << light << ", eye at " << eye.x
                                                << " " << eye.y << " " << eye.z;
            // the places of lights are those in view, in the order of their slots
            const auto marked = std::count_if(marks.begin(), marks.end(),
                                              [](const StencilMarks& light) { return light.marked; });
            EXPECT_GE(marked, large) << "what the eye sees lies in the volumes of large lamps";
            EXPECT_LE(marked, gpu::readLightCounts(*scene_).ranged);
        }
    }
    EXPECT_EQ(host().messages(), std::vector<std::string>{});
}

} // namespace hearth::test
