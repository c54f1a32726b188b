// Tests the images of single meshes and of reports, with the real programs on any available Vulkan device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

class ImagesOfMeshes : public ::testing::Test
{
protected:
    ImagesOfMeshes()
    {
        writeObj(folder, "house", 2, 200);
        writeObj(folder, "wall", 0.5, 90);
    }

    ProgramEnd hearth(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth");
        return folder.run(arguments);
    }

    ProgramEnd render(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth-render");
        arguments.insert(arguments.end(), {"--size", "64x48"});
        return folder.run(arguments);
    }

    void cook(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "cook");
        const ProgramEnd end = hearth(arguments);
        ASSERT_EQ(end.exit_code, 0) << end.err;
    }

    Sandbox folder;
};

} // namespace

TEST_F(ImagesOfMeshes, areThoseOfAPackThatHasNothingElse)
{
    cook({"house.obj", "wall.obj", "-o", "both.hearth"});
    cook({"house.obj", "-o", "house.hearth"});
    cook({"wall.obj", "-o", "wall.hearth"});
    const ProgramEnd both = render({"both.hearth", "-o", "both.png", "--meshes", "1,0,1"});
    if (both.exit_code == 70)
        GTEST_SKIP() << both.err;
    ASSERT_EQ(both.exit_code, 0) << both.err;
    for (const char* name : {"house", "wall"})
        ASSERT_EQ(render({std::string(name) + ".hearth", "-o", std::string(name) + ".png", "--meshes", "0"})
                      .exit_code,
                  0);
    EXPECT_EQ(folder.read("both-0001.png"), folder.read("house-0000.png"));
    EXPECT_EQ(folder.read("both-0000.png"), folder.read("wall-0000.png"));
    EXPECT_EQ(folder.read("both-0002.png"), folder.read("wall-0000.png")) << "it comes back";
    EXPECT_NE(folder.read("house-0000.png"), folder.read("wall-0000.png"));
}

TEST_F(ImagesOfMeshes, comeInSeveralViewsAtOnce)
{
    cook({"house.obj", "-o", "house.hearth"});
    const ProgramEnd views = render({"house.hearth", "-o", "views.png", "--views", "final,clusters"});
    if (views.exit_code == 70)
        GTEST_SKIP() << views.err;
    ASSERT_EQ(views.exit_code, 0) << views.err;
    for (const std::string view : {"final", "clusters"})
    {
        ASSERT_EQ(render({"house.hearth", "-o", view + ".png", "--view", view}).exit_code, 0);
        EXPECT_EQ(folder.read("views-" + view + ".png"), folder.read(view + ".png"));
    }
    EXPECT_NE(folder.read("final.png"), folder.read("clusters.png"));
    ASSERT_EQ(render({"house.hearth", "-o", "house.jpg"}).exit_code, 0);
    EXPECT_EQ(folder.read("house.jpg").substr(0, 3), "\xff\xd8\xff");
    EXPECT_EQ(render({"house.hearth", "-o", "a.png", "--meshes", "1"}).exit_code, 2) << "there is none";
    EXPECT_FALSE(folder.has("a.png"));
}

TEST_F(ImagesOfMeshes, areInThePage)
{
    cook({"house.obj", "wall.obj", "-o", "both.hearth", "--report", "page.html", "--report", "report.json"});
    const std::string page = folder.read("page.html");
    if (page.find("no usable graphics device") != std::string::npos)
        GTEST_SKIP() << "no device";
    EXPECT_NE(page.find("\"is_sheet\":true"), std::string::npos) << "both stand at the origin";
    // four views each, of the scene and of both meshes: one of ambient occlusion
    EXPECT_EQ(countOccurrences(page, "data:image/jpeg;base64,/9j/"), 12u);
    const std::vector<std::string> files{"report", "report.json", "--html", "later.html"};
    ASSERT_EQ(hearth(files).exit_code, 0);
    EXPECT_EQ(countOccurrences(folder.read("later.html"), "data:image/jpeg"), 0u) << "the pack is not named";
    std::vector<std::string> with_pack = files;
    with_pack.insert(with_pack.end(), {"--pack", "both.hearth"});
    ASSERT_EQ(hearth(with_pack).exit_code, 0);
    EXPECT_EQ(folder.read("later.html"), page);
}

} // namespace hearth::test
