// Tests settings files: accepted and rejected contents, and that the table of settings matches what the
// cookers accept.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/config_file.h"

#include "cook/clusters/program/profile.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/assignment.h"
#include "pipelines/profiles/built_in.h"
#include "pipelines/profiles/command_settings.h"

#include <gtest/gtest.h>

namespace hearth::profiles
{

using namespace settings;
using cookers::profileSettings;

namespace
{

void expectRefused(const std::string& text, Issue issue, const std::string& where, const std::string& detail)
{
    const auto file = parseConfig(text, "hearth.toml", true);
    ASSERT_FALSE(file.ok()) << text;
    EXPECT_EQ(file.error().issue, issue) << text;
    EXPECT_EQ(file.error().file, "hearth.toml");
    EXPECT_EQ(file.error().where, where) << text;
    EXPECT_NE(file.error().detail.find(detail), std::string::npos) << file.error().detail;
    EXPECT_EQ(exitCode(file.error()), 78);
}

std::string valueIn(const std::string& line)
{
    const auto profile = parseProfileFile(line, "house.toml");
    EXPECT_TRUE(profile.ok()) << line << ": " << (profile.ok() ? "" : formatMessage(profile.error()));
    return profile.ok() && profile->values.size() == 1 ? profile->values.begin()->second.text : "none";
}

} // namespace

TEST(ParseConfig, readsAProjectsFile)
{
    const auto file = parseConfig(R"(
[defaults]
jobs = 4
memory = "12G"
cache = ["dir:/a", "dir:/b,ro"]

[profile.pc]
inherits = "desktop"
clusters.normal_bits = 16
[profile.pc.clusters]
levels = [{ error_weight = 2, keep = 0.60 }]

[[rule]]
match = "props/**/*.glb"
in_profile = "mobile-*"
[rule.textures]
max_size = 512
)",
                                  "hearth.toml", true);
    // a dotted key and a table of the same name are not TOML
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().issue, Issue::profile_syntax);

    const auto right = parseConfig(R"(
[defaults]
jobs = 4
memory = "12G"
cache = ["dir:/a", "dir:/b,ro"]

[profile.pc]
inherits = "desktop"
[profile.pc.clusters]
normal_bits = 16
levels = [{ error_weight = 2, keep = 0.60 }]

[[rule]]
match = "props/**/*.glb"
in_profile = "mobile-*"
[rule.textures]
max_size = 512
)",
                                   "hearth.toml", true);
    ASSERT_TRUE(right.ok()) << formatMessage(right.error());
    EXPECT_EQ(right->defaults.at("jobs").text, "4");
    EXPECT_EQ(right->defaults.at("jobs").origin, "hearth.toml:3");
    EXPECT_EQ(right->defaults.at("memory").text, "12884901888");
    EXPECT_EQ(valueTexts(right->defaults.at("cache")), (std::vector<std::string>{"dir:/a", "dir:/b,ro"}));
    ASSERT_EQ(right->profiles.size(), 1u);
    EXPECT_EQ(right->profiles[0].inherits, "desktop");
    EXPECT_EQ(right->profiles[0].values.at("clusters.levels").text, "[{keep=0.6,error_weight=2}]");
    EXPECT_EQ(right->profiles[0].values.at("clusters.levels").origin, "hearth.toml:11 (profile pc)");
    ASSERT_EQ(right->rules.size(), 1u);
    EXPECT_EQ(right->rules[0].in_profile, "mobile-*");
    EXPECT_EQ(right->rules[0].values.at("textures.max_size").origin, "hearth.toml:17 (rule props/**/*.glb)");
}

TEST(ParseConfig, unknownKeysGetTheNearest)
{
    expectRefused("[default]\n", Issue::profile_key, "line 1, column 1, default", "'defaults'");
    expectRefused("[defaults]\n job = 3\n", Issue::profile_key, "line 2, column 8, defaults.job", "'jobs'");
    expectRefused("[profile.pc]\ninherit = 'desktop'\n", Issue::profile_key,
                  "line 2, column 11, profile.pc.inherit", "'inherits'");
    expectRefused("[profile.pc.cluster]\n", Issue::profile_key, "line 1, column 1, profile.pc.cluster",
                  "'clusters'");
    expectRefused("[profile.pc.textures]\nmaxsize = 3\n", Issue::profile_key,
                  "line 2, column 11, profile.pc.textures.maxsize", "'max_size'");
    expectRefused("[profile.pc.clusters]\nlevels = [{ keep = 0.5 }, { kep = 0.5 }]\n", Issue::profile_key,
                  "line 2, column 35, profile.pc.clusters.levels[1].kep", "'keep'");
    expectRefused("[[rule]]\nmatch = '*'\nvisibilty = 3\n", Issue::profile_key,
                  "line 3, column 13, rule[0].visibilty", "'visibility'");
    expectRefused("[[rule]]\nmatch = '*'\n[rule.bricks]\nenabled = true\n", Issue::profile_key,
                  "line 3, column 1, rule[0].bricks", "of all sources together");
    EXPECT_EQ(parseConfig("[[rule]]\nmatch = '*'\n", "config.toml", false).error().issue, Issue::profile_key);
}

TEST(ParseConfig, valuesAreTypedAndInRange)
{
    struct Row
    {
        const char* line;
        const char* where;
        const char* detail;
    };
    for (const Row& row : {
             Row{"textures.max_size = 0", "textures.max_size", "a whole number from 1 to 16384"},
             Row{"textures.max_size = 16385", "textures.max_size", "a whole number from 1 to 16384"},
             Row{"textures.max_size = 3.0", "textures.max_size", "a whole number"},
             Row{"visibility.refine = 1", "visibility.refine", "true or false"},
             Row{"visibility.mode = true", "visibility.mode", "one of auto, on, off"},
             Row{"visibility.quality = 'hihg'", "visibility.quality", "did you mean 'high'?"},
             Row{"visibility.distance = 0", "visibility.distance", "a number above 0"},
             Row{"visibility.distance = inf", "visibility.distance", "a number above 0"},
             Row{"visibility.power = nan", "visibility.power", "a number from 0 to 16"},
             Row{"visibility.poses = 3", "visibility.poses", "an array of texts"},
             Row{"visibility.poses = ['Run', 3]", "visibility.poses[1]", "a text"},
             Row{"bricks.memory = '3X'", "bricks.memory", "a size"},
             Row{"bricks.memory = -1", "bricks.memory", "a size"},
             Row{"clusters.influences = 5", "clusters.influences", "4 or 8"},
             Row{"clusters.levels = []", "clusters.levels", "at least one table"},
             Row{"clusters.levels = [{ keep = 0.95 }]", "clusters.levels[0].keep", "from 0.05 to 0.9"},
             Row{"clusters.mesh = [{ influences = 4 }]", "clusters.mesh[0].name", "is missing"},
             Row{"clusters.mesh = 3", "clusters.mesh", "an array"},
             // each is allowed, but not both
             Row{"clusters.mesh = [{ name = 'a', targets = [{ level = 2, triangles = 9 }, { level = 1, "
                 "triangles = 5 }] }]",
                 "clusters.mesh", "a higher level and fewer triangles"},
         })
    {
        const auto profile = parseProfileFile(row.line, "house.toml");
        ASSERT_FALSE(profile.ok()) << row.line;
        EXPECT_EQ(profile.error().issue, Issue::profile_value) << row.line;
        EXPECT_TRUE(profile.error().where.starts_with("line 1, column ")) << profile.error().where;
        EXPECT_TRUE(profile.error().where.ends_with(std::string(", ") + row.where)) << profile.error().where;
        EXPECT_NE(profile.error().detail.find(row.detail), std::string::npos) << profile.error().detail;
    }
    const auto syntax = parseProfileFile("a = \n", "house.toml");
    EXPECT_EQ(syntax.error().issue, Issue::profile_syntax);
    EXPECT_TRUE(syntax.error().where.starts_with("line 1, column ")) << syntax.error().where;
}

TEST(ParseConfig, whatMeansTheSameIsWrittenTheSame)
{
    for (const char* line : {"animation.error = 1", "animation.error = 1.0", "[animation]\nerror = 1e0"})
        EXPECT_EQ(valueIn(line), "1") << line;
    for (const char* line : {"bricks.memory = '1M'", "bricks.memory = 1048576", "bricks.memory = '1024K'"})
        EXPECT_EQ(valueIn(line), "1048576") << line;
    for (const char* line : {"clusters.levels = [{error_weight=2.0,keep=0.50}]",
                             "[[clusters.levels]]\nkeep = 5e-1\nerror_weight = 2"})
        EXPECT_EQ(valueIn(line), "[{keep=0.5,error_weight=2}]") << line;
    for (const char* line : {"visibility.poses = 'Run'", "visibility.poses = ['Run']"})
        EXPECT_EQ(valueIn(line), "[\"Run\"]") << line;
    EXPECT_EQ(valueIn(R"(clusters.mesh = [{ influences = 4, name = "a\"\\\u0001" }])"),
              R"([{name="a\"\\\u0001",influences=4}])");
}

TEST(ValueOf, readsWordsAsFilesWouldSay)
{
    const auto text = [](const char* assignment)
    {
        const auto parsed = parseAssignment(assignment);
        return parsed.ok() ? parsed->second.text : formatMessage(parsed.error());
    };
    EXPECT_EQ(text("clusters.influences=4"), "4");
    EXPECT_EQ(text("visibility.quality=high"), "\"high\"");
    EXPECT_EQ(text("visibility.quality=\"high\""), "\"high\"");
    EXPECT_EQ(text("visibility.poses=Run"), "[\"Run\"]");
    EXPECT_EQ(text("visibility.poses=['Run', 'Walk@1']"), "[\"Run\",\"Walk@1\"]");
    EXPECT_EQ(text("bricks.memory=2K"), "2048");
    EXPECT_EQ(text("visibility.refine=true"), "true");
    EXPECT_EQ(text("clusters.levels=[{ keep = 0.7 }]"), "[{keep=0.7}]");
    EXPECT_NE(text("clusters.influence=4").find("did you mean 'clusters.influences'?"), std::string::npos);
    EXPECT_NE(text("clusters.influences=5").find("must be 4 or 8"), std::string::npos);
    EXPECT_NE(text("clusters.influences=]").find("must be 4 or 8"), std::string::npos);
    EXPECT_NE(text("clusters.influences").find("KEY=VALUE"), std::string::npos);
    EXPECT_NE(text("clusters.levels=[{keep=9}]").find("[0].keep: error: must be a number"),
              std::string::npos);
}

namespace
{

std::string clustersAt(const Setting& setting, const std::string& value)
{
    if (setting.kind == Kind::tables)
        return "";
    const auto read = clusters::parseProfile(setting.key + "=" + value, "");
    return read.ok() ? "" : read.error().detail;
}

} // namespace

TEST(ProfileSettings, rangesAreThoseOfTheCookers)
{
    size_t checked = 0;
    for (const Setting& setting : profileSettings())
    {
        if (settingGroup(setting.key) != "clusters" || setting.kind == Kind::tables)
            continue;
        ++checked;
        if (!setting.choices.empty())
        {
            for (const std::string_view choice : setting.choices)
                EXPECT_EQ(clustersAt(setting, std::string(choice)), "") << setting.key;
            EXPECT_NE(clustersAt(setting, "5"), "") << setting.key;
            continue;
        }
        EXPECT_EQ(clustersAt(setting, std::to_string(setting.low)), "") << setting.key;
        EXPECT_EQ(clustersAt(setting, std::to_string(setting.high)), "") << setting.key;
        EXPECT_NE(clustersAt(setting, std::to_string(setting.low - 1)), "") << setting.key;
        EXPECT_NE(clustersAt(setting, std::to_string(setting.high * 1.1)), "") << setting.key;
    }
    EXPECT_EQ(checked, 4u);
}

TEST(ProfileSettings, eachSaysWhatItIs)
{
    for (const auto& settings : {profileSettings(), commandSettings()})
        for (const Setting& setting : settings)
        {
            EXPECT_FALSE(setting.what.empty()) << setting.key;
            EXPECT_EQ(findSetting(settings, setting.key), &setting);
            EXPECT_EQ(setting.kind == Kind::tables, !setting.members.empty()) << setting.key;
        }
}

TEST(BuiltIn, hasTheFourProfiles)
{
    ASSERT_EQ(builtInProfiles().profiles.size(), 4u);
    EXPECT_EQ(builtInProfiles().profiles[0].name, "desktop");
    EXPECT_EQ(builtInProfiles().profiles[1].name, "gles3");
    EXPECT_EQ(builtInProfiles().profiles[2].name, "mobile-high");
    EXPECT_EQ(builtInProfiles().profiles[3].name, "mobile-low");
}

} // namespace hearth::profiles
