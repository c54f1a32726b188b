// Tests the command line of hearth-view. Options shared with hearth-render are tested with hearth-render.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/options.h"

#include <gtest/gtest.h>

namespace hearth::test
{

TEST(ViewOptions, areThoseOfADrawingAndItsOwn)
{
    const char* const arguments[] = {"a.hearth",   "--size",    "64x32",      "--view",       "lod",
                                     "--budget",   "2M",        "--frames=7", "--screenshot", "a.png",
                                     "--validate", "--shadows", "maps=5"};
    const auto options = viewer::parseViewOptions(arguments);
    ASSERT_TRUE(options.ok()) << formatMessage(options.error());
    EXPECT_EQ(options->pack, "a.hearth");
    EXPECT_EQ(options->width, 64u);
    EXPECT_EQ(options->settings.view, shared::kViewLod);
    EXPECT_EQ(options->memory_budget, 2u << 20);
    EXPECT_EQ(options->frames, 7u);
    EXPECT_EQ(options->screenshot, "a.png");
    EXPECT_TRUE(options->validate);
    EXPECT_EQ(options->shadows.options.max_maps, 5u);
}

TEST(ViewOptions, nameAClipAndAMomentOfIt)
{
    const char* const plays[] = {"a.hearth", "--animation", "Walk"};
    const auto playing = viewer::parseViewOptions(plays);
    ASSERT_TRUE(playing.ok());
    EXPECT_EQ(playing->animation.clip, "Walk");
    EXPECT_EQ(playing->animation.seconds, std::nullopt);
    const char* const stands[] = {"a.hearth", "--animation=2", "--time", "-0.5"};
    const auto standing = viewer::parseViewOptions(stands);
    ASSERT_TRUE(standing.ok()) << formatMessage(standing.error());
    EXPECT_EQ(standing->animation.clip, "2");
    EXPECT_EQ(standing->animation.seconds, -0.5);
}

TEST(ViewOptions, mistakesAreNamed)
{
    const auto expectUsage = [](std::vector<const char*> arguments, const std::string& mention)
    {
        const auto options = viewer::parseViewOptions(arguments);
        ASSERT_FALSE(options.ok()) << mention;
        EXPECT_EQ(exitCode(options.error()), 2);
        EXPECT_NE(formatMessage(options.error()).find(mention), std::string::npos)
            << formatMessage(options.error());
    };
    expectUsage({}, "no pack");
    expectUsage({"a.hearth", "-o", "a.png"}, "-o");
    expectUsage({"a.hearth", "--frames", "0"}, "--frames");
    expectUsage({"a.hearth", "--view", "shadow-maps", "--shadows", "off"}, "--shadows");
    expectUsage({"a.hearth", "--screenshot", "a.png"}, "--frames");
    expectUsage({"a.hearth", "--animation"}, "--animation");
    for (const char* time : {"", "soon", "1s", "nan", "inf"})
        expectUsage({"a.hearth", "--animation", "Walk", "--time", time}, "--time");
    expectUsage({"a.hearth", "--animation", "Walk", "--blend", "Run,0,1"}, "--blend");
}

} // namespace hearth::test
