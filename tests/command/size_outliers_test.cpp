// Tests the warning about sources whose scale differs from the others, with the real cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_sources.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// Write three crates of 1, 2 and 2.5 m, and in another folder a bust that was exported in millimetres.
class SizeOutliers : public ::testing::Test
{
protected:
    SizeOutliers()
    {
        std::filesystem::create_directories(folder / "busts");
        writeObj(folder, "crate");
        writeObj(folder, "barrel", 2);
        writeObj(folder, "post", 2.5);
        writeObj(folder, "hero", 500);
        for (const char* file : {"hero.obj", "hero.mtl", "hero.tga"})
            std::filesystem::rename(folder / file, folder / "busts/" + file);
    }

    ProgramEnd cook(std::vector<std::string> arguments, const std::string& output = "all.hearth")
    {
        arguments.insert(arguments.begin(), {std::string(HEARTH_BIN) + "/hearth", "cook"});
        arguments.insert(arguments.end(), {"-o", output});
        return folder.run(arguments);
    }

    Sandbox folder;
};

const std::vector<std::string> kSources{"crate.obj", "busts/hero.obj", "barrel.obj", "post.obj"};
const std::string kWarning =
    "busts/hero.obj: warning: its largest side is 500 m, 250 times larger than that of the median of 4 "
    "sources, 2 m [W1410] hint: if its unit is wrong, set import.scale in a rule\n";

} // namespace

TEST_F(SizeOutliers, areNamedAsTheyWereTyped)
{
    const ProgramEnd end = cook(kSources);
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(countOccurrences(end.err, kWarning), 1u) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "[W1410]"), 1u) << "of one alone: " << end.err;
    EXPECT_EQ(countOccurrences(end.err,
                               "1 warning: 1 W1410 (a source is much larger or smaller than the others of "
                               "its cook)\n"),
              1u)
        << end.err;
}

TEST_F(SizeOutliers, areToldOrCountedWhenAllIsInTheCache)
{
    ASSERT_EQ(cook(kSources).exit_code, 0);
    const ProgramEnd again = cook(kSources);
    EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
    EXPECT_EQ(countOccurrences(again.err, kWarning), 0u) << "reported by the cook before: " << again.err;
    EXPECT_EQ(countOccurrences(again.err, "1 warning of unchanged sources, as in the cook before: 1 W1410"),
              1u)
        << again.err;

    std::vector<std::string> verbose = kSources;
    verbose.emplace_back("-v");
    EXPECT_EQ(countOccurrences(cook(verbose).err, kWarning), 1u);

    // the same from the cache alone under another name: the warning is repeated
    std::filesystem::rename(folder / "busts", folder / "heads");
    std::vector<std::string> elsewhere = kSources;
    elsewhere[1] = "heads/hero.obj";
    const ProgramEnd moved = cook(elsewhere, "other.hearth");
    EXPECT_EQ(countOccurrences(moved.err, "heads/hero.obj: warning: its largest side is 500 m"), 1u)
        << moved.err;
    EXPECT_EQ(countOccurrences(moved.err, "busts"), 0u) << moved.err;
}

TEST_F(SizeOutliers, mayCountAsErrorsAndMayBeLeftOut)
{
    std::vector<std::string> quiet = kSources;
    quiet.emplace_back("-q");
    EXPECT_EQ(cook(quiet).err, "");
    std::filesystem::remove(folder / "all.hearth");

    std::vector<std::string> fatal = kSources;
    fatal.emplace_back("--warnings-as-errors=W1410");
    const ProgramEnd end = cook(fatal);
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_EQ(countOccurrences(end.err, kWarning), 1u) << end.err;
    EXPECT_NE(end.err.find("not written, because warnings count as errors: 1"), std::string::npos) << end.err;
    EXPECT_FALSE(folder.has("all.hearth"));
    EXPECT_EQ(cook(fatal).exit_code, 1) << "and again from the cache";
}

TEST_F(SizeOutliers, standInTheReport)
{
    std::vector<std::string> arguments = kSources;
    arguments.insert(arguments.end(), {"--report", "all.json"});
    ASSERT_EQ(cook(arguments).exit_code, 0);
    const Json report = Json::parse(folder.read("all.json")).value();
    for (const Json& asset : report["assets"])
    {
        size_t outliers = 0;
        for (const Json& message : asset["messages"])
            outliers += message["code"] == "W1410" ? 1 : 0;
        EXPECT_EQ(outliers, asset["source"] == "busts/hero.obj" ? 1u : 0u) << asset["source"];
    }
}

TEST_F(SizeOutliers, ofTwoAndOfSourcesThatDrawNothingThereAreNone)
{
    EXPECT_EQ(countOccurrences(cook({"crate.obj", "busts/hero.obj"}).err, "W1410"), 0u);
    for (const char* name : {"sun.gltf", "moon.gltf"})
        folder.write(
            name, R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,)"
                  R"("scenes":[{"nodes":[0]}],"nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}],)"
                  R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional"}]}}})");
    const ProgramEnd lights = cook({"crate.obj", "busts/hero.obj", "sun.gltf", "moon.gltf"});
    EXPECT_EQ(lights.exit_code, 0) << lights.err;
    EXPECT_EQ(countOccurrences(lights.err, "W1410"), 0u) << lights.err;
}

TEST_F(SizeOutliers, mayBeTooSmallAsWell)
{
    writeObj(folder, "house", 60);
    writeObj(folder, "tower", 70);
    const ProgramEnd end = cook({"crate.obj", "house.obj", "tower.obj"});
    EXPECT_EQ(countOccurrences(
                  end.err, "crate.obj: warning: its largest side is 1 m, 60 times smaller than that of the "
                           "median of 3 sources, 60 m [W1410]"),
              1u)
        << end.err;
    // 2.5 m is a 24th of 60 m, and 3.5 m a 17th
    writeObj(folder, "door", 3.5);
    EXPECT_EQ(countOccurrences(cook({"door.obj", "house.obj", "tower.obj"}).err, "W1410"), 0u);
    EXPECT_EQ(countOccurrences(cook({"post.obj", "house.obj", "tower.obj"}).err, "[W1410]"), 1u);
}

} // namespace hearth::test
