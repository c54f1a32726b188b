// Tests the temporal filter: what rests converges to the mean of many samples, a cut shows the frame as it
// is, what moves leaves no trail, and equal frames give equal bytes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/temporal/motion_pass.h"
#include "runtime/gpu/temporal/temporal_pass.h"
#include "runtime/viewer/sample_sum.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr uint32_t kSide = 96;
using Bytes = std::vector<std::byte>;

/// Root of the mean square of the channels' differences, of 255.
double differ(const Bytes& a, const Bytes& b)
{
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += std::pow(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i]), 2);
    return std::sqrt(sum / (0.75 * static_cast<double>(a.size())));
}

/// Thin wires and a card before a ground with squares of two colours.
class TemporalFilterTest : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        if (IsSkipped())
            return;
        auto dark = plainMaterial(), light = plainMaterial();
        dark.base_color = {0.1f, 0.1f, 0.1f, 1};
        light.base_color = {0.8f, 0.5f, 0.2f, 1};
        const uint32_t materials[] = {test_.addMaterial(dark), test_.addMaterial(light)};
        const uint32_t card = test_.addMesh(withMaterial(makeQuad(1, 1), materials[1]));
        const uint32_t wire = test_.addMesh(withMaterial(makeQuad(6, 0.01f), materials[0]));
        const uint32_t tiles[] = {test_.addMesh(withMaterial(makeQuad(0.5f, 0.5f), materials[0])),
                                  test_.addMesh(withMaterial(makeQuad(0.5f, 0.5f), materials[1]))};
        test_.addInstance(card, translated({-1, 0.5f, 0.5f}));
        for (int i = 0; i < 6; ++i)
            test_.addInstance(wire, turned(0.1f + 0.05f * static_cast<float>(i), {0, 0.2f * i - 0.5f, 0.2f}));
        for (int y = -4; y < 4; ++y)
            for (int x = -6; x < 6; ++x)
                test_.addInstance(tiles[(x + y) & 1], translated({0.5f * static_cast<float>(x),
                                                                  0.5f * static_cast<float>(y), 0}));
        view_.emplace(test_.build());
        scene_ = upload(*view_, {.keeps_motion = true});
        auto motion = gpu::MotionPass::create(renderer().device(), renderer().layouts(), *scene_);
        auto filter = gpu::TemporalPass::create(renderer().device(), renderer().layouts());
        ASSERT_TRUE(motion.ok() && filter.ok());
        motion_.emplace(std::move(*motion));
        filter_.emplace(std::move(*filter));
    }

    static Affine3 turned(float angle_rad, Float3 place)
    {
        const float c = std::cos(angle_rad), s = std::sin(angle_rad);
        return {{{c, -s, 0, place.x}, {s, c, 0, place.y}, {0, 0, 1, place.z}}};
    }

    gpu::FrameTargets makeFilterTargets()
    {
        auto targets = renderer().createTargets({kSide, kSide}, {.has_temporal_filter = true});
        HEARTH_ASSERT(targets.ok());
        return std::move(*targets);
    }

    /// Draw a frame without the filter.
    Bytes drawPlain(gpu::FrameTargets& targets, const Camera& camera)
    {
        const auto move = gpu::moveInstance(*scene_, 0, card_);
        HEARTH_ASSERT(move.ok());
        const DrawOptions options{.width = kSide, .height = kSide, .moves = {&*move, 1}};
        (void)draw(*scene_, targets, camera, options);
        auto pixels = host().read(renderer().device(), targets.color(), 4);
        HEARTH_ASSERT(pixels.ok());
        return std::move(*pixels);
    }

    /// Draw the next frame and filter it.
    Bytes drawFiltered(gpu::FrameTargets& targets, const Camera& camera, uint32_t number, bool resets = false)
    {
        Camera shifted = camera;
        shifted.shift = gpu::jitterShift(number, {kSide, kSide});
        (void)drawPlain(targets, shifted);
        const Status status = host().run(
            [&](VkCommandBuffer commands)
            {
                motion_->record(renderer().device(), commands, *scene_, targets);
                filter_->record(renderer().device(), commands, targets, resets);
                return success();
            });
        HEARTH_ASSERT(status.ok());
        auto pixels = host().read(renderer().device(), targets.temporal().filtered(), 4);
        HEARTH_ASSERT(pixels.ok());
        return std::move(*pixels);
    }

    /// Mean of 64 samples of each pixel, on a grid.
    Bytes drawSamples(const Camera& camera)
    {
        gpu::FrameTargets targets = makeTargets(kSide, kSide);
        viewer::SampleSum sum(kSide, kSide, 1);
        for (uint32_t frame = 0; frame < 64; ++frame)
            sum.add(drawPlain(targets, viewer::shiftCamera(camera, frame, 64, kSide, kSide)));
        return sum.average();
    }

    /// Mean difference of the channels in pixels that the card has left: up to 24 behind it.
    double differInTrail(const Bytes& a, const Bytes& b) const
    {
        const double focal = kSide / 2.0 / std::tan(0.4), distance = 3.5;
        const auto edge =
            static_cast<uint32_t>(kSide / 2.0 + (double{card_.m[0][3]} - 0.5) * focal / distance);
        double sum = 0;
        for (uint32_t y = kSide / 4; y < kSide * 3 / 8; ++y)
            for (uint32_t i = 4 * (y * kSide + edge - 26); i < 4 * (y * kSide + edge - 2); ++i)
                sum += std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i]));
        return sum / (3.0 * 24 * kSide / 8);
    }

    TestScene test_;
    std::optional<formats::PackView> view_;
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::MotionPass> motion_;
    std::optional<gpu::TemporalPass> filter_;
    Affine3 card_ = translated({-1, 0.5f, 0.5f});
    const Camera camera_{.position = {0, 0, 4}, .target = {0, 0, 0}, .y_fov_rad = 0.8f, .z_near = 0.05f};
};

} // namespace

TEST_F(TemporalFilterTest, whatRestsConvergesAndDoesNotFlicker)
{
    gpu::FrameTargets targets = makeFilterTargets(), again = makeFilterTargets();
    const Bytes expected = drawSamples(camera_);
    const double one = differ(drawPlain(targets, camera_), expected);
    Bytes last;
    for (uint32_t frame = 0; frame < gpu::kJitterFrames; ++frame)
        last = drawFiltered(targets, camera_, frame);
    const double filtered = differ(last, expected);
    RecordProperty("one_sample", std::to_string(one));
    RecordProperty("filtered", std::to_string(filtered));
    EXPECT_LT(filtered, one / 4);
    double flicker = 0;
    for (uint32_t frame = 0; frame < 8; ++frame)
    {
        const Bytes next = drawFiltered(targets, camera_, gpu::kJitterFrames + frame);
        flicker = std::max(flicker, differ(next, last));
        last = next;
    }
    EXPECT_LT(flicker, one / 10);
    Bytes same;
    for (uint32_t frame = 0; frame < gpu::kJitterFrames + 8; ++frame)
        same = drawFiltered(again, camera_, frame);
    EXPECT_EQ(same, last) << "the same frames";
}

TEST_F(TemporalFilterTest, theFirstFrameAndACutAreShownAsTheyAre)
{
    gpu::FrameTargets targets = makeFilterTargets();
    const auto isPlain = [&](const Bytes& filtered)
    {
        auto plain = host().read(renderer().device(), targets.color(), 4);
        return plain.ok() && *plain == filtered;
    };
    EXPECT_TRUE(isPlain(drawFiltered(targets, camera_, 0)));
    EXPECT_FALSE(isPlain(drawFiltered(targets, camera_, 1)));
    EXPECT_TRUE(isPlain(drawFiltered(targets, camera_, 2, true))) << "a cut";
    EXPECT_FALSE(isPlain(drawFiltered(targets, camera_, 3)));
    (void)drawPlain(targets, camera_);
    EXPECT_TRUE(isPlain(drawFiltered(targets, camera_, 5))) << "behind a frame that was not filtered";
}

TEST_F(TemporalFilterTest, whatMovesLeavesNoTrail)
{
    gpu::FrameTargets targets = makeFilterTargets();
    for (uint32_t frame = 0; frame < gpu::kJitterFrames; ++frame)
        (void)drawFiltered(targets, camera_, frame);
    double trail = 0, plain_trail = 0, whole = 0, plain_whole = 0;
    for (uint32_t frame = 0; frame < 12; ++frame)
    {
        card_.m[0][3] += 0.12f; // some three pixels
        const Bytes filtered = drawFiltered(targets, camera_, frame);
        if (frame < 8)
            continue;
        const auto plain = host().read(renderer().device(), targets.color(), 4);
        ASSERT_TRUE(plain.ok());
        const Bytes expected = drawSamples(camera_);
        trail += differInTrail(filtered, expected);
        plain_trail += differInTrail(*plain, expected);
        whole += differ(filtered, expected);
        plain_whole += differ(*plain, expected);
    }
    RecordProperty("trail_filtered", std::to_string(trail / 4));
    RecordProperty("trail_one_sample", std::to_string(plain_trail / 4));
    RecordProperty("whole_filtered", std::to_string(whole / 4));
    RecordProperty("whole_one_sample", std::to_string(plain_whole / 4));
    EXPECT_LT(trail, plain_trail);
    EXPECT_LT(whole, plain_whole / 2);
}

} // namespace hearth::test
