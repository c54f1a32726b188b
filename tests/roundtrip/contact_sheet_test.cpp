// Tests contact sheets of cooked packs with the real programs, on any Vulkan device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "runtime/viewer/compare/image.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using viewer::Image;

const std::vector<std::string> kNames{"crate", "door", "tower"};

/// Two walls of 1 m and one of 500 m, all starting at the origin.
class ContactSheet : public ::testing::Test
{
protected:
    ContactSheet()
    {
        writeObj(folder, "crate", 1, 220);
        writeObj(folder, "door", 1, 120);
        folder.write("tower.obj", "v 0 0 0\nv 500 0 0\nv 500 500 0\nv 0 500 0\nvn 0 0 1\n"
                                  "f 1//1 2//1 3//1 4//1\n");
    }

    void cook(std::vector<std::string> sources, const std::string& output)
    {
        sources.insert(sources.begin(), {HEARTH_BIN "/hearth", "cook"});
        sources.insert(sources.end(), {"-o", output});
        const ProgramEnd end = folder.run(sources);
        ASSERT_EQ(end.exit_code, 0) << end.err;
    }

    void cookHeap() { cook({"crate.obj", "door.obj", "tower.obj"}, "heap.hearth"); }

    ProgramEnd render(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth-render");
        return folder.run(arguments);
    }

    /// Returns false if there is no device; any other failure fails the test.
    bool draw(const std::string& pack, const std::string& image, std::vector<std::string> arguments = {})
    {
        arguments.insert(arguments.begin(), {pack, "-o", image});
        const ProgramEnd end = render(arguments);
        if (end.err.find("[E4002]") == std::string::npos)
            EXPECT_EQ(end.exit_code, 0) << end.err;
        return end.exit_code == 0;
    }

    Image png(const std::string& name) { return viewer::readPng(folder / name).value(); }

    static Image part(const Image& image, uint32_t x, uint32_t y, uint32_t width, uint32_t height)
    {
        Image result(width, height);
        for (uint32_t row = 0; row < height; ++row)
            std::memcpy(result.at(0, row), image.at(x, y + row), size_t{width} * 3);
        return result;
    }

    Sandbox folder;
};

/// Count the pixels that differ from the first one of their row, which shows the sky.
size_t countUnlikeTheSky(const Image& image)
{
    size_t count = 0;
    for (size_t y = 0; y < image.height; ++y)
        for (size_t x = 0; x < image.width; ++x)
            count += std::memcmp(image.at(x, y), image.at(0, y), 3) != 0 ? 1 : 0;
    return count;
}

} // namespace

TEST_F(ContactSheet, showsEachAssetAsItsOwnPackDoes)
{
    cookHeap();
    if (!draw("heap.hearth", "sheet.png",
              {"--size", "640x240", "--stats", "sheet.json", "--views", "final,normals"}))
        GTEST_SKIP() << "no device";
    const Json stats = Json::parse(folder.read("sheet.json")).value();
    const Json& sheet = stats["sheet"];
    EXPECT_EQ(sheet["columns"], 3);
    EXPECT_EQ(sheet["rows"], 1);
    ASSERT_EQ(sheet["assets"].size(), kNames.size());
    const auto width = sheet["cell_width"].get<uint32_t>(), height = sheet["cell_height"].get<uint32_t>();
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    for (size_t i = 0; i < kNames.size(); ++i)
    {
        SCOPED_TRACE(kNames[i]);
        const Json& asset = sheet["assets"][i];
        EXPECT_EQ(asset["name"], kNames[i]) << "in the order of the sources";
        EXPECT_EQ(asset["index"], i);
        cook({kNames[i] + ".obj"}, "alone.hearth");
        for (const std::string view : {"final", "normals"})
        {
            ASSERT_TRUE(draw("alone.hearth", "alone.png", {"--size", size, "--view", view}));
            const Image cell = part(png("sheet-" + view + ".png"), asset["x"].get<uint32_t>(),
                                    asset["y"].get<uint32_t>(), width, height);
            EXPECT_EQ(cell.rgb, png("alone.png").rgb) << view;
            EXPECT_GT(countUnlikeTheSky(cell), size_t{width} * height / 4) << view;
        }
    }
}

TEST_F(ContactSheet, isWhatNothingElseAsksFor)
{
    cookHeap();
    const std::vector<std::string> size{"--size", "320x180"};
    const auto with = [&](std::vector<std::string> arguments)
    {
        arguments.insert(arguments.end(), size.begin(), size.end());
        return arguments;
    };
    if (!draw("heap.hearth", "sheet.png", with({})))
        GTEST_SKIP() << "no device";
    EXPECT_EQ(render({"heap.hearth", "-o", "a.png", "--size", "320x180"}).out,
              "contact sheet of 3 assets, which overlap (--sheet off draws the scene)\n");
    ASSERT_TRUE(draw("heap.hearth", "on.png", with({"--sheet", "on"})));
    EXPECT_EQ(folder.read("on.png"), folder.read("sheet.png"));
    ASSERT_TRUE(draw("heap.hearth", "off.png", with({"--sheet", "off", "--stats", "off.json"})));
    EXPECT_NE(folder.read("off.png"), folder.read("sheet.png"));
    EXPECT_FALSE(Json::parse(folder.read("off.json")).value().contains("sheet"));
    // several frames show the scene, from a viewpoint that fits it
    ASSERT_TRUE(draw("heap.hearth", "frames.png", with({"--frames", "2"})));
    EXPECT_EQ(folder.read("frames.png"), folder.read("off.png"));
    EXPECT_EQ(render({"heap.hearth", "-o", "b.png", "--sheet", "on", "--size", "12x12"}).exit_code, 2)
        << "no room";
    EXPECT_TRUE(draw("heap.hearth", "b.png", {"--size", "12x12"})) << "without one then";
}

TEST_F(ContactSheet, streamsAndSamplesToo)
{
    cookHeap();
    const std::vector<std::string> options{"--size", "320x180", "--samples", "4"};
    if (!draw("heap.hearth", "sheet.png", options))
        GTEST_SKIP() << "no device";
    std::vector<std::string> streamed = options;
    streamed.insert(streamed.end(), {"--budget", "4M"});
    ASSERT_TRUE(draw("heap.hearth", "streamed.png", streamed));
    EXPECT_EQ(folder.read("streamed.png"), folder.read("sheet.png"));
    EXPECT_EQ(png("sheet.png").width, 320u);
}

TEST_F(ContactSheet, isNoneOfASceneWhosePropsStandSideBySide)
{
    for (int i = 0; i < 3; ++i)
        folder.write("prop" + std::to_string(i) + ".obj", "v " + std::to_string(2 * i) + " 0 0\nv " +
                                                              std::to_string(2 * i + 1) + " 0 0\nv " +
                                                              std::to_string(2 * i) + " 1 0\nf 1 2 3\n");
    cook({"prop0.obj", "prop1.obj", "prop2.obj"}, "scene.hearth");
    if (!draw("scene.hearth", "scene.png", {"--size", "320x180"}))
        GTEST_SKIP() << "no device";
    ASSERT_TRUE(draw("scene.hearth", "off.png", {"--size", "320x180", "--sheet", "off"}));
    EXPECT_EQ(folder.read("scene.png"), folder.read("off.png"));
    ASSERT_TRUE(draw("scene.hearth", "on.png", {"--size", "320x180", "--sheet", "on"}));
    EXPECT_NE(folder.read("on.png"), folder.read("off.png")) << "unless it is asked for";
}

TEST_F(ContactSheet, isNoneOfTheSampleScene)
{
    const ProgramEnd samples = folder.run({HEARTH_BIN "/hearth-samples", "room", "-o", "room.glb"});
    ASSERT_EQ(samples.exit_code, 0) << samples.err;
    cook({"room.glb"}, "room.hearth");
    if (!draw("room.hearth", "room.png", {"--size", "160x90", "--stats", "room.json"}))
        GTEST_SKIP() << "no device";
    EXPECT_FALSE(Json::parse(folder.read("room.json")).value().contains("sheet"));
}

} // namespace hearth::test
