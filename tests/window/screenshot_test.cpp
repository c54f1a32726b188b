// Tests that hearth-view and hearth-render show the same image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/cooked_sample.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace hearth::roundtrip
{

namespace
{

std::string readContent(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class Screenshot : public testing::Test
{
protected:
    /// Expect that the window's image equals hearth-render's in every pixel, and that the validation layer is
    /// silent.
    void expectSame(const std::vector<std::string>& options) { expectSame(sample_, options); }

    void expectSame(const CookedSample& sample, const std::vector<std::string>& options)
    {
        std::vector<std::string> arguments{sample.packPath(), "--size", "320x240", "--validate"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        std::vector<std::string> view = arguments, render = arguments;
        view.insert(view.end(), {"--frames", "3", "--screenshot", folder_.path("view.png")});
        // a window has one sample of each pixel
        render.insert(render.end(), {"--samples", "1", "-o", folder_.path("render.png")});
        const ProgramEnd viewed = runProgram(HEARTH_VIEW_PROGRAM, view);
        ASSERT_EQ(viewed.exit_code, 0) << viewed.errors;
        const ProgramEnd rendered = runProgram(Program::render, render);
        ASSERT_EQ(rendered.exit_code, 0) << rendered.errors;
        const std::string image = readContent(folder_.path("view.png"));
        EXPECT_GT(image.size(), 1000u);
        EXPECT_TRUE(image == readContent(folder_.path("render.png")));
    }

    const CookedSample& sample_ = cookedSample({"rock", 150000});
    const CookedSample& character_ = cookedSample({"character", 20000});
    ScratchFolder folder_;
};

} // namespace

TEST_F(Screenshot, ofTheWholeScene)
{
    expectSame({});
}

TEST_F(Screenshot, ofACameraAndADebugView)
{
    expectSame({"--camera", "1.2,0.8,2.1,0,0.1,0,40", "--view", "clusters", "--error-pixels", "2"});
}

TEST_F(Screenshot, ofTheOverdraw)
{
    expectSame({"--view", "overdraw", "--cull", "frustum,cone"});
}

TEST_F(Screenshot, ofAStreamedScene)
{
    expectSame({"--budget", "64M", "--lod-curve", "0:1,4:0.5"});
}

TEST_F(Screenshot, ofASceneLargerThanItsBudget)
{
    const std::string file = folder_.path("view.png");
    const ProgramEnd end = runProgram(
        HEARTH_VIEW_PROGRAM, {sample_.packPath(), "--size", "320x240", "--budget", "512K", "--error-pixels",
                              "0.1", "--frames", "1", "--screenshot", file, "--validate"});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_GT(readContent(file).size(), 1000u);
}

TEST_F(Screenshot, ofACharacterAtRestAndInMomentsOfItsClips)
{
    expectSame(character_, {});
    const std::string rest = readContent(folder_.path("view.png"));
    expectSame(character_, {"--animation", "walk", "--time", "0.4"});
    EXPECT_FALSE(rest == readContent(folder_.path("view.png")));
    expectSame(character_, {"--animation", "1", "--time", "0.9", "--view", "bones"});
    expectSame(character_, {"--animation", "walk", "--time", "77", "--budget", "64M"});
}

TEST_F(Screenshot, failsWithTheMessagesOfOtherPrograms)
{
    EXPECT_EQ(runProgram(HEARTH_VIEW_PROGRAM, {}).exit_code, 2);
    EXPECT_EQ(runProgram(HEARTH_VIEW_PROGRAM, {folder_.path("none.hearth")}).exit_code, 66);
    const ProgramEnd budget = runProgram(HEARTH_VIEW_PROGRAM, {sample_.packPath(), "--budget", "16"});
    EXPECT_EQ(budget.exit_code, 2);
    EXPECT_NE(budget.errors.find("E4006"), std::string::npos) << budget.errors;
    const ProgramEnd nowhere = runProgram(
        HEARTH_VIEW_PROGRAM, {sample_.packPath(), "--frames", "1", "--screenshot", folder_.path("no/a.png")});
    EXPECT_EQ(nowhere.exit_code, 73) << nowhere.errors;
    const std::vector<std::string> no_such_clip{character_.packPath(), "--animation", "Fly"};
    std::vector<std::string> rendered = no_such_clip;
    rendered.insert(rendered.end(), {"-o", folder_.path("a.png")});
    const ProgramEnd clip = runProgram(HEARTH_VIEW_PROGRAM, no_such_clip);
    EXPECT_EQ(clip.exit_code, 2);
    const std::string said = clip.errors.substr(clip.errors.find("error"));
    EXPECT_NE(said.find("\"Fly\""), std::string::npos) << clip.errors;
    EXPECT_NE(runProgram(Program::render, rendered).errors.find(said), std::string::npos) << said;
}

} // namespace hearth::roundtrip
