// hearth cook from the outside: what appears, what is left behind, and how it ends.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container_reader.h"
#include "pipelines/command/verify.h"
#include "tests/command/json_schema.h"
#include "tests/command/sandbox.h"
#include "tests/command/small_parts.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

namespace hearth::test
{

namespace
{

// The name of the source says what the script does: it stands for hearth-import.
constexpr const char* kImport = R"(#!/bin/sh
case "$1" in
  *malformed*) echo "$1|/meshes/0: error: is bad [E1101] hint: mend it" >&2; exit 65 ;;
  *missing*) echo "$1: error: cannot open [E1001] hint: look" >&2; exit 66 ;;
  *told*) echo "$*" >> asked ;;
  *silent*) exit 65 ;;
  *strange*) echo "terminate called" >&2; exit 1 ;;
  *crash*) echo "contract broken" >&2; kill -SEGV $$ ;;
  *killed*) kill -KILL $$ ;;
  *slow*) exec sleep 60 ;;
  *busy*) mkdir busy 2>/dev/null || touch together; sleep 0.3; rmdir busy 2>/dev/null ;;
  *warning*) echo "$1|/extras: warning: left out [W1400]" >&2; echo "noise of a library" >&2 ;;
esac
cp "PARTS.import.part" "$3"
while [ $# -gt 0 ]; do if [ "$1" = "--stats" ]; then cp "PARTS.import.json" "$2"; fi; shift; done
)";

constexpr const char* kTextures = R"(#!/bin/sh
if [ -e ./textures-fail ]; then echo "$1|chunk IMGD 0: error: is bad [E2009] hint: again" >&2; exit 65; fi
cp "PARTS.textures.part" "$3"
while [ "$1" != "--stats" ]; do shift; done
echo '{"images": [{"name": "bark", "width": 4, "height": 2, "mips": 3, "format": "rgba8-srgb", "bytes": 44,
                   "bytes_stored": 40, "error": {"rms": 0.0, "psnr_db": null}}]}' > "$2"
)";

constexpr const char* kClusters = R"(#!/bin/sh
if [ "$4" = "--set" ]; then echo "$*" >> asked; fi
if [ -e ./clusters-lie ]; then exit 0; fi
cp "PARTS.clusters.part" "$3"
while [ "$1" != "--stats" ]; do shift; done
echo '{"meshes": [{"name": "strip", "source": {"triangles": 8}, "levels": [], "clusters": 1,
                   "bytes": {"pages_stored": 70}}], "totals": {"triangles": 8}}' > "$2"
)";

constexpr const char* kSkinning = R"(#!/bin/sh
cp "PARTS.skinning.part" "$4"
)";

constexpr const char* kBricks = R"(#!/bin/sh
case "$*" in
  *"--voxel-size 7"*) echo "--voxel-size: error: is bad [E1000] hint: another" >&2; exit 2 ;;
  *"--memory 4096"*) echo "$5: warning: too little [W1400]" >&2 ;;
esac
while [ $# -gt 0 ]; do
  case "$1" in
    -o) cp "PARTS.bricks.part" "$2" ;;
    --stats) echo '{"voxel_size": 0.5}' > "$2" ;;
  esac
  shift
done
)";

std::string withParts(std::string script, const std::string& parts)
{
    for (size_t at = script.find("PARTS"); at != std::string::npos; at = script.find("PARTS"))
        script.replace(at, 5, parts);
    return script;
}

/// How a report differs from what its schema promises; empty where it does not.
std::string faultOfReport(const nlohmann::json& report)
{
    return faultOfSchema(HEARTH_SCHEMAS "/hearth.report.1.json", report);
}

/// A folder to cook in; the programs lie elsewhere, so that the folder shows what cooking leaves behind.
class Cook : public ::testing::Test
{
protected:
    Cook()
    {
        PackModel model = smallPack();
        model.meta = importMeta("small.gltf");
        writeParts(model, programs.path(), "small");
        const std::string parts = programs / "small";
        programs.write("small.import.json", model.meta);
        programs.write("hearth-import", withParts(kImport, parts), true);
        programs.write("hearth-textures", withParts(kTextures, parts), true);
        programs.write("hearth-clusters", withParts(kClusters, parts), true);
        programs.write("hearth-skinning", withParts(kSkinning, parts), true);
        programs.write("hearth-bricks", withParts(kBricks, parts), true);
        writeBricksPart(model, parts + ".bricks.part");
        std::filesystem::copy(HEARTH_BIN "/hearth", programs / "hearth");
        std::filesystem::copy(HEARTH_BIN "/hearth-link", programs / "hearth-link");
    }

    ProgramEnd cook(std::vector<std::string> arguments,
                    const std::vector<std::string>& environment = {"TMPDIR="})
    {
        return folder.run(command(std::move(arguments)), environment);
    }

    std::vector<std::string> command(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {programs / "hearth", "cook"});
        return arguments;
    }

    /// The cook failed with one error line, and neither made nor left anything.
    void expectFailure(const ProgramEnd& end, int exit_code, const std::string& part_of_message)
    {
        EXPECT_EQ(end.exit_code, exit_code) << end.err;
        EXPECT_EQ(countOf(end.err, ": error: "), 1u) << end.err;
        EXPECT_EQ(end.out, "");
        EXPECT_NE(end.err.find(part_of_message), std::string::npos) << end.err;
        EXPECT_EQ(folder.list(), std::vector<std::string>{}) << end.err;
    }

    Sandbox programs;
    Sandbox folder;
};

} // namespace

TEST_F(Cook, makesAPackAndLeavesNothingElse)
{
    const ProgramEnd end = cook({"a.gltf", "-o", "a.hearth"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(end.out, "");
    EXPECT_EQ(folder.list(), std::vector<std::string>{"a.hearth"});
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
    for (const char* stage : {"import", "textures", "clusters", "skinning", "link", "cooked"})
        EXPECT_EQ(countOf(end.err, std::string(stage) + " "), 1u) << end.err;
    EXPECT_EQ(end.err.find('\033'), std::string::npos) << "colour without a terminal";
}

TEST_F(Cook, quietSaysNothing)
{
    EXPECT_EQ(cook({"-q", "warning.gltf", "-o", "a.hearth"}).err, "");
}

TEST_F(Cook, colourIsThereOnDemandOnly)
{
    const auto colored = [&](const std::vector<std::string>& environment) {
        return cook({"a.gltf", "-o", "a.hearth"}, environment).err.find('\033') != std::string::npos;
    };
    EXPECT_TRUE(colored({"CLICOLOR_FORCE=1", "NO_COLOR="}));
    EXPECT_FALSE(colored({"CLICOLOR_FORCE=1", "NO_COLOR=1"}));
}

TEST_F(Cook, tellsCookersWhatItsProfileSaysByValue)
{
    programs.write("house.toml", "[animation]\nerror = 0.001\n[clusters]\ninfluences = 4\n");
    const ProgramEnd end = cook({"told.gltf", "-o", "a.hearth", "--profile", programs / "house.toml"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const std::string asked = folder.read("asked");
    EXPECT_EQ(countOf(asked, "--set animation.error=0.001"), 1u) << asked;
    EXPECT_EQ(countOf(asked, "--set clusters.influences=4"), 1u) << asked;
    EXPECT_EQ(countOf(asked, "house.toml"), 0u) << asked;
}

TEST_F(Cook, aRuleThatChangesTouchesItsSourcesAlone)
{
    std::filesystem::create_directory(folder / "props");
    for (const char* source : {"props/a.gltf", "b.gltf"})
        folder.write(source, source);
    // the script that stands for it lists nothing, so that what it makes is not kept
    const auto withoutImports = [](const std::string& text)
    {
        std::istringstream lines(text);
        std::string others;
        for (std::string line; std::getline(lines, line);)
            others += line.starts_with("import ") ? "" : line + "\n";
        return others;
    };
    const auto cookWith = [&](const char* size)
    {
        folder.write("hearth.toml", std::string("[[rule]]\nmatch = 'props/*'\ntextures.max_size = ") + size);
        const ProgramEnd end = cook({"props/a.gltf", "b.gltf", "-o", "a.hearth", "--explain", "-q"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        return withoutImports(end.err);
    };
    cookWith("64");
    EXPECT_EQ(cookWith("0x40"), "") << "the same value, written in another way";
    EXPECT_EQ(cookWith("32"), "textures   props/a.gltf: parameter --max-size: 64 -> 32\n");
    std::filesystem::rename(folder / "hearth.toml", folder / "other.toml");
    const ProgramEnd moved =
        cook({"props/a.gltf", "b.gltf", "-o", "a.hearth", "--explain", "-q", "--config", "other.toml"});
    EXPECT_EQ(withoutImports(moved.err), "") << "the file's path is in no key";
}

TEST_F(Cook, refusesAProfileThatIsWrong)
{
    programs.write("house.toml", "[animation]\nerror = -1\n");
    expectFailure(cook({"a.gltf", "-o", "a.hearth", "--profile", programs / "house.toml"}), 78,
                  "house.toml|line 2, column 9, animation.error: error: must be a number from 0 to 1000");
    expectFailure(cook({"a.gltf", "-o", "a.hearth", "--profile", "mobil-low"}), 78,
                  "did you mean 'mobile-low'?");
    expectFailure(cook({"a.gltf", "-o", "a.hearth", "--set", "clusters.influences=5"}), 2, "must be 4 or 8");
    expectFailure(cook({"a.gltf", "-o", "a.hearth"}, {"TMPDIR=", "HEARTH_JOBS=0"}), 78,
                  "HEARTH_JOBS: error:");
    expectFailure(cook({"a.gltf", "-o", "a.hearth", "--visibility-quality", "high"}), 2,
                  "--visibility-quality: error: needs --visibility, or visibility.enabled in the profile");
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
    std::map<std::string, nlohmann::json> of_severity;
    for (std::string line; std::getline(lines, line);)
    {
        const nlohmann::json message = nlohmann::json::parse(line, nullptr, false);
        ASSERT_TRUE(message.is_object()) << line;
        of_severity[message["severity"]] = message;
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

TEST_F(Cook, progressIsABarOrLinesOrNothing)
{
    const auto err = [&](const char* style) {
        return cook({"a.gltf", "-o", "a.hearth", "--no-cache", "--progress", style}).err;
    };
    EXPECT_EQ(countOf(err("plain"), "import "), 1u);
    EXPECT_EQ(countOf(err("auto"), "import "), 1u) << "no terminal";
    EXPECT_EQ(countOf(err("none"), "import "), 0u);
    const std::string bar = err("bar");
    EXPECT_NE(bar.find("\r\033[K[                        ] 0/5  import a.gltf"), std::string::npos) << bar;
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
    EXPECT_EQ(countOf(err({"HEARTH_LOG=quiet"}, {"-v"}), "noise"), 1u) << "the command line goes over it";
    EXPECT_EQ(countOf(err({"HEARTH_LOG=verbose"}), "noise"), 1u);
    EXPECT_EQ(err({"HEARTH_LOG=verbose"}, {"-q"}), "");
    EXPECT_EQ(countOf(err({"HEARTH_PROGRESS=none"}), "import "), 0u);
    EXPECT_EQ(countOf(err({"HEARTH_PROGRESS=none"}, {"--progress", "plain"}), "import "), 1u);
    EXPECT_EQ(cook({"warning.gltf", "-o", "a.hearth"}, {"HEARTH_LOG=loud"}).exit_code, 78);

    folder.write("hearth.toml", "[defaults]\nlog = 'quiet'\ncolor = 'always'\nprogress = 'none'\n");
    EXPECT_EQ(err({}), "");
    const std::string in_color = err({"HEARTH_LOG=normal"});
    EXPECT_EQ(countOf(in_color, "\033[1;33mwarning:\033[0m"), 1u) << in_color;
    EXPECT_EQ(countOf(in_color, "import "), 0u) << in_color;
    EXPECT_EQ(err({"HEARTH_LOG=normal", "NO_COLOR=1"}).find('\033'), std::string::npos);
    // of verbs, too, that need no other setting
    EXPECT_NE(folder.run({programs / "hearth", "verify", "none"}, {}).err.find("\033[1;31merror:"),
              std::string::npos);
    folder.write("hearth.toml", "[defaults]\ncolour = 'always'\n");
    EXPECT_EQ(folder.run({programs / "hearth", "verify", "a.hearth"}, {}).exit_code, 0)
        << "a file that is wrong is told of by those that need it";
}

TEST_F(Cook, severalSourcesMakeOnePack)
{
    const ProgramEnd end = cook({"a.gltf", "b.gltf", "c.gltf", "-o", "all.hearth", "--jobs", "3"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const auto result = command::verifyFile(folder / "all.hearth");
    ASSERT_TRUE(result.ok());
    EXPECT_NE(result->find("9 meshes"), std::string::npos) << *result;
}

TEST_F(Cook, sameBytesForAnyNumberOfJobs)
{
    for (const char* jobs : {"1", "2", "7"})
        ASSERT_EQ(cook({"a.gltf", "b.gltf", "-o", std::string(jobs) + ".hearth", "-j", jobs, "--no-cache"})
                      .exit_code,
                  0);
    EXPECT_EQ(folder.read("1.hearth"), folder.read("2.hearth"));
    EXPECT_EQ(folder.read("1.hearth"), folder.read("7.hearth"));
}

TEST_F(Cook, passesWarningsOnButNotNoise)
{
    const ProgramEnd end = cook({"warning.gltf", "-o", "a.hearth"});
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_EQ(countOf(end.err, "warning.gltf|/extras: warning: left out [W1400]"), 1u) << end.err;
    EXPECT_EQ(countOf(end.err, "noise"), 0u);
    EXPECT_EQ(countOf(cook({"-v", "warning.gltf", "-o", "a.hearth"}).err, "noise"), 1u);
}

TEST_F(Cook, clearErrorsKeepTheirCode)
{
    expectFailure(cook({"malformed.gltf", "-o", "a.hearth"}), 65,
                  "malformed.gltf|/meshes/0: error: is bad [E1101]");
    expectFailure(cook({"missing.gltf", "-o", "a.hearth"}), 66, "missing.gltf: error: cannot open [E1001]");
    expectFailure(cook({"-q", "good.gltf", "malformed.gltf", "-o", "a.hearth"}), 65, "malformed.gltf|");
}

TEST_F(Cook, anythingElseIsADefectThatNamesTheSource)
{
    expectFailure(cook({"crash.gltf", "-o", "a.hearth"}), 70, "crash.gltf: error: hearth-import");
    expectFailure(cook({"crash.gltf", "-o", "a.hearth"}), 70, "contract broken [E7001]");
    expectFailure(cook({"killed.gltf", "-o", "a.hearth"}), 70, "killed.gltf: error: hearth-import");
    expectFailure(cook({"silent.gltf", "-o", "a.hearth"}), 70, "silent.gltf: error: hearth-import");
    expectFailure(cook({"strange.gltf", "-o", "a.hearth"}), 70, "ended with code 1");
}

TEST_F(Cook, aMissingCookerIsADefect)
{
    std::filesystem::remove(programs / "hearth-import");
    expectFailure(cook({"a.gltf", "-o", "a.hearth"}), 70, "cannot be started");
}

TEST_F(Cook, laterStagesNameTheSourceNotThePart)
{
    folder.write("textures-fail", "");
    const ProgramEnd end = cook({"some/a.gltf", "-o", "a.hearth"});
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_NE(end.err.find("some/a.gltf|chunk IMGD 0: error: is bad"), std::string::npos) << end.err;
    EXPECT_EQ(end.err.find(".part"), std::string::npos) << end.err;
    EXPECT_EQ(folder.list(), std::vector<std::string>{"textures-fail"});
}

TEST_F(Cook, aCookerThatMakesNothingIsCaught)
{
    folder.write("clusters-lie", "");
    const ProgramEnd end = cook({"a.gltf", "-o", "a.hearth"});
    EXPECT_NE(end.exit_code, 0);
    EXPECT_EQ(countOf(end.err, ": error: "), 1u) << end.err;
    EXPECT_FALSE(folder.has("a.hearth"));
}

TEST_F(Cook, anOldOutputStaysAsItWasUntilTheNewOneIsWhole)
{
    folder.write("a.hearth", "old");
    EXPECT_EQ(cook({"malformed.gltf", "-o", "a.hearth"}).exit_code, 65);
    EXPECT_EQ(folder.read("a.hearth"), "old");
    EXPECT_EQ(cook({"good.gltf", "-o", "a.hearth"}).exit_code, 0);
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
}

TEST_F(Cook, makesTheBricksOfAllSourcesWhereAsked)
{
    const std::vector<std::string> sources{"a.gltf", "b.gltf", "-o", "a.hearth", "-v", "--no-cache"};
    EXPECT_EQ(countOf(cook(sources).err, "hearth-bricks"), 0u);
    auto arguments = sources;
    arguments.insert(arguments.end(),
                     {"--bricks", "--voxel-size", "0.5", "--brick-memory", "4096", "--report", "r.json"});
    const ProgramEnd end = cook(arguments);
    ASSERT_EQ(end.exit_code, 0) << end.err;
    std::string command = end.err.substr(end.err.find("hearth-bricks "));
    command.resize(command.find('\n'));
    for (const char* part :
         {"/0.import.part ", "/0.clusters.part ", "/0.textures.part ", "/1.import.part ", "/1.clusters.part ",
          "/1.textures.part ", " --voxel-size 0.5 --memory 4096 --stats "})
    {
        const size_t at = command.find(part);
        EXPECT_NE(at, std::string::npos) << part << " in " << command;
        command.erase(0, at); // in this order
    }
    EXPECT_EQ(countOf(end.err, "warning: too little [W1400]"), 1u) << end.err;
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
    const auto reader = formats::ContainerReader::open(folder / "a.hearth");
    ASSERT_TRUE(reader.ok());
    EXPECT_NE(reader->find(formats::kChunkBrickGrid), nullptr);
    const auto report = nlohmann::json::parse(folder.read("r.json"));
    EXPECT_EQ(report["bricks"]["stage"], "bricks");
    EXPECT_EQ(report["bricks"]["grid"]["voxel_size"], 0.5);
}

TEST_F(Cook, aVoxelSizeThatMakesNoSenseIsAWrongCommandLine)
{
    expectFailure(cook({"a.gltf", "-o", "a.hearth", "--bricks", "--voxel-size", "7"}), 2,
                  "--voxel-size: error: is bad [E1000]");
    for (const char* size : {"0", "-1", "nan", "inf", "wide"})
        EXPECT_EQ(cook({"a.gltf", "-o", "a.hearth", "--bricks", "--voxel-size", size}).exit_code, 2);
    EXPECT_EQ(cook({"a.gltf", "-o", "a.hearth", "--bricks", "--brick-memory", "-1"}).exit_code, 2);
    EXPECT_EQ(cook({"a.gltf", "-o", "a.hearth", "--voxel-size", "1"}).exit_code, 2);
}

TEST_F(Cook, saysWhereItCannotWrite)
{
    expectFailure(cook({"a.gltf", "-o", "nowhere/a.hearth"}), 73, "nowhere/a.hearth: error: ");
    expectFailure(cook({"a.gltf", "-o", "."}), 73, ".: error: is a folder");
    expectFailure(cook({"a.gltf", "-o", "a.hearth"}, {"TMPDIR=/nowhere"}), 73, "/nowhere");
}

TEST_F(Cook, neverOverwritesItsSource)
{
    folder.write("a.gltf", "precious");
    const ProgramEnd end = cook({"a.gltf", "-o", "./a.gltf"});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_EQ(folder.read("a.gltf"), "precious");
}

TEST_F(Cook, keepsPartsWhereTheUserWantsTemporaries)
{
    const Sandbox temporaries;
    const ProgramEnd end = cook({"-v", "a.gltf", "-o", "a.hearth"}, {"TMPDIR=" + temporaries.path()});
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_NE(end.err.find("-o " + temporaries.path() + "/.hearth-"), std::string::npos) << end.err;
    EXPECT_EQ(temporaries.list(), std::vector<std::string>{});
}

TEST_F(Cook, cleansUpWhenInterrupted)
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        const pid_t process = folder.start(command({"slow.gltf", "-o", "a.hearth"}), {"TMPDIR="});
        // the folder shows that the cook has begun; a second more, and the import sleeps
        for (int i = 0; i < 500 && folder.list().empty(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ASSERT_FALSE(folder.list().empty());
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        const auto start = std::chrono::steady_clock::now();
        ::kill(process, signal);
        const ProgramEnd end = folder.finish(process);
        EXPECT_EQ(end.exit_code, 130);
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
        EXPECT_EQ(folder.list(), std::vector<std::string>{});
    }
}

TEST_F(Cook, oneFailureEndsTheOthersWhereThatIsWanted)
{
    const auto start = std::chrono::steady_clock::now();
    expectFailure(cook({"--fail-fast", "slow.gltf", "malformed.gltf", "-o", "a.hearth"}), 65,
                  "malformed.gltf|");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST_F(Cook, cookersThatNeedTooMuchMemoryRunOneByOne)
{
    const std::vector<std::string> sources{"busy1.gltf", "busy2.gltf", "-o", "a.hearth", "-j2"};
    EXPECT_EQ(cook(sources).exit_code, 0);
    EXPECT_TRUE(folder.has("together"));
    std::filesystem::remove(folder / "together");
    std::vector<std::string> arguments = sources;
    // an import of nothing is thought to take 16 MiB
    arguments.insert(arguments.end(), {"--memory", "20M"});
    EXPECT_EQ(cook(arguments).exit_code, 0);
    EXPECT_FALSE(folder.has("together"));
}

TEST_F(Cook, reportsWhatItDid)
{
    const ProgramEnd end = cook({"warning.gltf", "-o", "a.hearth", "--report", "report.json"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(faultOfReport(report), "");
    EXPECT_EQ(report["schema"], "hearth.report/1");
    EXPECT_EQ(report["status"], "ok");
    EXPECT_EQ(report["failures"].size(), 0u);
    const auto& totals = report["totals"];
    EXPECT_EQ(totals["bytes_out"], folder.read("a.hearth").size());
    EXPECT_EQ(totals["bytes_in"], 100);
    EXPECT_EQ(totals["cooked"], 1);
    EXPECT_EQ(totals["actions"]["cooked"], 5);
    EXPECT_GT(totals["sizes"]["geometry"], 0);
    const auto& asset = report["assets"][0];
    EXPECT_EQ(asset["source"], "warning.gltf");
    EXPECT_EQ(asset["state"], "cooked");
    EXPECT_EQ(asset["stages"].size(), 4u);
    EXPECT_GE(asset["stages"][1]["start_s"], asset["stages"][0]["start_s"]);
    EXPECT_EQ(asset["clusters"]["meshes"][0]["name"], "strip");
    EXPECT_EQ(asset["clusters"]["totals"]["triangles"], 8);
    EXPECT_EQ(asset["textures"][0]["name"], "bark");
    EXPECT_EQ(asset["sizes"]["geometry"], 70);
    EXPECT_EQ(asset["sizes"]["textures"], 40);
    EXPECT_EQ(asset["messages"].size(), 1u) << "the import's own list, not its lines as well";
    EXPECT_EQ(asset["messages"][0]["pointer"], "/extras");
    EXPECT_EQ(asset["dropped"][0], "extras");
    EXPECT_EQ(report["link"]["stage"], "link");
    EXPECT_EQ(report["dropped"][0]["source"], "warning.gltf");
    EXPECT_EQ(report["dropped"][0]["text"], "extras");
}

TEST_F(Cook, reportsRootCausesAndWhatDependsOnThem)
{
    EXPECT_EQ(cook({"good.gltf", "malformed.gltf", "-o", "a.hearth", "--report", "report.json"}).exit_code,
              65);
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(faultOfReport(report), "");
    EXPECT_EQ(report["status"], "failed");
    EXPECT_EQ(report["exit"], 65);
    EXPECT_EQ(report["assets"][0]["state"], "cooked");
    EXPECT_EQ(report["assets"][1]["state"], "failed");
    EXPECT_EQ(report["assets"][1]["stages"][1]["state"], "dependency failed");
    EXPECT_EQ(report["link"]["state"], "dependency failed");
    ASSERT_EQ(report["failures"].size(), 1u);
    const auto& failure = report["failures"][0];
    EXPECT_EQ(failure["code"], "E1101");
    EXPECT_EQ(failure["file"], "malformed.gltf");
    EXPECT_EQ(failure["pointer"], "/meshes/0");
    EXPECT_EQ(failure["text"], "is bad");
    EXPECT_EQ(failure["hint"], "mend it");
    EXPECT_EQ(failure["stage"], "import");
    EXPECT_EQ(failure["not_made"].size(), 4u) << "three cookers of the source, and the link";
    EXPECT_NE(report["error"].get<std::string>().find("E1101"), std::string::npos);
}

TEST_F(Cook, reportsWhereItDoesNotEvenBegin)
{
    EXPECT_EQ(cook({"good.gltf", "-o", ".", "--report", "report.json"}).exit_code, 73);
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(faultOfReport(report), "");
    EXPECT_EQ(report["assets"][0]["state"], "not cooked");
    ASSERT_EQ(report["failures"].size(), 1u);
    EXPECT_EQ(report["failures"][0]["code"], "E4000");
}

TEST_F(Cook, writesReportsForWhoeverReadsThem)
{
    const ProgramEnd end = cook({"good.gltf", "malformed.gltf", "-o", "a.hearth", "--report", "r.json",
                                 "--report", "r.html", "--report", "r.xml", "--report", "r.csv"});
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"r.csv", "r.html", "r.json", "r.xml"}));
    EXPECT_EQ(countOf(folder.read("r.xml"), "<testcase "), 3u);
    EXPECT_EQ(countOf(folder.read("r.xml"), "<failure "), 2u) << "the source, and the pack";
    EXPECT_EQ(countOf(folder.read("r.csv"), "\r\n"), 3u);
    EXPECT_NE(folder.read("r.html").find("E1101"), std::string::npos);

    // the same of the JSON
    const auto report = [&](std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {programs / "hearth", "report"});
        return folder.run(arguments, {"TMPDIR="});
    };
    ASSERT_EQ(report({"r.json", "--html", "b.html", "--junit", "b.xml", "--csv", "b.csv"}).exit_code, 0);
    for (const char* ending : {".html", ".xml", ".csv"})
        EXPECT_EQ(folder.read(std::string("b") + ending), folder.read(std::string("r") + ending));
    folder.write("no.json", R"({"schema": "hearth.plan/1"})");
    EXPECT_EQ(report({"no.json", "--html", "c.html"}).exit_code, 65);
    EXPECT_EQ(report({"none.json", "--html", "c.html"}).exit_code, 66);
    EXPECT_EQ(report({"r.json", "--html", "c.txt"}).exit_code, 2);
    EXPECT_EQ(report({"r.json"}).exit_code, 2);
    EXPECT_FALSE(folder.has("c.html"));
}

TEST_F(Cook, aReportThatCannotBeWrittenIsAnError)
{
    const ProgramEnd end = cook({"a.gltf", "-o", "a.hearth", "--report", "nowhere/report.json"});
    EXPECT_EQ(end.exit_code, 73);
    EXPECT_NE(end.err.find("nowhere/report.json: error: "), std::string::npos);
}

} // namespace hearth::test
