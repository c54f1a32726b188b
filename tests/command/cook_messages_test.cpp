// Tests the messages, progress and colours that hearth cook prints while it works.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/cook_folder.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

namespace hearth::test
{

TEST_F(Cook, quietSaysNothing)
{
    EXPECT_EQ(cook({"-q", "warning.gltf", "-o", "a.hearth"}).err, "");
}

TEST_F(Cook, passesWarningsOnButNotNoise)
{
    const ProgramEnd end = cook({"warning.gltf", "-o", "a.hearth"});
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_EQ(countOccurrences(end.err, "warning.gltf|/extras: warning: left out [W1400]"), 1u) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "noise"), 0u);
    EXPECT_EQ(countOccurrences(cook({"-v", "warning.gltf", "-o", "a.hearth"}).err, "noise"), 1u);
}

TEST_F(Cook, failuresAndWarningsComeTogetherAtItsEnd)
{
    const std::vector<std::string> sources{"malformed.gltf", "warning.gltf", "a.gltf", "-o",
                                           "a.hearth",       "-j1"};
    const ProgramEnd end = cook(sources);
    const std::string failure = "malformed.gltf|/meshes/0: error: is bad [E1101] hint: mend it\n";
    EXPECT_EQ(countOccurrences(end.err, failure), 2u) << end.err;
    EXPECT_TRUE(end.err.ends_with("the failure again:\n" + failure +
                                  "1 warning: 1 W1400 (a part of the source is not kept)\n"
                                  "a.hearth: not linked, because a dependency failed: 1 of 3 sources\n"))
        << end.err;
    std::vector<std::string> arguments = sources;
    arguments.emplace_back("-q");
    EXPECT_EQ(cook(arguments).err, failure);
    arguments.back() = "--no-cache";
    arguments.insert(arguments.end(), {"--log-format", "json"});
    const std::string json = cook(arguments).err;
    EXPECT_EQ(countOccurrences(json, "E1101"), 1u) << "a script sees it once: " << json;
    EXPECT_EQ(countOccurrences(json, "W1400"), 1u) << json;
}

TEST_F(Cook, filesOfAFolderThatNobodyReadsAreNamed)
{
    std::filesystem::create_directories(folder / "art/notes");
    folder.write("art/a.gltf", "");
    folder.write("art/sky.hdr", "");
    folder.write("art/notes/plan.txt", "");
    folder.write("art/.hidden", "");
    const std::string line =
        "left out  1 texture that no source uses (art/sky.hdr), 1 file of a kind that is not "
        "read (art/notes/plan.txt)\n";
    EXPECT_EQ(countOccurrences(cook({"art", "-o", "art/a.hearth", "--report", "art/a.json"}).err, line), 1u)
        << cook({"art", "-o", "art/a.hearth", "--report", "art/a.json"}).err;
    EXPECT_EQ(cook({"art", "-o", "art/a.hearth", "-q"}).err, "");
    EXPECT_EQ(countOccurrences(cook({"art/a.gltf", "-o", "a.hearth"}).err, "left out"), 0u);
    folder.write("art/malformed.gltf", "");
    EXPECT_EQ(countOccurrences(cook({"art", "-o", "b.hearth"}).err, "left out"), 0u)
        << "nobody knows what it would use";
}

TEST_F(Cook, warningsMayCountAsErrors)
{
    const ProgramEnd fine = cook({"warning.gltf", "-o", "a.hearth", "--warnings-as-errors=W1302"});
    EXPECT_EQ(fine.exit_code, 0) << fine.err;
    std::filesystem::remove(folder / "a.hearth");
    for (const char* flag : {"--warnings-as-errors", "--warnings-as-errors=W1302,W1400"})
    {
        const ProgramEnd end = cook({"warning.gltf", "-q", flag, "-o", "a.hearth"});
        expectFailure(end, 1, "a.hearth: error: not written, because warnings count as errors: 1");
        EXPECT_NE(end.err.find("warning.gltf|/extras: warning: left out [W1400]"), std::string::npos);
    }
    expectFailure(cook({"a.gltf", "-o", "a.hearth", "--warnings-as-errors=W1"}), 2, "'W1' is no warning");
}

TEST_F(Cook, messagesMayBeJson)
{
    const ProgramEnd end = cook(
        {"malformed.gltf", "warning.gltf", "-o", "a.hearth", "--log-format", "json", "--progress", "none"});
    EXPECT_EQ(end.exit_code, 65);
    std::istringstream lines(end.err);
    std::map<std::string, Json> of_severity;
    for (std::string line; std::getline(lines, line);)
    {
        const Json message = Json::parse(line).value_or(Json());
        ASSERT_TRUE(message.is_object()) << line;
        of_severity[message["severity"].get<std::string>()] = message;
    }
    EXPECT_EQ(of_severity["error"]["code"], "E1101");
    EXPECT_EQ(of_severity["error"]["file"], "malformed.gltf");
    EXPECT_EQ(of_severity["error"]["where"], "/meshes/0");
    EXPECT_EQ(of_severity["error"]["text"], "is bad");
    EXPECT_EQ(of_severity["error"]["hint"], "mend it");
    EXPECT_EQ(of_severity["warning"]["code"], "W1400");
    EXPECT_EQ(of_severity["note"]["text"],
              "a.hearth: not linked, because a dependency failed: 1 of 2 sources");
}

TEST_F(Cook, colourIsThereOnDemandOnly)
{
    const auto colored = [&](const std::vector<std::string>& environment) {
        return cook({"a.gltf", "-o", "a.hearth"}, environment).err.find('\033') != std::string::npos;
    };
    EXPECT_TRUE(colored({"CLICOLOR_FORCE=1", "NO_COLOR="}));
    EXPECT_FALSE(colored({"CLICOLOR_FORCE=1", "NO_COLOR=1"}));
}

TEST_F(Cook, progressIsABarOrLinesOrNothing)
{
    const auto err = [&](const char* style) {
        return cook({"a.gltf", "-o", "a.hearth", "--no-cache", "--progress", style}).err;
    };
    const std::string plain = err("plain");
    EXPECT_EQ(countOccurrences(plain, "source  "), 1u) << plain;
    EXPECT_EQ(countOccurrences(plain, " 5 cookers  a.gltf\n"), 1u) << plain;
    EXPECT_EQ(countOccurrences(plain, "import "), 0u) << "no line for each cooker: " << plain;
    EXPECT_EQ(countOccurrences(err("auto"), "source  "), 1u) << "no terminal";
    EXPECT_EQ(countOccurrences(err("none"), "source  "), 0u);
    const std::string bar = err("bar");
    EXPECT_NE(bar.find("\r\033[K[                        ] 0/6  import a.gltf"), std::string::npos) << bar;
    EXPECT_NE(bar.rfind("\r\033[Kcooked"), std::string::npos) << "taken away before the last line: " << bar;
    EXPECT_NE(cook({"malformed.gltf", "-o", "b.hearth", "--color", "always"}, {"NO_COLOR=1", "TMPDIR="})
                  .err.find("malformed.gltf|/meshes/0: \033[1;31merror:\033[0m is bad"),
              std::string::npos);
}

TEST_F(Cook, whatItTellsIsASetting)
{
    using Environment = std::vector<std::string>;
    const auto err = [&](const Environment& environment, const std::vector<std::string>& flags = {})
    {
        std::vector<std::string> arguments{"warning.gltf", "-o", "a.hearth", "--no-cache"};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        const ProgramEnd end = cook(arguments, environment);
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return end.err;
    };
    EXPECT_EQ(err({"HEARTH_LOG=quiet"}), "");
    EXPECT_EQ(countOccurrences(err({"HEARTH_LOG=quiet"}, {"-v"}), "noise"), 1u)
        << "the command line goes over it";
    EXPECT_EQ(countOccurrences(err({"HEARTH_LOG=verbose"}), "noise"), 1u);
    EXPECT_EQ(err({"HEARTH_LOG=verbose"}, {"-q"}), "");
    EXPECT_EQ(countOccurrences(err({"HEARTH_PROGRESS=none"}), "source  "), 0u);
    EXPECT_EQ(countOccurrences(err({"HEARTH_PROGRESS=none"}, {"--progress", "plain"}), "source  "), 1u);
    EXPECT_EQ(cook({"warning.gltf", "-o", "a.hearth"}, {"HEARTH_LOG=loud"}).exit_code, 78);

    folder.write("hearth.toml", "[defaults]\nlog = 'quiet'\ncolor = 'always'\nprogress = 'none'\n");
    EXPECT_EQ(err({}), "");
    const std::string in_color = err({"HEARTH_LOG=normal"});
    EXPECT_EQ(countOccurrences(in_color, "\033[1;33mwarning:\033[0m"), 1u) << in_color;
    EXPECT_EQ(countOccurrences(in_color, "source  "), 0u) << in_color;
    EXPECT_EQ(err({"HEARTH_LOG=normal", "NO_COLOR=1"}).find('\033'), std::string::npos);
    // also for verbs that need no other setting
    EXPECT_NE(folder.run({programs / "hearth", "verify", "none"}, {}).err.find("\033[1;31merror:"),
              std::string::npos);
    folder.write("hearth.toml", "[defaults]\ncolour = 'always'\n");
    EXPECT_EQ(folder.run({programs / "hearth", "verify", "a.hearth"}, {}).exit_code, 0)
        << "a file that is wrong is reported by those that need it";
}

} // namespace hearth::test
