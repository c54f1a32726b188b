// Tests hearth cook --missing: a pack is made without the sources that cannot be cooked, and says so.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/cook_folder.h"
#include "tests/support/json_schema.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

class Missing : public Cook
{
protected:
    ProgramEnd cookSkipping(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.end(), {"-o", "a.hearth", "--missing", "skip"});
        return cook(std::move(arguments));
    }

    Json inspect(const std::string& pack)
    {
        const ProgramEnd end = folder.run({programs / "hearth", "inspect", pack, "--format", "json"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        Json json = Json::parse(end.out).value_or(Json());
        EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.inspect.1.json", json), "");
        return json;
    }

    std::string inspectText(const std::string& pack)
    {
        return folder.run({programs / "hearth", "inspect", pack}).out;
    }
};

} // namespace

TEST_F(Missing, isAnErrorUnlessSkipped)
{
    const std::vector<std::string> sources{"good.gltf", "malformed.gltf", "-o", "a.hearth"};
    std::vector<std::string> error = sources;
    error.insert(error.end(), {"--missing", "error"});
    for (const std::vector<std::string>& arguments : {sources, error})
    {
        EXPECT_EQ(cook(arguments).exit_code, 65);
        EXPECT_FALSE(folder.has("a.hearth"));
    }
}

TEST_F(Missing, skipsASourceWhoseImportFails)
{
    const ProgramEnd end = cookSkipping({"good.gltf", "props/malformed.gltf", "warning.gltf"});
    EXPECT_EQ(end.exit_code, 1) << end.err;
    EXPECT_NE(end.err.find("props/malformed.gltf|/meshes/0: error: is bad [E1101]"), std::string::npos)
        << end.err;
    EXPECT_NE(end.err.find("a.hearth: made without 1 of 3 sources: props/malformed.gltf\n"),
              std::string::npos)
        << end.err;
    EXPECT_NE(end.err.find("cooked  "), std::string::npos) << end.err;
    const Json json = inspect("a.hearth");
    EXPECT_EQ(json["assets"].size(), 2u);
    ASSERT_EQ(json["skipped"].size(), 1u);
    EXPECT_EQ(
        json["skipped"][0],
        (Json{
            {"source", "malformed.gltf"}, {"code", "E1101"}, {"pointer", "/meshes/0"}, {"text", "is bad"}}));
    EXPECT_NE(inspectText("a.hearth").find("skipped    E1101 malformed.gltf|/meshes/0: is bad\n"),
              std::string::npos);
    EXPECT_EQ(folder.run({programs / "hearth", "verify", "a.hearth"}).exit_code, 0);
}

TEST_F(Missing, skipsTheWholeSourceWhoseLaterCookersFail)
{
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--no-cache"}, {"--bricks"}})
    {
        std::filesystem::remove(folder / "a.hearth");
        std::vector<std::string> arguments{"halfway.gltf", "good.gltf"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramEnd end = cookSkipping(arguments);
        EXPECT_EQ(end.exit_code, 1) << end.err;
        const Json json = inspect("a.hearth");
        EXPECT_EQ(json["assets"].size(), 1u);
        ASSERT_EQ(json["skipped"].size(), 2u) << "textures and clusters have failed, each says why";
        for (const char* code : {"E2009", "E2010"})
        {
            EXPECT_NE(end.err.find(code), std::string::npos) << end.err;
            EXPECT_NE(json.dump().find(code), std::string::npos);
        }
        EXPECT_NE(end.err.find("made without 1 of 2 sources: halfway.gltf\n"), std::string::npos) << end.err;
    }
}

TEST_F(Missing, makesNoPackOfNoSource)
{
    EXPECT_EQ(cook({"good.gltf", "-o", "a.hearth"}).exit_code, 0);
    const std::string before = folder.read("a.hearth");
    const ProgramEnd end = cookSkipping({"malformed.gltf", "malformed2.gltf"});
    EXPECT_EQ(end.exit_code, 65) << end.err;
    EXPECT_NE(end.err.find("not linked, because a dependency failed: 2 of 2 sources"), std::string::npos)
        << end.err;
    EXPECT_EQ(folder.read("a.hearth"), before);
    EXPECT_EQ(cookSkipping({"malformed.gltf", "missing.gltf"}).exit_code, 1) << "65 and 66";
    EXPECT_EQ(folder.read("a.hearth"), before);
}

TEST_F(Missing, doesNotExcuseTheActionsOfThePack)
{
    const ProgramEnd end = cookSkipping({"good.gltf", "malformed.gltf", "--bricks", "--voxel-size", "7"});
    EXPECT_EQ(end.exit_code, 1) << end.err;
    EXPECT_FALSE(folder.has("a.hearth"));
}

TEST_F(Missing, doesNotExcuseWarningsThatCountAsErrors)
{
    EXPECT_EQ(cookSkipping({"warning.gltf", "malformed.gltf", "--warnings-as-errors"}).exit_code, 1);
    EXPECT_FALSE(folder.has("a.hearth"));
}

TEST_F(Missing, contradictsFailFast)
{
    const ProgramEnd end = cookSkipping({"good.gltf", "--fail-fast"});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_NE(end.err.find("--fail-fast"), std::string::npos) << end.err;
}

TEST_F(Missing, reportsWhatThePackLacks)
{
    const ProgramEnd end = cookSkipping(
        {"good.gltf", "malformed.gltf", "--report", "r.json", "--report", "r.xml", "--depfile", "a.d"});
    EXPECT_EQ(end.exit_code, 1) << end.err;
    const auto report = Json::parse(folder.read("r.json")).value();
    EXPECT_EQ(faultOfSchema(HEARTH_SCHEMAS "/hearth.report.1.json", report), "");
    EXPECT_EQ(report["status"], "incomplete");
    EXPECT_EQ(report["exit"], 1);
    EXPECT_EQ(report["skipped"], (Json::array({"malformed.gltf"})));
    EXPECT_EQ(report["link"]["state"], "cooked");
    ASSERT_EQ(report["failures"].size(), 1u);
    EXPECT_EQ(report["failures"][0]["not_made"].size(), 4u) << "the cookers of the source, and not the link";
    EXPECT_EQ(report["totals"]["bytes_out"], folder.read("a.hearth").size());
    EXPECT_TRUE(report["totals"].contains("sizes"));
    EXPECT_NE(folder.read("r.xml").find("not complete: a source could not be cooked"), std::string::npos);
    EXPECT_NE(folder.read("a.d").find("malformed.gltf"), std::string::npos) << "make waits for its mend";
}

TEST_F(Missing, isToldAgainByASecondCook)
{
    const std::vector<std::string> sources{"good.gltf", "malformed.gltf"};
    EXPECT_EQ(cookSkipping(sources).exit_code, 1);
    const std::string pack = folder.read("a.hearth");
    const ProgramEnd again = cookSkipping(sources);
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
    EXPECT_NE(again.err.find("made without 1 of 2 sources: malformed.gltf"), std::string::npos) << again.err;
    EXPECT_EQ(folder.read("a.hearth"), pack);
}

} // namespace hearth::test
