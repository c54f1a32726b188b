// Tests the light player against a slow reference: the lights of clips, blends, moving nodes and flicker.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/light_player.h"

#include "formats/records/animation_paths.h"
#include "formats/scene/light_flicker.h"
#include "tests/runtime/gpu/animated_rocks.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace hearth::test
{

namespace
{

using namespace formats;
using pack::ClipTime;

/// Curve of one number, evaluated as glTF writes it down.
struct Curve
{
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;
    std::vector<double> values; ///< three for each key of a spline

    double at(double time) const
    {
        size_t next = 0;
        while (next < times.size() && times[next] <= time)
            ++next;
        const auto value = [&](size_t key)
        { return interpolation == Interpolation::cubic_spline ? values[3 * key + 1] : values[key]; };
        if (next == 0 || next == times.size())
            return value(next == 0 ? 0 : next - 1);
        if (interpolation == Interpolation::step)
            return value(next - 1);
        const double length = times[next] - times[next - 1], t = (time - times[next - 1]) / length;
        if (interpolation == Interpolation::linear)
            return value(next - 1) * (1 - t) + value(next) * t;
        return (2 * t * t * t - 3 * t * t + 1) * value(next - 1) +
               length * (t * t * t - 2 * t * t + t) * values[3 * next - 1] +
               (-2 * t * t * t + 3 * t * t) * value(next) + length * (t * t * t - t * t) * values[3 * next];
    }
};

/// Add a channel of a light to the last clip.
void addLightChannel(PackModel& model, uint32_t light, AnimationPath path, const Curve& curve)
{
    AnimationChannelRecord channel{};
    channel.target = light;
    channel.path = static_cast<uint32_t>(path);
    channel.interpolation = static_cast<uint32_t>(curve.interpolation);
    channel.components = kAnimationPaths[channel.path].components;
    channel.key_count = static_cast<uint32_t>(curve.times.size());
    channel.first_time = static_cast<uint32_t>(model.keys.size());
    for (const double time : curve.times)
        model.keys.push_back(static_cast<float>(time));
    channel.first_value = static_cast<uint32_t>(model.keys.size());
    for (const double value : curve.values)
        model.keys.push_back(static_cast<float>(value));
    model.channels.push_back(channel);
    AnimationRecord& animation = model.animations.back();
    ++animation.light_channels.count;
    animation.duration = std::max(animation.duration, static_cast<float>(curve.times.back()));
}

const Curve kFade{Interpolation::linear, {0.5, 2, 3}, {10, 2, 30}};
const Curve kReach{Interpolation::step, {0, 1, 2}, {3, 5, 0.5}};
const Curve kOpen{Interpolation::cubic_spline, {0, 2}, {0, 0.3, -2, 1, 1.2, 0}};

/// Lights: 0 rests; 1 flickers; 2 hangs below the node that "slide" and "rise" move, and "rise" changes it; 3
/// is a spot that "rise" opens, and flickers.
void fillLights(TestScene& test)
{
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(8, 0.2f), kInvalidIndex)));
    for (int i = 0; i < 3; ++i)
        test.addLight(light(LightType::point, {1, 2, 3}, {0, -1, 0}, 10));
    test.addLight(light(LightType::spot, {0, 5, 0}, {0, -1, 0}, 8));
    PackModel& model = test.model();
    for (const uint32_t flickering : {1u, 3u})
    {
        model.lights[flickering].flicker_rate = 4;
        model.lights[flickering].flicker_amplitude = 0.75f;
        model.lights[flickering].flicker_seed = flickering;
    }
    // node of rock 2, at (2, 1, 0) at rest; the light stands a metre above it
    model.lights[2].node = model.instances[2].node;
    model.lights[2].world_from_light = translated({2, 2, 0});
    addLightChannel(model, 2, AnimationPath::light_intensity, kFade);
    addLightChannel(model, 2, AnimationPath::light_range, kReach);
    addLightChannel(model, 3, AnimationPath::light_outer_cone, kOpen);
}

/// Return the lights that differ between two states.
std::vector<uint32_t> differing(const std::map<uint32_t, LightRecord>& a,
                                const std::map<uint32_t, LightRecord>& b)
{
    std::vector<uint32_t> lights;
    for (const auto& [light, record] : a)
        if (std::memcmp(&record, &b.at(light), sizeof(record)) != 0)
            lights.push_back(light);
    return lights;
}

std::vector<uint32_t> indices(std::span<const pack::PlayedLight> lights)
{
    std::vector<uint32_t> result;
    for (const pack::PlayedLight& light : lights)
        result.push_back(light.light);
    return result;
}

class LightPlayerTest : public ::testing::Test
{
protected:
    LightPlayerTest()
    {
        fillLights(test_);
        pack_ = test_.build();
        poses_.emplace(*pack_);
        player_.emplace(*pack_);
    }

    /// Expect the lights of "slide" and "rise" at these times, with a share `weight` of the second one.
    void expectLights(double slide, double rise, double weight, double flicker)
    {
        const double slid = 2 + std::min(slide, 4.0), risen = std::min(rise, 4.0);
        const auto blend = [&](double at_rest, double in_clip)
        { return static_cast<float>(at_rest * (1 - weight) + in_clip * weight); };
        const auto flickered = [&](uint32_t light, float intensity)
        { return static_cast<float>(double{intensity} * (1 - 0.75 * flickerNoise(light, 4 * flicker))); };
        const auto& records = test_.model().lights;
        std::map<uint32_t, LightRecord> now;
        for (const pack::PlayedLight& light : player_->lights())
        {
            now[light.light] = light.record;
            if (light.light != 2) // whose intensity a clip changes
                EXPECT_EQ(light.steady_intensity, records[light.light].intensity);
        }
        ASSERT_EQ(now.size(), 3u);
        EXPECT_EQ(now[1].intensity, flickered(1, records[1].intensity));
        EXPECT_EQ(now[1].world_from_light, records[1].world_from_light);
        EXPECT_FLOAT_EQ(now[2].world_from_light.m[0][3], blend(slid, 2));
        EXPECT_FLOAT_EQ(now[2].world_from_light.m[1][3], blend(2, 2 + risen));
        EXPECT_FLOAT_EQ(now[2].intensity, blend(10, kFade.at(rise)));
        EXPECT_FLOAT_EQ(now[2].range, weight == 1 ? static_cast<float>(kReach.at(rise)) : 0);
        const auto outer = static_cast<float>(std::clamp(kOpen.at(rise), 0.0, std::numbers::pi / 2));
        EXPECT_NEAR(now[3].outer_cone_rad, blend(double{0.7f}, double{outer}), 1e-6f);
        EXPECT_NEAR(now[3].inner_cone_rad, blend(0.5, std::min(0.5, double{outer})), 1e-6f);
        EXPECT_EQ(now[3].intensity, flickered(3, records[3].intensity));
    }

    TestScene test_;
    std::optional<PackView> pack_;
    std::optional<pack::PosePlayer> poses_;
    std::optional<pack::LightPlayer> player_;
};

} // namespace

TEST_F(LightPlayerTest, lightsFollowClipsNodesAndTime)
{
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i)
    {
        const double slide = uniform(random, -1, 5), rise = uniform(random, -1, 5);
        const double flicker = uniform(random, 0, 1000), weight = uniform(random, 0, 1);
        switch (i % 3)
        {
        case 0:
            poses_->play({0, slide});
            player_->update(*poses_, flicker);
            expectLights(std::max(slide, 0.0), 0, 0, flicker);
            break;
        case 1:
            poses_->play({1, rise});
            player_->update(*poses_, flicker);
            expectLights(0, std::max(rise, 0.0), 1, flicker);
            break;
        default:
            poses_->blend({0, slide}, {1, rise}, weight);
            player_->update(*poses_, flicker);
            expectLights(std::max(slide, 0.0), std::max(rise, 0.0), weight, flicker);
        }
        ASSERT_FALSE(HasFailure()) << i;
    }
}

TEST_F(LightPlayerTest, namesTheLightsThatChanged)
{
    using Indices = std::vector<uint32_t>;
    EXPECT_EQ(indices(player_->lights()), (Indices{1, 2, 3})) << "light 0 never changes";
    EXPECT_EQ(indices(player_->changed()), Indices{}) << "as the pack has them, without flicker";
    EXPECT_EQ(player_->lights()[0].record.intensity, 10);
    player_->update(*poses_, 0.3);
    EXPECT_EQ(indices(player_->changed()), (Indices{1, 3})) << "they flicker";
    player_->update(*poses_, 0.3);
    EXPECT_EQ(indices(player_->changed()), Indices{}) << "the same time";
    poses_->play({0, 1});
    player_->update(*poses_, 0.3);
    EXPECT_EQ(indices(player_->changed()), Indices{2});

    // random poses: changed() is the difference from the state before
    std::mt19937 random(6);
    const auto state = [&]
    {
        std::map<uint32_t, LightRecord> lights;
        for (const pack::PlayedLight& light : player_->lights())
            lights[light.light] = light.record;
        return lights;
    };
    for (int i = 0; i < 50; ++i)
    {
        const auto before = state();
        poses_->play({static_cast<uint32_t>(random() % 2), static_cast<double>(random() % 3)});
        player_->update(*poses_, static_cast<double>(random() % 2));
        EXPECT_EQ(indices(player_->changed()), differing(before, state()));
    }
}

TEST_F(LightPlayerTest, lightsAtRestHaveTheBitsOfThePack)
{
    poses_->play({0, 3});
    player_->update(*poses_, 2);
    poses_->rest();
    player_->update(*poses_, 2);
    const LightRecord& back = player_->lights()[1].record;
    EXPECT_EQ(std::memcmp(&back, &pack_->lights()[2], sizeof(back)), 0);
    pack::LightPlayer other(*pack_);
    other.update(*poses_, 2);
    for (size_t i = 0; i < other.lights().size(); ++i)
        EXPECT_EQ(std::memcmp(&other.lights()[i].record, &player_->lights()[i].record, sizeof(LightRecord)),
                  0)
            << "no state but the pose and the time";
}

} // namespace hearth::test
