// Tests effective settings: their origins and precedence.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/configuration.h"

#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/command_settings.h"
#include "tests/support/sandbox.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace hearth::profiles
{

namespace
{

namespace fs = std::filesystem;
using namespace settings;

class Configurations : public ::testing::Test
{
protected:
    Configurations() : before_(fs::current_path())
    {
        fs::create_directories(folder / "home/.config/hearth");
        fs::create_directories(folder / "house/props/small");
        enter("house");
    }
    ~Configurations() override { fs::current_path(before_); }

    void enter(const std::string& name) { fs::current_path(folder / name); }

    Result<Configuration> load(CommandLineValues given = {})
    {
        return Configuration::load(std::move(given),
                                   [&](const char* name) -> std::optional<std::string>
                                   {
                                       const auto found = environment.find(name);
                                       return found == environment.end() ? std::nullopt
                                                                         : std::optional(found->second);
                                   });
    }

    /// Return "512 from hearth.toml:3" for a source's setting, or for a command's setting if `source` is
    /// empty.
    std::string what(const std::string& key, const std::string& source, CommandLineValues given = {})
    {
        const auto configuration = load(std::move(given));
        if (!configuration.ok())
            return formatMessage(configuration.error());
        const Value* command = configuration->command(key);
        const Values values = configuration->valuesOfSource(source);
        const auto found = values.find(key);
        const Value* value = source.empty() ? command : found == values.end() ? nullptr : &found->second;
        return value == nullptr ? "none" : value->text + " from " + value->origin;
    }

    static CommandLineValues withFlag(const char* key, const char* text)
    {
        CommandLineValues given;
        (findSetting(commandSettings(), key) != nullptr ? given.command : given.settings)[key] = {text,
                                                                                                  "--flag"};
        return given;
    }

    test::Sandbox folder;
    std::map<std::string, std::string> environment{{"HOME", folder / "home"}};

private:
    fs::path before_;
};

} // namespace

TEST_F(Configurations, rulesByPathAreThoseOfTheSource)
{
    folder.write("house/hearth.toml", "[defaults]\nprofile = 'p'\n[profile.p]\n"
                                      "[[profile.p.textures.image]]\npath = 'props/**'\nformat = 'plain'\n"
                                      "[[profile.p.textures.image]]\nname = 'a*'\ntarget = 38\n"
                                      "[[profile.p.textures.image]]\nname = 'b'\npath = '*.glb'\n"
                                      "quality = 'high'\n");
    const auto rules = [&](const std::string& source)
    {
        const Values values = load()->valuesOfSource(source);
        const Value* value = findValue(values, "textures.image");
        return value == nullptr ? Value{"none", ""} : *value;
    };
    EXPECT_EQ(rules("props/small/a.glb").text, R"([{name="*",format="plain"},{name="a*",target=38}])");
    EXPECT_EQ(rules("props/small/a.glb").rule_numbers, (std::vector<size_t>{0, 1}));
    EXPECT_EQ(rules("a.glb").text, R"([{name="a*",target=38},{name="b",quality="high"}])");
    EXPECT_EQ(rules("a.glb").rule_numbers, (std::vector<size_t>{1, 2}));
    EXPECT_EQ(rules("low/a.glb").text, R"([{name="a*",target=38}])");
    // from another folder, and where nothing is left
    enter("house/props");
    folder.write("house/hearth.toml", "[defaults]\nprofile = 'p'\n[profile.p]\n"
                                      "textures.image = [{path='props/a.glb',target=30}]\n");
    EXPECT_EQ(rules("a.glb").text, R"([{name="*",target=30}])");
    EXPECT_EQ(rules("b.glb").text, "none");
    EXPECT_EQ(rules("../../a.glb").text, "none") << "outside of the project";
    // without a project the path is that of the command line
    enter("");
    CommandLineValues given;
    given.settings["textures.image"] = {R"([{path="x/*",target=30}])", "--set"};
    const auto configuration = load(given);
    ASSERT_TRUE(configuration.ok());
    EXPECT_EQ(configuration->valuesOfSource("x/a.glb").at("textures.image").text,
              R"([{name="*",target=30}])");
    EXPECT_FALSE(configuration->valuesOfSource("y/a.glb").contains("textures.image"));
}

TEST_F(Configurations, flagsWinOverEnvironmentProjectAndUser)
{
    EXPECT_EQ(what("jobs", ""), "none");
    folder.write("home/.config/hearth/config.toml", "[defaults]\njobs = 1\n");
    EXPECT_EQ(what("jobs", ""), "1 from " + folder / "home/.config/hearth/config.toml:2");
    folder.write("house/hearth.toml", "[defaults]\njobs = 2\n");
    EXPECT_EQ(what("jobs", ""), "2 from hearth.toml:2");
    environment["HEARTH_JOBS"] = "3";
    EXPECT_EQ(what("jobs", ""), "3 from HEARTH_JOBS");
    EXPECT_EQ(what("jobs", "", withFlag("jobs", "4")), "4 from --flag");
    environment["HEARTH_JOBS"] = "many";
    EXPECT_NE(what("jobs", "").find("HEARTH_JOBS: error: 'many' must be a whole number from 1 to 1024"),
              std::string::npos)
        << what("jobs", "");
}

TEST_F(Configurations, colourIsOfVariablesThatManyProgramsKnow)
{
    folder.write("house/hearth.toml", "[defaults]\ncolor = 'always'\nlog = 'quiet'\n");
    environment["NO_COLOR"] = "0";
    EXPECT_EQ(what("color", ""), "\"always\" from hearth.toml:2");
    environment["CLICOLOR_FORCE"] = "1";
    EXPECT_EQ(what("color", ""), "\"always\" from CLICOLOR_FORCE");
    environment["NO_COLOR"] = "yes";
    EXPECT_EQ(what("color", ""), "\"never\" from NO_COLOR");
    EXPECT_EQ(what("color", "", withFlag("color", "\"auto\"")), "\"auto\" from --flag");
    EXPECT_EQ(what("log", ""), "\"quiet\" from hearth.toml:3");
    environment["HEARTH_LOG"] = "loud";
    EXPECT_NE(what("log", "").find("HEARTH_LOG: error: 'loud' must be one of quiet, normal, verbose"),
              std::string::npos)
        << what("log", "");
}

TEST_F(Configurations, theProjectsFileIsFoundUpwards)
{
    folder.write("house/hearth.toml", "[defaults]\njobs = 2\n");
    enter("house/props/small");
    EXPECT_EQ(what("jobs", ""), "2 from ../../hearth.toml:2");
    folder.write("other.toml", "[defaults]\njobs = 5\n");
    environment["HEARTH_CONFIG"] = folder / "other.toml";
    EXPECT_EQ(what("jobs", ""), "5 from " + folder / "other.toml:2");
    CommandLineValues given;
    given.config_file = "../../hearth.toml";
    EXPECT_EQ(what("jobs", "", given), "2 from ../../hearth.toml:2");
    given.config_file = "off";
    EXPECT_EQ(what("jobs", "", given), "none");
    environment["HEARTH_CONFIG"] = "off";
    EXPECT_EQ(what("jobs", ""), "none");
    environment["HEARTH_CONFIG"] = "missing.toml";
    EXPECT_EQ(load().error().issue, Issue::input_missing);
}

TEST_F(Configurations, profilesInherit)
{
    folder.write("house/hearth.toml",
                 "[defaults]\nprofile = 'phone'\n"
                 "[profile.phone]\ninherits = 'mobile-low'\nanimation.error = 0.5\n"
                 "[profile.mobile-low]\ninherits = 'mobile-low'\ntextures.max_size = 256\n");
    EXPECT_EQ(what("animation.error", "a.glb"), "0.5 from hearth.toml:5 (profile phone)");
    EXPECT_EQ(what("textures.max_size", "a.glb"), "256 from hearth.toml:8 (profile mobile-low)");
    EXPECT_EQ(what("clusters.influences", "a.glb").substr(0, 15), "4 from built in");
    EXPECT_EQ(what("clusters.normal_bits", "a.glb").substr(0, 15), "8 from built in") << "of mobile-high";
    environment["HEARTH_PROFILE"] = "desktop";
    EXPECT_EQ(what("animation.error", "a.glb"), "none");
    EXPECT_EQ(what("textures.max_size", "a.glb").substr(0, 18), "4096 from built in");
}

TEST_F(Configurations, profilesThatAreWrongAreNamed)
{
    EXPECT_NE(what("jobs", "", withFlag("profile", "\"mobil-low\""))
                  .find("there is no profile 'mobil-low': did you mean 'mobile-low'?"),
              std::string::npos);
    folder.write("house/hearth.toml",
                 "[profile.a]\ninherits = 'b'\n[profile.b]\ninherits = 'c'\n[profile.c]\ninherits = 'a'\n");
    const auto circle = load(withFlag("profile", "\"a\""));
    ASSERT_FALSE(circle.ok());
    EXPECT_EQ(circle.error().issue, Issue::profile_circle);
    EXPECT_EQ(circle.error().where, "line 6, column 12, profile.c.inherits");
    EXPECT_EQ(exitCode(circle.error()), 78);
    folder.write("house/hearth.toml", "[profile.a]\ninherits = 'desk'\n");
    EXPECT_EQ(load(withFlag("profile", "\"a\"")).error().issue, Issue::profile_unknown);
    folder.write("house/hearth.toml", "[profile.a]\ninherits = 'a'\n");
    EXPECT_EQ(load(withFlag("profile", "\"a\"")).error().issue, Issue::profile_unknown);
}

TEST_F(Configurations, aProfileMayBeAFile)
{
    folder.write("house/props/own.toml", "inherits = 'mobile-low'\n[clusters]\ninfluences = 8\n");
    EXPECT_EQ(what("clusters.influences", "a.glb", withFlag("profile", "\"props/own.toml\"")),
              "8 from props/own.toml:3");
    EXPECT_EQ(what("textures.max_size", "a.glb", withFlag("profile", "\"props/own.toml\"")).substr(0, 13),
              "1024 from bui");
    EXPECT_EQ(load(withFlag("profile", "\"none.toml\"")).error().issue, Issue::input_missing);
    // paths in a file are relative to that file's folder
    folder.write("house/hearth.toml", "[defaults]\nprofile = 'props/own.toml'\n");
    enter("house/props/small");
    EXPECT_EQ(what("clusters.influences", "a.glb"), "8 from ../../props/own.toml:3");
}

TEST_F(Configurations, rulesMatchPathsInTheProject)
{
    folder.write("house/hearth.toml",
                 "[[rule]]\nmatch = 'props/**/*.glb'\ntextures.max_size = 512\n"
                 "[[rule]]\nmatch = 'props/small/*'\ntextures.max_size = 64\n"
                 "[[rule]]\nmatch = '**'\nin_profile = 'mobile-*'\nanimation.error = 1\n");
    EXPECT_EQ(what("textures.max_size", "props/a.glb"), "512 from hearth.toml:3 (rule props/**/*.glb)");
    EXPECT_EQ(what("textures.max_size", "props/small/a.glb"), "64 from hearth.toml:6 (rule props/small/*)");
    EXPECT_EQ(what("textures.max_size", "a.glb"), "none");
    EXPECT_EQ(what("textures.max_size", "props/a.glb", withFlag("textures.max_size", "32")),
              "32 from --flag");
    EXPECT_EQ(what("textures.max_size", "../other/props/a.glb"), "none");
    enter("house/props");
    EXPECT_EQ(what("textures.max_size", "./a.glb"), "512 from ../hearth.toml:3 (rule props/**/*.glb)");
    EXPECT_EQ(what("textures.max_size", folder / "house/props/a.glb").substr(0, 4), "512 ");
    EXPECT_EQ(what("animation.error", "a.glb"), "none");
    EXPECT_EQ(what("animation.error", "a.glb", withFlag("profile", "\"mobile-high\"")).substr(0, 2), "1 ");
    EXPECT_EQ(what("animation.error", "a.glb", withFlag("profile", "\"desktop\"")), "none");
}

namespace
{

using Words = std::vector<std::string>;

/// Return the words that settings make for a cooker.
Words wordsFor(std::string_view cooker, const settings::Values& values)
{
    return cookers::findCooker(cooker)->makeArguments(values).value().words;
}

} // namespace

TEST(Arguments, giveEachCookerItsOwnSettings)
{
    const auto profile = parseProfileFile(
        "import.crease_angle = 30\nimport.scale = 0.01\nimport.up = 'z'\n"
        "animation.error = 0.25\n"
        "clusters.influences = 4\nclusters.levels = [{ keep = 0.6 }]\n"
        "textures.max_size = 64\ntextures.max_bits = 8\ntextures.budget = '1M'\nvisibility.mode = 'on'\n"
        "visibility.quality = 'draft'\nvisibility.distance = 2\n"
        "visibility.power = 1\nvisibility.poses = ['Run', 'Walk']\n"
        "visibility.refine = true\nvisibility.occluders = 'mesh'\n"
        "proxy.from = 'wrap'\nproxy.error = 0.01\nproxy.triangles = 500\nproxy.holes = 0.5\n"
        "proxy.convex_parts = 4\nproxy.convex_error = 0.1\n"
        "proxy.bindings = true\nproxy.alpha = 0.1\nproxy.offset = 0.01\n"
        "bricks.mode = 'on'\nbricks.voxel_size = 0.5\n"
        "bricks.memory = '1M'\nbricks.inside = 'source'\nenvironment.file = 'sky.hdr'\n"
        "receivers.mode = 'on'\nreceivers.texels_per_metre = 8\nreceivers.lights = 3\n"
        "receivers.codec = 'rgbm'\nreceivers.bounces = 2\n"
        "reflections.probes = ['1,2,3', '1,1,1:0,0,0:4,3,5:0.5']\nreflections.face_size = 32\n",
        "house.toml");
    ASSERT_TRUE(profile.ok()) << formatMessage(profile.error());
    const settings::Values& values = profile->values;
    EXPECT_TRUE(cookers::checkSourceSettings(values).ok());
    EXPECT_EQ(wordsFor("import", values), (Words{"--crease-angle", "30", "--scale", "0.01", "--up", "z",
                                                 "--set", "animation.error=0.25"}));
    EXPECT_EQ(wordsFor("textures", values), (Words{"--max-size", "64", "--max-bits", "8"}));
    EXPECT_EQ(wordsFor("clusters", values),
              (Words{"--set", "clusters.influences=4", "--set", "clusters.levels=[{keep=0.6}]",
                     "--no-discrete-lods", "--visibility"}));
    EXPECT_EQ(wordsFor("visibility", values),
              (Words{"--quality", "draft", "--occluders", "mesh", "--distance", "2", "--power", "1",
                     "--poses", "Run", "--poses", "Walk", "--refine-cones", "--no-noise-estimate"}));
    EXPECT_EQ(wordsFor("proxy", values),
              (Words{"--error", "0.01", "--triangles", "500", "--holes", "0.5", "--convex-parts", "4",
                     "--convex-error", "0.1", "--bindings"}));
    EXPECT_EQ(wordsFor("wrap", values),
              (Words{"--alpha", "0.1", "--offset", "0.01", "--error", "0.01", "--triangles", "500"}));
    EXPECT_EQ(wordsFor("bricks", values), (Words{"--voxel-size", "0.5", "--memory", "1048576"}));
    EXPECT_EQ(wordsFor("receivers", values),
              (Words{"--texels-per-metre", "8", "--lights", "3", "--codec", "rgbm", "--bounces", "2"}));
    EXPECT_EQ(wordsFor("reflections", values),
              (Words{"--at", "1,2,3", "--at", "1,1,1:0,0,0:4,3,5:0.5", "--face-size", "32"}));
    const std::vector<settings::Values> sources{values};
    for (const cookers::Cooker& cooker : cookers::allCookers())
        EXPECT_TRUE(cookers::isEnabled(cooker, values, sources)) << cooker.name;
}

TEST(Arguments, omitUnsetSettings)
{
    EXPECT_EQ(wordsFor("import", {}), Words());
    EXPECT_EQ(wordsFor("textures", {}), Words());
    EXPECT_EQ(wordsFor("clusters", {}), (Words{"--no-discrete-lods", "--visibility"}));
    EXPECT_EQ(wordsFor("bricks", {}), Words{"--if-needed"});
    EXPECT_EQ(wordsFor("receivers", {}), Words());
    EXPECT_EQ(wordsFor("proxy", {}), Words{"--authored"});
    const std::vector<settings::Values> plain_source(1), cleaned_source{{{"proxy.from", {"\"clean\"", ""}}}};
    for (const char* name : {"proxy", "wrap"})
        EXPECT_FALSE(cookers::isEnabled(*cookers::findCooker(name), {}, plain_source)) << name;
    EXPECT_TRUE(cookers::isEnabled(*cookers::findCooker("proxy"), {}, cleaned_source));
    EXPECT_FALSE(cookers::isEnabled(*cookers::findCooker("wrap"), {}, cleaned_source));
    EXPECT_FALSE(cookers::isEnabled(*cookers::findCooker("probe"), {}, {}));
    EXPECT_FALSE(cookers::isEnabled(*cookers::findCooker("receivers"), {}, {}));
    EXPECT_FALSE(cookers::isEnabled(*cookers::findCooker("reflections"), {}, {}));
    const settings::Values off{{"visibility.mode", {"\"off\"", ""}}, {"bricks.mode", {"\"off\"", ""}}};
    EXPECT_EQ(wordsFor("clusters", off), Words{"--no-discrete-lods"});
    const std::vector<settings::Values> plain_sources(1), sources_off{off};
    for (const char* name : {"visibility", "specular", "bricks"})
    {
        EXPECT_TRUE(cookers::isEnabled(*cookers::findCooker(name), {}, plain_sources)) << name;
        EXPECT_FALSE(cookers::isEnabled(*cookers::findCooker(name), off, sources_off)) << name;
    }
    const auto power = parseProfileFile("visibility.mode = 'on'\nvisibility.power = 1\n", "house.toml");
    EXPECT_EQ(cookers::checkSourceSettings(power->values).error().issue, Issue::profile_value);
}

} // namespace hearth::profiles
