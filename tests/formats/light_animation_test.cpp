// Tests lights in clips with known answers: interpolation, limits and blending.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/records/animation_paths.h"
#include "formats/scene/animation.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Two lights and a clip of channels.
struct Scene
{
    std::vector<LightRecord> lights;
    std::vector<AnimationRecord> animations{AnimationRecord{}};
    std::vector<AnimationChannelRecord> channels;
    std::vector<float> keys;

    Scene()
    {
        LightRecord light{};
        light.color = {1, 0.5f, 0.25f};
        light.intensity = 10;
        light.range = 4;
        light.inner_cone_rad = 0.25f;
        light.outer_cone_rad = 0.5f;
        lights = {light, light};
    }

    void addChannel(uint32_t light, AnimationPath path, Interpolation interpolation,
                    const std::vector<float>& times, const std::vector<float>& values)
    {
        AnimationChannelRecord channel{};
        channel.target = light;
        channel.path = static_cast<uint32_t>(path);
        channel.interpolation = static_cast<uint32_t>(interpolation);
        channel.components = kAnimationPaths[channel.path].components;
        channel.key_count = static_cast<uint32_t>(times.size());
        channel.first_time = static_cast<uint32_t>(keys.size());
        keys.insert(keys.end(), times.begin(), times.end());
        channel.first_value = static_cast<uint32_t>(keys.size());
        keys.insert(keys.end(), values.begin(), values.end());
        channels.push_back(channel);
        ++animations[0].light_channels.count;
    }

    /// Return light 0 at a time.
    LightRecord at(double time) const
    {
        AnimationTables tables;
        tables.animations = animations;
        tables.channels = channels;
        tables.keys = keys;
        std::vector<LightRecord> now = lights;
        sampleLights(tables, animations[0], time, now);
        EXPECT_EQ(now[1].intensity, 10) << "no channel animates the other light";
        return now[0];
    }
};

} // namespace

TEST(LightAnimation, setsEachProperty)
{
    Scene scene;
    scene.addChannel(0, AnimationPath::light_color, Interpolation::linear, {0, 2}, {0, 1, 0, 1, 0, 0.5f});
    scene.addChannel(0, AnimationPath::light_intensity, Interpolation::linear, {0, 2}, {2, 6});
    scene.addChannel(0, AnimationPath::light_range, Interpolation::linear, {0, 2}, {1, 3});
    scene.addChannel(0, AnimationPath::light_inner_cone, Interpolation::linear, {0, 2}, {0.125f, 0.25f});
    scene.addChannel(0, AnimationPath::light_outer_cone, Interpolation::linear, {0, 2}, {0.5f, 1});
    const LightRecord light = scene.at(0.5);
    EXPECT_EQ(light.color, (Float3{0.25f, 0.75f, 0.125f}));
    EXPECT_EQ(light.intensity, 3);
    EXPECT_EQ(light.range, 1.5f);
    EXPECT_EQ(light.inner_cone_rad, 0.15625f);
    EXPECT_EQ(light.outer_cone_rad, 0.625f);
    EXPECT_EQ(scene.at(-1).intensity, 2) << "holds the first key";
    EXPECT_EQ(scene.at(9).intensity, 6) << "holds the last key";
}

TEST(LightAnimation, interpolatesAsTheChannelSays)
{
    const auto at = [](Interpolation interpolation, const std::vector<float>& values, double time)
    {
        Scene scene;
        scene.addChannel(0, AnimationPath::light_intensity, interpolation, {0, 4}, values);
        return scene.at(time).intensity;
    };
    EXPECT_EQ(at(Interpolation::step, {1, 9}, 3.9), 1);
    EXPECT_EQ(at(Interpolation::step, {1, 9}, 4), 9);
    EXPECT_EQ(at(Interpolation::linear, {1, 9}, 1), 3);
    // Hermite at a quarter: 27/32 * 1 + 4 * 9/64 * 2 + 5/32 * 9 - 4 * 3/64 * 1
    EXPECT_FLOAT_EQ(at(Interpolation::cubic_spline, {5, 1, 2, 1, 9, 7}, 1),
                    27.0f / 32 + 9.0f / 8 + 45.0f / 32 - 3.0f / 16);
}

TEST(LightAnimation, splinesStayPossible)
{
    const auto at = [](AnimationPath path, std::vector<float> values)
    {
        Scene scene;
        scene.addChannel(0, path, Interpolation::cubic_spline, {0, 1}, values);
        return scene.at(0.5);
    };
    constexpr float kDown = -100, kUp = 100;
    EXPECT_EQ(at(AnimationPath::light_intensity, {0, 1, kDown, kUp, 1, 0}).intensity, 0);
    EXPECT_EQ(at(AnimationPath::light_range, {0, 1, kDown, kUp, 1, 0}).range, kMinAnimatedRange)
        << "0 would be unlimited";
    EXPECT_EQ(at(AnimationPath::light_outer_cone, {0, 1, kUp, kDown, 1, 0}).outer_cone_rad,
              std::numbers::pi_v<float> / 2);
    const LightRecord closed = at(AnimationPath::light_outer_cone, {0, 1, kDown, kUp, 1, 0});
    EXPECT_EQ(closed.outer_cone_rad, 0);
    EXPECT_EQ(closed.inner_cone_rad, 0) << "no wider than the outer cone";
    constexpr float kMax = std::numeric_limits<float>::max();
    EXPECT_EQ(at(AnimationPath::light_intensity, {0, kMax, kMax, -kMax, kMax, 0}).intensity, kMax);
    const LightRecord color =
        at(AnimationPath::light_color, {0, 0, 0, 1, 1, 1, kDown, 0, kUp, kUp, 0, kDown, 1, 1, 1, 0, 0, 0});
    EXPECT_EQ(color.color, (Float3{0, 1, 26}));
}

TEST(LightAnimation, blendsProperties)
{
    LightRecord from{}, to{};
    from.color = {1, 0, 0}, to.color = {0, 1, 0.5f};
    from.intensity = 4, to.intensity = 8;
    from.range = 2, to.range = 4;
    from.inner_cone_rad = 0, to.inner_cone_rad = 0.5f;
    from.outer_cone_rad = 1, to.outer_cone_rad = 0.5f;
    from.flicker_rate = to.flicker_rate = 3;
    std::vector<LightRecord> a{from}, b{to};
    const auto blend = [&](double weight)
    {
        std::vector<LightRecord> result(1);
        blendLights(a, b, weight, result);
        return result[0];
    };
    const LightRecord light = blend(0.25);
    EXPECT_EQ(light.color, (Float3{0.75f, 0.25f, 0.125f}));
    EXPECT_EQ(light.intensity, 5);
    EXPECT_EQ(light.range, 2.5f);
    EXPECT_EQ(light.inner_cone_rad, 0.125f);
    EXPECT_EQ(light.outer_cone_rad, 0.875f);
    EXPECT_EQ(light.flicker_rate, 3);
    b[0].range = 0;
    EXPECT_EQ(blend(0).range, 2);
    EXPECT_EQ(blend(0.25).range, 0) << "unlimited";
    EXPECT_EQ(blend(1).range, 0);
    std::vector<LightRecord> in_place = a;
    blendLights(in_place, b, 0.5, in_place);
    EXPECT_EQ(in_place[0].intensity, 6);
}

} // namespace hearth::test
