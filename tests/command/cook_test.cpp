// Runs hearth cook as a user would: its outputs, its temporary files and its exit codes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "formats/container/container_reader.h"
#include "formats/records/bricks.h"
#include "pipelines/command/inspect/verify.h"
#include "tests/support/cook_folder.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <sstream>
#include <thread>

namespace hearth::test
{

TEST_F(Cook, makesAPackAndLeavesNothingElse)
{
    const ProgramEnd end = cook({"a.gltf", "-o", "a.hearth"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(end.out, "");
    EXPECT_EQ(folder.list(), std::vector<std::string>{"a.hearth"});
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
    for (const char* line : {"source ", "cooked "})
        EXPECT_EQ(countOccurrences(end.err, line), 1u) << end.err;
    EXPECT_EQ(end.err.find('\033'), std::string::npos) << "colour without a terminal";
    const std::string all = "\n" + cook({"a.gltf", "-v", "-o", "a.hearth", "--no-cache"}).err;
    for (const char* stage : {"import", "textures", "texels", "clusters", "skinning", "link", "cooked"})
        EXPECT_EQ(countOccurrences(all, "\n" + std::string(stage) + " "), 1u) << all;
}

TEST_F(Cook, tellsCookersWhatItsProfileSaysByValue)
{
    programs.write("house.toml", "[animation]\nerror = 0.001\n[clusters]\ninfluences = 4\n");
    const ProgramEnd end = cook({"echoed.gltf", "-o", "a.hearth", "--profile", programs / "house.toml"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const std::string asked = folder.read("asked");
    EXPECT_EQ(countOccurrences(asked, "--set animation.error=0.001"), 1u) << asked;
    EXPECT_EQ(countOccurrences(asked, "--set clusters.influences=4"), 1u) << asked;
    EXPECT_EQ(countOccurrences(asked, "house.toml"), 0u) << asked;
}

TEST_F(Cook, aRuleThatChangesTouchesItsSourcesAlone)
{
    std::filesystem::create_directory(folder / "props");
    for (const char* source : {"props/a.gltf", "b.gltf"})
        folder.write(source, source);
    // the script in place of the cooker lists no read files, so its result is not cached
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
                  "--visibility-quality: error: has no effect: visibility.mode is off");
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
    EXPECT_EQ(countOccurrences(end.err, ": error: "), 1u) << end.err;
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
    EXPECT_EQ(countOccurrences(cook(sources).err, "hearth-bricks"), 0u);
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
    EXPECT_EQ(countOccurrences(end.err, "warning: too little [W1400]"), 1u) << end.err;
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
    const auto reader = formats::ContainerReader::open(folder / "a.hearth");
    ASSERT_TRUE(reader.ok());
    EXPECT_NE(reader->find(formats::kChunkBrickGrid), nullptr);
    const auto report = Json::parse(folder.read("r.json")).value();
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
        // the folder shows that the cook has begun; a second later the import sleeps
        for (int i = 0; i < 500 && std::filesystem::is_empty(folder.path()); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ASSERT_FALSE(std::filesystem::is_empty(folder.path()));
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
    // the memory estimate of an import of nothing is 16 MiB
    arguments.insert(arguments.end(), {"--memory", "20M"});
    EXPECT_EQ(cook(arguments).exit_code, 0);
    EXPECT_FALSE(folder.has("together"));
}

} // namespace hearth::test
