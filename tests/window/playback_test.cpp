// Tests which time of which clip a window shows. No window is needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/playback.h"

#include "tests/runtime/gpu/animated_rocks.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using viewer::Playback;
using viewer::PlaybackSettings;

constexpr double kExact = 1e-12;

/// Clips of two and three seconds, and a pose of one key.
Playback threeClips(std::optional<pack::ClipTime> start = std::nullopt)
{
    return Playback({2, 3, 0}, start);
}

} // namespace

TEST(Playback, startsWithTheClipThatIsGivenAtAnyTime)
{
    EXPECT_FALSE(threeClips().clip());
    Playback playback = threeClips(pack::ClipTime{1, 7.5});
    PlaybackSettings settings{.clip = 1, .playing = false};
    playback.advance(settings, 10);
    EXPECT_EQ(playback.clip()->animation, 1u);
    EXPECT_EQ(playback.clip()->seconds, 7.5) << "it stands still, and beyond its keys it rests";
    EXPECT_EQ(playback.weight(), 1);
}

TEST(Playback, loopsForwardsAndBackwards)
{
    Playback playback = threeClips(pack::ClipTime{0, 0});
    PlaybackSettings settings{.clip = 0};
    playback.advance(settings, 0.5);
    EXPECT_NEAR(playback.clip()->seconds, 0.5, kExact);
    playback.advance(settings, 6);
    EXPECT_NEAR(playback.clip()->seconds, 0.5, kExact);
    settings.speed = -2;
    playback.advance(settings, 0.5);
    EXPECT_NEAR(playback.clip()->seconds, 1.5, kExact);
}

TEST(Playback, restsAtItsEndsWhereItDoesNotLoop)
{
    Playback playback = threeClips(pack::ClipTime{0, 0});
    PlaybackSettings settings{.clip = 0, .loop = false};
    playback.advance(settings, 9);
    EXPECT_EQ(playback.clip()->seconds, 2);
    settings.speed = -1;
    playback.advance(settings, 1.5);
    EXPECT_EQ(playback.clip()->seconds, 0.5);
    playback.advance(settings, 1.5);
    EXPECT_EQ(playback.clip()->seconds, 0);
    settings.clip = 1;
    settings.fade_seconds = 0;
    playback.advance(settings, 1);
    EXPECT_EQ(playback.clip()->seconds, 2) << "backwards it begins at its end";
}

TEST(Playback, goesToATimeOnce)
{
    Playback playback = threeClips(pack::ClipTime{1, 0});
    PlaybackSettings settings{.clip = 1, .playing = false, .go_to = 1.25};
    playback.advance(settings, 3);
    EXPECT_EQ(playback.clip()->seconds, 1.25);
    EXPECT_FALSE(settings.go_to);
    settings.playing = true;
    playback.advance(settings, 0.25);
    EXPECT_EQ(playback.clip()->seconds, 1.5);
}

TEST(Playback, letsTheNextClipTakeOverWhileBothGoOn)
{
    Playback playback = threeClips(pack::ClipTime{0, 1});
    PlaybackSettings settings{.clip = 1, .fade_seconds = 0.5f};
    playback.advance(settings, 0.125);
    ASSERT_TRUE(playback.fadedClip());
    EXPECT_EQ(playback.fadedClip()->animation, 0u);
    EXPECT_NEAR(playback.fadedClip()->seconds, 1.125, kExact);
    EXPECT_NEAR(playback.clip()->seconds, 0.125, kExact);
    EXPECT_NEAR(playback.weight(), 0.25, kExact);

    settings.clip = 0; // back again: clip 1 now fades out
    playback.advance(settings, 0.125);
    EXPECT_EQ(playback.fadedClip()->animation, 1u);
    EXPECT_NEAR(playback.fadedClip()->seconds, 0.25, kExact);
    EXPECT_NEAR(playback.clip()->seconds, 0.125, kExact);
    playback.advance(settings, 0.5);
    EXPECT_FALSE(playback.fadedClip());
    EXPECT_EQ(playback.weight(), 1);
}

TEST(Playback, changesAtOnceWhileItStandsStillOrFromRest)
{
    Playback playback = threeClips(pack::ClipTime{0, 1});
    PlaybackSettings settings{.clip = 1, .playing = false};
    playback.advance(settings, 0.1);
    EXPECT_EQ(playback.clip()->animation, 1u);
    EXPECT_FALSE(playback.fadedClip());
    settings = {.clip = std::nullopt};
    playback.advance(settings, 0.1);
    EXPECT_FALSE(playback.clip());
    EXPECT_FALSE(playback.fadedClip());
    settings.clip = 0;
    playback.advance(settings, 0.1);
    EXPECT_EQ(playback.clip()->animation, 0u);
    EXPECT_FALSE(playback.fadedClip()) << "nothing is blended with the rest pose";
}

TEST(Playback, staysWithinClipsAndWeightsWhateverIsSet)
{
    std::mt19937 random(3);
    Playback playback = threeClips();
    PlaybackSettings settings;
    size_t faded = 0;
    for (int step = 0; step < 20000; ++step)
    {
        if (random() % 8 == 0)
            settings.clip = random() % 4 == 3 ? std::nullopt : std::optional<uint32_t>(random() % 3);
        if (random() % 16 == 0)
            settings.speed = uniform(random, -4, 4);
        if (random() % 16 == 0)
            settings.fade_seconds = std::max(0.0f, uniform(random, -0.5f, 1));
        if (random() % 16 == 0)
            settings.go_to = static_cast<double>(uniform(random, -5, 5));
        settings.loop = random() % 8 != 0;
        playback.advance(settings,
                         static_cast<double>(uniform(random, 0, random() % 32 == 0 ? 60.0f : 0.1f)));
        EXPECT_EQ(playback.clip().has_value(), settings.clip.has_value());
        for (const auto& clip : {playback.clip(), playback.fadedClip()})
            if (clip)
            {
                EXPECT_GE(clip->seconds, 0);
                EXPECT_LE(clip->seconds, playback.duration(clip->animation));
            }
        EXPECT_GE(playback.weight(), 0);
        EXPECT_LE(playback.weight(), 1);
        faded += playback.fadedClip() ? 1u : 0u;
    }
    EXPECT_GT(faded, 1000u);
}

TEST(Playback, isAsLongInManyStepsAsInOne)
{
    PlaybackSettings settings{.clip = 1, .speed = 0.75f};
    Playback once = threeClips(pack::ClipTime{1, 0}), often = once;
    once.advance(settings, 10);
    for (int i = 0; i < 1000; ++i)
        often.advance(settings, 0.01);
    EXPECT_NEAR(once.clip()->seconds, 1.5, 1e-9);
    EXPECT_NEAR(often.clip()->seconds, 1.5, 1e-9);
}

TEST(Playback, theTimeOfFlickerGoesOnWithoutClipsAndWhereTheyLoop)
{
    Playback playback({2}, std::nullopt, 1.5);
    PlaybackSettings settings{.playing = false};
    playback.advance(settings, 10);
    EXPECT_EQ(playback.flickerSeconds(), 1.5) << "paused";
    settings.playing = true;
    playback.advance(settings, 1);
    EXPECT_EQ(playback.flickerSeconds(), 2.5);
    settings.clip = 0;
    settings.speed = 0.5f;
    playback.advance(settings, 10);
    EXPECT_EQ(playback.clip()->seconds, 1);
    EXPECT_EQ(playback.flickerSeconds(), 7.5);
    settings.go_to = 0.25;
    playback.advance(settings, 1);
    EXPECT_EQ(playback.flickerSeconds(), 0.75) << "the time of the clip, and on from there";
}

TEST(Playback, posesThePlayer)
{
    TestScene test;
    fillAnimatedRocks(test, test.addMesh(withMaterial(shapes::rock(8, 0.2f), kInvalidIndex)));
    const formats::PackView pack = test.build();
    pack::PosePlayer player(pack);
    const auto rock = [&] { return transformPoint(player.transforms()[0].world_from_object, {}); };
    EXPECT_EQ(viewer::clipDurations(pack), (std::vector<double>{4, 4}));

    Playback playback(viewer::clipDurations(pack));
    PlaybackSettings settings{.clip = 0};
    playback.advance(settings, 2); // from (2, 0, 0) to (6, 0, 0)
    playback.pose(player);
    EXPECT_EQ(rock(), (Float3{4, 0, 0}));
    settings.clip = 1;
    settings.fade_seconds = 4;
    playback.advance(settings, 1); // "rise" has weight 1/4 and has risen a quarter of 4 m
    playback.pose(player);
    EXPECT_NEAR(rock().x, 5 - 0.25f * 3, 1e-6f);
    EXPECT_NEAR(rock().y, 0.25f, 1e-6f);
    settings.clip.reset();
    playback.advance(settings, 1);
    playback.pose(player);
    EXPECT_EQ(rock(), (Float3{2, 0, 0}));
}

} // namespace hearth::test
