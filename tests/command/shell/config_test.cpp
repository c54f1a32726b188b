// Tests settings as a user sees them: hearth config, and the effect of hearth.toml on a cook.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>

namespace hearth::test
{

namespace
{

class Settings : public ::testing::Test
{
protected:
    ProgramEnd hearth(std::vector<std::string> arguments, const std::vector<std::string>& environment = {})
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth");
        return folder.run(arguments, environment);
    }

    /// Return the actions that a cook would run: "textures props/a.glb".
    std::vector<std::string> wouldRun(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "cook");
        arguments.insert(arguments.end(), {"-o", "a.hearth", "--dry-run", "--format", "json"});
        const ProgramEnd end = hearth(arguments);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        plan = Json::parse(end.out).value_or(Json());
        std::vector<std::string> actions;
        for (const Json& action : plan["actions"])
            actions.push_back(action["cooker"].get<std::string>() + " " +
                              action["subject"].get<std::string>());
        return actions;
    }

    /// Return the words of one action of the plan.
    Json words(const std::string& cooker, const std::string& subject)
    {
        for (const Json& action : plan["actions"])
            if (action["cooker"] == cooker && action["subject"] == subject)
                return action["words"];
        return nullptr;
    }

    Sandbox folder;
    Json plan;
};

constexpr const char* kProject = R"([defaults]
jobs = 3
profile = "phone"

[profile.phone]
inherits = "mobile-low"

[[rule]]
match = "props/**/*.glb"
textures.max_size = 256
)";

} // namespace

TEST_F(Settings, areListedWithTheirOrigins)
{
    folder.write("hearth.toml", kProject);
    const ProgramEnd end = hearth({"config", "--show-origin"}, {"HEARTH_MEMORY=12G"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_NE(end.out.find("jobs                          3"), std::string::npos) << end.out;
    for (const char* origin : {"hearth.toml:2\n", "HEARTH_MEMORY\n", "hearth.toml:3\n",
                               "built in:10 (profile mobile-low)\n", "  default\n"})
        EXPECT_NE(end.out.find(origin), std::string::npos) << origin << "\n" << end.out;
    EXPECT_EQ(end.out.find("256"), std::string::npos) << "no source, no rule";

    const ProgramEnd json =
        hearth({"config", "props/a/b.glb", "--format", "json", "--set", "clusters.levels=[{keep=0.7}]"});
    ASSERT_EQ(json.exit_code, 0) << json.err;
    const Json listed = Json::parse(json.out).value();
    EXPECT_EQ(listed["schema"], "hearth.settings/1");
    EXPECT_EQ(listed["profile"], "phone");
    EXPECT_EQ(listed["files"], Json::array({"hearth.toml"}));
    std::map<std::string, Json> settings;
    for (const Json& setting : listed["settings"])
        settings[setting["key"].get<std::string>()] = setting;
    EXPECT_EQ(settings["textures.max_size"]["value"], 256);
    EXPECT_EQ(settings["textures.max_size"]["origin"], "hearth.toml:10 (rule props/**/*.glb)");
    EXPECT_EQ(settings["clusters.levels"]["value"][0]["keep"], 0.7);
    EXPECT_EQ(settings["visibility.power"]["value"], nullptr);
    EXPECT_EQ(settings["visibility.power"]["origin"], "default");
}

TEST_F(Settings, thatAreWrongNameTheirPlace)
{
    folder.write("hearth.toml", "[profile.pc]\nclusters.influence = 4\n");
    for (const std::vector<std::string>& verb :
         {std::vector<std::string>{"config"}, {"cook", "a", "-o", "b"}})
    {
        const ProgramEnd end = hearth(verb);
        EXPECT_EQ(end.exit_code, 78) << end.err;
        EXPECT_EQ(end.out, "");
        EXPECT_NE(
            end.err.find("hearth.toml|line 2, column 22, profile.pc.clusters.influence: error: this key "
                         "is not known: did you mean 'influences'? [E1501]"),
            std::string::npos)
            << end.err;
    }
    EXPECT_EQ(hearth({"config", "--config", "off"}).exit_code, 0);
    EXPECT_EQ(hearth({"--config", "off", "config"}).exit_code, 0);
    EXPECT_EQ(hearth({"config"}, {"HEARTH_CONFIG=off"}).exit_code, 0);
    EXPECT_EQ(hearth({"config", "--config", "none.toml"}).exit_code, 66);
}

TEST_F(Settings, reachTheCookersOfTheirSources)
{
    folder.write("hearth.toml", kProject);
    wouldRun({"props/a.glb", "b.glb", "--visibility"});
    EXPECT_EQ(words("textures", "props/a.glb")[3], "--max-size");
    EXPECT_EQ(words("textures", "props/a.glb")[4], "256");
    EXPECT_EQ(words("textures", "b.glb")[4], "1024");
    const std::string clusters = words("clusters", "b.glb").dump();
    EXPECT_NE(clusters.find(R"("--set","clusters.influences=4")"), std::string::npos) << clusters;
    EXPECT_EQ(plan.dump().find("hearth.toml"), std::string::npos) << "settings are in it by value";

    folder.write("hearth.toml", std::string(kProject) + "visibility.mode = \"off\"\n");
    const std::vector<std::string> actions = wouldRun({"props/a.glb", "b.glb"});
    const auto has = [&](const char* action)
    { return std::find(actions.begin(), actions.end(), action) != actions.end(); };
    EXPECT_FALSE(has("visibility props/a.glb"));
    EXPECT_TRUE(has("visibility b.glb"));
    EXPECT_TRUE(has("specular a.hearth"));
}

TEST_F(Settings, warnOfARuleThatMatchesNothing)
{
    std::filesystem::create_directories(folder / "assets/props");
    std::filesystem::create_directories(folder / "assets/trees");
    folder.write("assets/props/chair.gltf", "{}");
    folder.write("assets/trees/oak.glb", "");
    folder.write("hearth.toml", std::string(kProject) + "[[rule]]\nmatch = 'assets/trees/*'\n");
    const std::string warning =
        "hearth.toml|line 9, column 9, rule[0].match: warning: 'props/**/*.glb' matches no source; nearest: "
        "assets/props/chair.gltf, which 'assets/props/**/*.gl*' would match [W1513] hint: ";
    const std::vector<std::string> dry_run{"cook", "assets/props", "-o", "a.hearth", "--dry-run"};
    EXPECT_EQ(countOccurrences(hearth(dry_run).err, warning), 1u) << hearth(dry_run).err;
    EXPECT_EQ(countOccurrences(hearth(dry_run).err, "W1513"), 1u)
        << "the rule for trees is one for another cook";
    EXPECT_EQ(countOccurrences(hearth({"plan", "assets/props", "-o", "-"}).err, warning), 1u);
    EXPECT_EQ(hearth({"plan", "assets/props", "-o", "-", "-q"}).err, "");
    EXPECT_EQ(countOccurrences(hearth({"config"}).err, warning), 1u);
    EXPECT_EQ(hearth({"config", "assets/trees/oak.glb"}).err, "");

    std::filesystem::create_directories(folder / "elsewhere");
    folder.write("elsewhere/hearth.toml", kProject);
    EXPECT_NE(
        hearth({"cook", "assets/props", "-o", "a.hearth", "-n", "--config", "elsewhere/hearth.toml"})
            .err.find("'props/**/*.glb' matches no source: none lies in the folder of this file [W1513]"),
        std::string::npos);
    folder.write("hearth.toml", std::string(kProject) + "in_profile = 'desktop'\n");
    EXPECT_EQ(hearth(dry_run).err, "") << "the rule is not in force";
    std::filesystem::create_directories(folder / "props/old");
    folder.write("props/old/bench.glb", "");
    folder.write("hearth.toml", kProject);
    EXPECT_EQ(hearth(dry_run).err, "") << "a model that is not cooked this time";
}

TEST_F(Settings, workFromAnotherFolder)
{
    std::filesystem::create_directories(folder / "house/props");
    folder.write("house/hearth.toml", kProject);
    const ProgramEnd end = hearth({"-C", "house/props", "config", "a.glb", "--show-origin"});
    EXPECT_NE(end.out.find("../hearth.toml:10 (rule props/**/*.glb)"), std::string::npos)
        << end.out << end.err;
    EXPECT_EQ(hearth({"config", "-C", "house/props", "a.glb", "--show-origin"}).out, end.out);
    EXPECT_EQ(hearth({"-C", "nowhere", "config"}).exit_code, 66);
}

TEST_F(Settings, sourcesMayBeFoldersAndPatterns)
{
    for (const char* path :
         {"assets/b/c.GLB", "assets/b/wood.png", "assets/a.gltf", "assets/.old/x.glb", "d.obj"})
    {
        std::filesystem::create_directories(std::filesystem::path(folder / path).parent_path());
        folder.write(path, "");
    }
    const auto imported = [&](const std::vector<std::string>& words)
    {
        std::vector<std::string> sources;
        for (const std::string& action : wouldRun(words))
            if (action.starts_with("import "))
                sources.push_back(action.substr(7));
        return sources;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(imported({"assets/"}), (Names{"assets/a.gltf", "assets/b/c.GLB"}));
    EXPECT_EQ(imported({"assets"}), (Names{"assets/a.gltf", "assets/b/c.GLB"}));
    EXPECT_EQ(imported({"."}), (Names{"assets/a.gltf", "assets/b/c.GLB", "d.obj"}));
    EXPECT_EQ(imported({"d.obj", "assets"}), (Names{"d.obj", "assets/a.gltf", "assets/b/c.GLB"}));
    EXPECT_EQ(imported({"assets/**/*.png"}), (Names{"assets/b/wood.png"}));
    EXPECT_EQ(imported({"*.obj", "*/*.gltf"}), (Names{"d.obj", "assets/a.gltf"}));
    EXPECT_EQ(imported({"none.glb"}), (Names{"none.glb"})) << "for the import to complain of";
    folder.write("list.txt", "# sources\nassets/a.gltf\n\nd.obj\n--visibility\n");
    EXPECT_EQ(imported({"@list.txt"}), (Names{"assets/a.gltf", "d.obj"}));
    EXPECT_NE(plan.dump().find("visibility.part"), std::string::npos);

    std::filesystem::create_directories(folder / "empty");
    for (const char* word : {"empty", "assets/*.stl", "nowhere/*.stl"})
    {
        const ProgramEnd end = hearth({"cook", word, "-o", "a.hearth"});
        EXPECT_EQ(end.exit_code, 66) << word;
        EXPECT_NE(end.err.find(std::string(word) + ": error: "), std::string::npos) << end.err;
        EXPECT_NE(end.err.find("[E1512]"), std::string::npos) << end.err;
    }
    EXPECT_EQ(hearth({"cook", "@none.txt", "-o", "a.hearth"}).exit_code, 66);
}

} // namespace hearth::test
