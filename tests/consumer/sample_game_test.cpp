// Tests the sample game, a separate project: it is built against the installed Hearth, and draws a recording
// without a window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/compare/flip.h"
#include "tests/consumer/installation.h"

#include <filesystem>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

const std::string kRecording = HEARTH_SOURCE_FOLDER "/runtime/sample_game/camp.inputs";

class SampleGame : public Installation
{
protected:
    static void SetUpTestSuite()
    {
        Installation::SetUpTestSuite();
        fs::create_directory(folder() / "assets");
        // small images and little ground: most of the time would go into cooking
        run(HEARTH_BUILD_FOLDER
            "/bin/hearth-samples camp --triangles 20000 --texture-size 256 -o assets/camp.glb");
        // CMake's default compiler, so that the game is built by another one than Hearth
        run(HEARTH_CMAKE " -S " HEARTH_SOURCE_FOLDER "/runtime/sample_game -B game -G Ninja "
                         "-DCMAKE_PREFIX_PATH=\"$PWD/prefix\" -DGAME_ASSETS=\"$PWD/assets\" "
                         "-DCMAKE_CXX_FLAGS='-O1 -Wall -Werror'");
        run(HEARTH_CMAKE " --build game");
    }

    void SetUp() override
    {
        if (shell("prefix/bin/hearth-render --name-device").exit_code != 0)
            GTEST_SKIP() << "there is no Vulkan device";
    }

    /// Draw frames 0, 20, 40 ... of the recording into a new folder.
    static void replay(const std::string& pictures, int frames, const std::string& environment)
    {
        const std::string said =
            run(environment + " game/game game/camp.hearth --size 192x108 --replay '" + kRecording +
                "' --every 20 --frames " + std::to_string(frames) + " -o " + pictures);
        EXPECT_EQ(said, "");
    }

    static viewer::Image read(const std::string& path)
    {
        Result<viewer::Image> image = viewer::readPng(path);
        EXPECT_TRUE(image.ok()) << formatMessage(image.error());
        return image.ok() ? std::move(image).value() : viewer::Image(192, 108);
    }
};

} // namespace

TEST_F(SampleGame, drawsTheKeptPicturesOfARecordingEachTime)
{
    replay("first", 61, "VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation");
    // it stands at noon, begins to run at dusk, runs, and waves at night
    for (const char* name : {"/0000.png", "/0020.png", "/0040.png", "/0060.png"})
    {
        const viewer::Image drawn = read(folder() / (std::string("first") + name));
        const viewer::Image kept =
            read(HEARTH_SOURCE_FOLDER "/tests/consumer/sample_game" + std::string(name));
        ASSERT_EQ(drawn.rgb.size(), kept.rgb.size());
        // devices differ at edges and in rounding; without lamps one differs by .15, without particles
        // by .02, without the blend of gaits by .01
        EXPECT_LT(viewer::flip(kept, drawn).mean(), 0.005) << name;
    }
    replay("second", 21, "");
    for (const char* name : {"/0000.png", "/0020.png"})
        EXPECT_EQ(folder().read(std::string("second") + name), folder().read(std::string("first") + name));
}

TEST_F(SampleGame, saysWhatIsWrong)
{
    const auto expectError = [](const std::string& arguments, const std::string& text)
    {
        const ProgramEnd end = shell("game/game " + arguments);
        EXPECT_EQ(end.exit_code, 1) << arguments;
        EXPECT_NE(end.err.find(text), std::string::npos) << end.err;
    };
    expectError("", "usage: game PACK");
    expectError("game/camp.hearth --replay '" + kRecording + "' --frames 1", "usage: game PACK");
    expectError("none.hearth --replay '" + kRecording + "' --frames 1 -o .", "none.hearth: error: ");
    folder().write("bad.inputs", "# comment\n3 1 0\n");
    expectError("game/camp.hearth --replay bad.inputs --frames 1 -o .", "bad.inputs:2: needs FRAMES FORWARD");
}

} // namespace hearth::test
