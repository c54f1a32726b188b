// Tests everything generated from the table of options: shell completion, manual pages, schemas; and hearth
// doctor.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/json_schema.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <optional>
#include <sstream>

namespace hearth::test
{

namespace
{

class Manual : public ::testing::Test
{
protected:
    ProgramEnd hearth(std::vector<std::string> arguments, const std::vector<std::string>& environment = {})
    {
        arguments.insert(arguments.begin(), HEARTH_BIN "/hearth");
        return folder.run(arguments, environment);
    }

    ProgramEnd shell(const std::string& script) { return folder.run({"/bin/bash", "-c", script}); }

    bool has(const std::string& program) { return shell("command -v " + program).exit_code == 0; }

    /// Return the completions that bash offers after the last word, sorted.
    std::vector<std::string> completed(const std::vector<std::string>& words)
    {
        std::string array;
        for (const std::string& word : words)
            array += " '" + word + "'";
        const ProgramEnd end = shell("source hearth.bash; COMP_WORDS=(hearth" + array +
                                     "); COMP_CWORD=" + std::to_string(words.size()) +
                                     "; _hearth; printf '%s\\n' \"${COMPREPLY[@]}\"");
        EXPECT_EQ(end.exit_code, 0) << end.err;
        EXPECT_EQ(end.err, "");
        std::vector<std::string> offered;
        std::istringstream lines(end.out);
        for (std::string line; std::getline(lines, line);)
            offered.push_back(line);
        std::sort(offered.begin(), offered.end());
        return offered;
    }

    Sandbox folder;
};

using Words = std::vector<std::string>;

bool holds(const Words& words, const std::string& word)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

TEST_F(Manual, bashCompletesVerbsOptionsWordsAndFiles)
{
    folder.write("hearth.bash", hearth({"completion", "bash"}).out);
    std::filesystem::create_directory(folder / "assets");
    folder.write("assets/a.glb", "");
    EXPECT_EQ(completed({"coo"}), Words{"cook"});
    EXPECT_TRUE(holds(completed({""}), "inspect"));
    EXPECT_TRUE(holds(completed({"-"}), "--config"));
    EXPECT_EQ(completed({"cook", "--visibility-q"}), Words{"--visibility-quality"});
    EXPECT_EQ(completed({"cook", "--visibility-quality", ""}), (Words{"default", "draft", "high"}));
    EXPECT_EQ(completed({"cook", "--visibility-quality", "=", "h"}), Words{"high"});
    EXPECT_EQ(completed({"-C", "assets", "cook", "--direc"}), Words{"--directory"});
    EXPECT_EQ(completed({"cook", "assets/"}), Words{"assets/a.glb"});
    EXPECT_EQ(completed({"cook", "--report", "ass"}), Words{"assets"});
    EXPECT_EQ(completed({"cache", "g"}), Words{"gc"});
    EXPECT_EQ(completed({"inspect", "--format", ""}), (Words{"json", "text"}));
    EXPECT_EQ(completed({"schema", "pl"}), Words{"plan"});
}

TEST_F(Manual, otherShellsTakeTheirScripts)
{
    folder.write("_hearth", hearth({"completion", "zsh"}).out);
    folder.write("hearth.fish", hearth({"completion", "fish"}).out);
    for (const char* option : {"--visibility-quality", "--directory"})
        EXPECT_NE(folder.read("_hearth").find(option), std::string::npos);
    EXPECT_NE(folder.read("hearth.fish").find("-l visibility-quality -x -a 'draft default high'"),
              std::string::npos);
    if (has("zsh"))
    {
        EXPECT_EQ(shell("zsh -n _hearth").exit_code, 0);
    }
    if (has("fish"))
    {
        EXPECT_EQ(shell("fish -n hearth.fish").exit_code, 0);
    }
}

TEST_F(Manual, pagesAreThereForEveryVerbWithoutAWarning)
{
    std::filesystem::create_directory(folder / "man");
    ASSERT_EQ(hearth({"man", "--all", "man"}).exit_code, 0);
    const std::string help = hearth({"--help"}).out;
    const std::string verbs = help.substr(help.find("Subcommands:"));
    size_t count = 0;
    for (const auto& page : std::filesystem::directory_iterator(folder / "man"))
    {
        ++count;
        const std::string name = page.path().filename().string();
        const ProgramEnd end = shell("groff -man -ww -Tutf8 -z man/" + name);
        EXPECT_EQ(end.exit_code, 0) << name;
        EXPECT_EQ(end.err, "") << name;
        if (name.starts_with("hearth-"))
        {
            EXPECT_NE(verbs.find("  " + name.substr(7, name.rfind('.') - 7) + " "), std::string::npos)
                << name;
        }
    }
    EXPECT_EQ(count, countOccurrences(verbs.substr(0, verbs.find("Examples")), "\n  ") + 2);
    // as a terminal shows it
    const std::string cook =
        shell("groff -man -Tascii man/hearth-cook.1 | sed 's/.\\x08//g; s/\\x1b\\[[0-9]*m//g'").out;
    EXPECT_NE(cook.find("--visibility-quality draft|default|high"), std::string::npos) << cook;
    EXPECT_NE(cook.find("hearth cook house.glb tree.glb -o village.hearth"), std::string::npos);
    const std::string config =
        shell("groff -man -Tascii man/hearth.toml.5 | sed 's/.\\x08//g; s/\\x1b\\[[0-9]*m//g'").out;
    EXPECT_NE(config.find("clusters.influences"), std::string::npos) << config;
    EXPECT_NE(config.find("[profile.mobile-low]"), std::string::npos);
    EXPECT_EQ(hearth({"man", "cook"}).out, folder.read("man/hearth-cook.1"));
    EXPECT_EQ(hearth({"man", "hearth.toml"}).out, folder.read("man/hearth.toml.5"));
    EXPECT_EQ(hearth({"man", "paint"}).exit_code, 2);
}

TEST_F(Manual, whatIsWrittenFitsItsSchema)
{
    const auto faultIn = [&](const std::string& name, const std::string& text)
    {
        const std::optional<Json> schema = Json::parse(hearth({"schema", name}).out);
        const std::optional<Json> value = Json::parse(text);
        return !value || !schema ? "is no JSON" : findFault(*schema, *value);
    };
    writePackFile(smallPack(), folder / "a.hearth");
    folder.write("bad.hearth", "no pack");
    hearth({"cook", "none.glb", "-o", "x.hearth", "--events", "events.ndjson"});
    const std::vector<std::pair<std::string, std::vector<std::string>>> written{
        {"inspect", {"inspect", "a.hearth", "--format", "json"}},
        {"verify", {"verify", "a.hearth", "--format", "json"}},
        {"verify", {"verify", "bad.hearth", "--format", "json"}},
        {"plan",
         {"cook", "a.glb", "b.glb", "-o", "x", "--visibility", "--bricks", "--dry-run", "--format", "json"}},
        {"settings", {"config", "a.glb", "--profile", "mobile-low", "--format", "json"}},
        {"doctor", {"doctor", "--format", "json"}},
    };
    for (const auto& [name, arguments] : written)
        EXPECT_EQ(faultIn(name, hearth(arguments).out), "") << name;
    std::istringstream events(folder.read("events.ndjson"));
    for (std::string event; std::getline(events, event);)
        EXPECT_EQ(faultIn("events", event), "") << event;

    // hearth.toml: accepted files match the schema, rejected files do not
    EXPECT_EQ(
        faultIn("config", R"({"defaults": {"jobs": 2, "cache": ["dir:/a"], "memory": "12G", "log": "quiet"},
        "profile": {"pc": {"inherits": "desktop", "clusters": {"levels": [{"keep": 0.5}], "influences": 4}}},
        "rule": [{"match": "**", "textures": {"max_size": 64}}]})"),
        "");
    for (const char* wrong : {
             R"({"default": {}})",
             R"({"defaults": {"jobs": 0}})",
             R"({"defaults": {"log": "loud"}})",
             R"({"rule": [{"textures": {}}]})",
             R"({"profile": {"pc": {"clusters": {"influences": 5}}}})",
             R"({"rule": [{"match": "a", "bricks": {"mode": true}}]})",
             R"({"profile": {"pc": {"visibility": {"distance": 0}}}})",
         })
    {
        const std::string fault = faultIn("config", wrong);
        EXPECT_NE(fault, "") << wrong;
        EXPECT_EQ(fault.find("unknown keyword"), std::string::npos) << fault;
    }
    EXPECT_EQ(faultIn("plan", R"({"schema": "hearth.plan/1", "sources": -1, "actions": []})"),
              "/sources: minimum 0");
}

TEST_F(Manual, doctorSaysWhatIsWrongAndWhatToDo)
{
    // alone in a folder: every program is missing
    std::filesystem::create_directory(folder / "bin");
    std::filesystem::copy(HEARTH_BIN "/hearth", folder / "bin/hearth");
    const ProgramEnd alone = folder.run({folder / "bin/hearth", "doctor"});
    EXPECT_EQ(alone.exit_code, 1);
    EXPECT_NE(alone.out.find("wrong    programs"), std::string::npos) << alone.out;
    EXPECT_NE(alone.out.find("lacks hearth-import, hearth-clusters"), std::string::npos) << alone.out;
    EXPECT_NE(alone.out.find("what to do: install all of Hearth"), std::string::npos) << alone.out;
    EXPECT_NE(alone.out.find("ok       cache"), std::string::npos) << alone.out;

    // a program of another version
    for (const char* name :
         {"import", "textures", "estimates", "budget", "texels", "clusters", "skinning", "neighbours",
          "visibility", "specular", "probe", "bricks", "proxy", "receivers", "reflections", "link", "render"})
        folder.write(std::string("bin/hearth-") + name,
                     std::string("#!/bin/sh\necho a device\nexit 0\nhearth program version 0.0.1") + '\0',
                     true);
    const ProgramEnd older = folder.run({folder / "bin/hearth", "doctor", "--format", "json"});
    EXPECT_EQ(older.exit_code, 1);
    const Json json = Json::parse(older.out).value();
    EXPECT_FALSE(json["ok"].get<bool>());
    EXPECT_NE(json["checks"][0]["text"].get<std::string>().find("hearth-import 0.0.1"), std::string::npos);
    EXPECT_NE(older.out.find("draws with a device"), std::string::npos) << older.out;

    const ProgramEnd cache = hearth({"doctor", "--cache", "dir:/proc/cache"});
    EXPECT_EQ(cache.exit_code, 1);
    EXPECT_NE(cache.out.find("/proc/cache cannot be written"), std::string::npos) << cache.out;
    // nothing listens on port 1
    const ProgramEnd server = hearth({"doctor", "--cache", "http://127.0.0.1:1/hearth"});
    EXPECT_EQ(server.exit_code, 1);
    EXPECT_NE(server.out.find("http://127.0.0.1:1/hearth: "), std::string::npos) << server.out;
    const ProgramEnd mode = hearth({"doctor"}, {"HEARTH_CACHE_MODE=wr"});
    EXPECT_NE(mode.out.find("must be rw, ro or off"), std::string::npos) << mode.out;
    const ProgramEnd reading = hearth({"doctor"}, {"HEARTH_CACHE_MODE=ro"});
    EXPECT_NE(reading.out.find(folder.cachePath() + " is not there"), std::string::npos) << reading.out;
    const ProgramEnd off = hearth({"doctor"}, {"HEARTH_CACHE_MODE=off"});
    EXPECT_NE(off.out.find("warning  cache    no cache is used"), std::string::npos) << off.out;
}

} // namespace hearth::test
