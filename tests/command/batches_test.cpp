// Tests batches: cookers of many small sources share processes, and the output is the same as without
// batches.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/command/inspect/verify.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"
#include "tests/support/small_sources.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <sstream>
#include <thread>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

// Script in place of a cooker: it notes each of its processes and acts by the name of its source. Its input
// lines hold plain names only; sed turns them into words. A crash ends the whole batch.
constexpr const char* kScript = R"sh(#!/bin/sh
if [ "$1" = --batch ]; then
  echo COOKER >> PROCESSES
  while read -r line; do
    eval "set -- $(echo "$line" | sed 's/^\[//; s/\]$//; s/","/" "/g')"
    BATCH=$$ "$0" "$@" --in-batch
    code=$?
    printf '\036{"exit":%d,"seconds":0.01,"cpu_seconds":0.01,"peak_rss_bytes":1000000}\n' $code
  done
  exit 0
fi
case "$*" in *--in-batch) ;; *) echo alone >> PROCESSES ;; esac
case "$1" in
  *malformed*) echo "$1|/meshes/0: error: is bad [E1101] hint: mend it" >&2; exit 65 ;;
  *warning*) echo "$1|/extras: warning: left out [W1400]" >&2 ;;
  *crash*) echo "contract broken" >&2; kill -SEGV ${BATCH:-$$}; exit ;;
  *slow*) exec sleep 60 ;;
  *busy*) mkdir busy 2>/dev/null || touch together; sleep 0.05; rmdir busy 2>/dev/null ;;
esac
while [ $# -gt 0 ]; do
  case "$1" in
    -o) cp "PARTS.COOKER.part" "$2" ;;
    --stats) echo '{}' > "$2" ;;
    --image) : > "$2" ;;
  esac
  shift
done
)sh";

/// Twelve names, "NAME7.gltf".
std::vector<std::string> crowd(const std::string& name = "a")
{
    std::vector<std::string> names;
    for (int i = 0; i < 12; ++i)
        names.push_back(name + std::to_string(i) + ".gltf");
    return names;
}

class Batches : public ::testing::Test
{
protected:
    Batches()
    {
        PackModel model = smallPack();
        model.meta = importMeta("small.gltf");
        writeParts(model, programs.path(), "small");
        fs::copy(programs / "small.textures.part", programs / "small.texels.part");
        for (const char* cooker : {"import", "textures", "texels", "clusters", "skinning"})
        {
            std::string script = kScript;
            replaceAll(script, "PROCESSES", programs / "processes");
            replaceAll(script, "PARTS", programs / "small");
            replaceAll(script, "COOKER", cooker);
            programs.write(std::string("hearth-") + cooker, script, true);
        }
        fs::copy(HEARTH_BIN "/hearth", programs / "hearth");
        fs::copy(HEARTH_BIN "/hearth-link", programs / "hearth-link");
    }

    std::vector<std::string> command(std::vector<std::string> sources,
                                     const std::vector<std::string>& options) const
    {
        sources.insert(sources.begin(), {programs / "hearth", "cook", "--no-cache", "-o", "a.hearth"});
        sources.insert(sources.end(), options.begin(), options.end());
        return withoutLightCookers(std::move(sources));
    }

    ProgramEnd cook(const std::vector<std::string>& sources,
                    const std::vector<std::string>& options = {"-j2"})
    {
        fs::remove(programs / "processes");
        return folder.run(command(sources, options), {"TMPDIR="});
    }

    size_t processes(const std::string& what) const
    {
        return programs.has("processes") ? countOccurrences(programs.read("processes"), what + "\n") : 0;
    }

    /// Returns the events of each action, "import a.gltf", of a cook with_events: "start end cooked".
    std::map<std::string, std::string> eventsOfActions() const
    {
        std::map<std::string, std::string> of_action;
        std::istringstream lines(programs.read("events"));
        for (std::string line; std::getline(lines, line);)
        {
            const auto event = Json::parse(line).value();
            if (event.contains("cooker"))
                of_action[event["cooker"].get<std::string>() + " " + event["subject"].get<std::string>()] +=
                    event["event"].get<std::string>() + " " + event.value("state", "");
        }
        return of_action;
    }

    Sandbox programs;
    Sandbox folder;
    const std::vector<std::string> with_events{"-j2", "--events", programs / "events"};
};

} // namespace

TEST_F(Batches, aFewProcessesRunManyActions)
{
    const ProgramEnd end = cook(crowd(), with_events);
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_TRUE(command::verifyFile(folder / "a.hearth").ok());
    EXPECT_EQ(folder.list(), std::vector<std::string>{"a.hearth"});
    EXPECT_EQ(countOccurrences(end.err, "    5 cookers  "), 12u) << end.err;
    const std::map<std::string, std::string> of_action = eventsOfActions();
    EXPECT_EQ(of_action.size(), 5 * 12u + 1) << "each source's, and the link";
    for (const auto& [action, events] : of_action)
        EXPECT_EQ(events, "start end cooked") << action;
    for (const char* cooker : {"import", "textures", "texels", "clusters", "skinning"})
    {
        EXPECT_GE(processes(cooker), 1u);
        EXPECT_LE(processes(cooker), 2u) << cooker;
    }
    EXPECT_EQ(processes("alone"), 0u);
}

TEST_F(Batches, aHandfulRunsAlone)
{
    EXPECT_EQ(cook({"a.gltf", "b.gltf"}).exit_code, 0);
    EXPECT_EQ(processes("alone"), 10u);
    EXPECT_EQ(processes("import"), 0u);
}

TEST_F(Batches, whatIsLargeRunsAlone)
{
    // its file size suggests a third of a second or more
    std::vector<std::string> sources = crowd();
    folder.write("large.gltf", std::string(size_t{12} << 20, ' '));
    sources.insert(sources.begin() + 3, "large.gltf");
    EXPECT_EQ(cook(sources).exit_code, 0);
    EXPECT_EQ(processes("alone"), 4u); // skinning is fast for any source, so it is still in batches
    EXPECT_LE(processes("import"), 2u);
}

TEST_F(Batches, aCrashCostsTheActionThatCrashed)
{
    std::vector<std::string> sources = crowd();
    sources[5] = "crash.gltf";
    const ProgramEnd end = cook(sources);
    EXPECT_EQ(end.exit_code, 70) << end.err;
    EXPECT_EQ(countOccurrences(end.err, ": error: "), 2u) << "at once, and again at the end: " << end.err;
    EXPECT_NE(end.err.find("crash.gltf: error: hearth-import was ended by signal 11 (Segmentation fault): "
                           "contract broken [E7001]"),
              std::string::npos)
        << end.err;
    EXPECT_EQ(countOccurrences(end.err, "    5 cookers  "), 11u) << end.err;
    EXPECT_EQ(folder.list(), std::vector<std::string>{});
}

TEST_F(Batches, failuresAndWarningsBelongToTheirSource)
{
    std::vector<std::string> sources = crowd("warning");
    sources[5] = "malformed.gltf";
    const ProgramEnd end = cook(sources);
    EXPECT_EQ(end.exit_code, 65) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "malformed.gltf|/meshes/0: error: is bad [E1101]"), 2u)
        << "at once, and again at the end: " << end.err;
    for (size_t i = 0; i < sources.size(); ++i)
        EXPECT_EQ(countOccurrences(end.err, sources[i] + "|/extras: warning: left out [W1400]"),
                  i == 5 ? 0u : 1u)
            << end.err;
}

TEST_F(Batches, eventsAreThoseOfActionsAlone)
{
    std::vector<std::string> sources = crowd();
    sources[2] = "crash.gltf"; // sources after it are restarted
    EXPECT_EQ(cook(sources, with_events).exit_code, 70);
    const std::map<std::string, std::string> of_action = eventsOfActions();
    EXPECT_EQ(of_action.size(), 12u + 4 * 11u);
    for (const auto& [action, events] : of_action)
        EXPECT_EQ(events, action == "import crash.gltf" ? "start end failed" : "start end cooked") << action;
}

TEST_F(Batches, keepToTheMemory)
{
    EXPECT_EQ(cook(crowd("busy")).exit_code, 0);
    EXPECT_TRUE(folder.has("together"));
    fs::remove(folder / "together");
    // the memory estimate of an import of nothing is 16 MiB, and so is that of a batch of them
    EXPECT_EQ(cook(crowd("busy"), {"-j2", "--memory", "20M"}).exit_code, 0);
    EXPECT_FALSE(folder.has("together"));
}

TEST_F(Batches, endWhenInterrupted)
{
    const pid_t process = folder.start(command(crowd("slow"), {"-j2"}), {"TMPDIR="});
    for (int i = 0; i < 500 && processes("import") < 2; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_EQ(processes("import"), 2u);
    const auto start = std::chrono::steady_clock::now();
    ::kill(process, SIGINT);
    EXPECT_EQ(folder.finish(process).exit_code, 130);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_EQ(folder.list(), std::vector<std::string>{});
}

TEST(RealBatches, runEachLineAsIfAlone)
{
    Sandbox folder;
    writeObj(folder, "o");
    folder.write("lines", "[\"o.obj\", \"-o\", \"o.part\"]\n[\"none.obj\", \"-o\", \"none.part\"]\n"
                          "[\"--help\"]\n[\"o.obj\"]\n[]\n[\"o.obj\", 1]\n");
    const ProgramEnd end = folder.run({"/bin/sh", "-c", HEARTH_BIN "/hearth-import --batch < lines"});
    EXPECT_EQ(end.exit_code, 2) << "the last line";
    std::vector<int> exits;
    std::istringstream lines(end.out);
    for (std::string line; std::getline(lines, line);)
    {
        ASSERT_TRUE(line.starts_with('\x1E')) << end.out;
        const auto json = Json::parse(line.substr(1)).value();
        exits.push_back(json["exit"].get<int>());
        EXPECT_GT(json["seconds"].get<double>(), 0);
        EXPECT_GE(json["cpu_seconds"].get<double>(), 0);
        EXPECT_GT(json["peak_rss_bytes"].get<double>(), 1 << 20);
    }
    EXPECT_EQ(exits, (std::vector<int>{0, 66, 0, 2, 2})) << end.out;
    EXPECT_EQ(countOccurrences(end.err, "none.obj: error: "), 1u) << end.err;
    EXPECT_EQ(
        countOccurrences(end.err, "line 6: error: --batch reads lines that are each a JSON array of words"),
        1u)
        << end.err;
    EXPECT_EQ(folder.run({HEARTH_BIN "/hearth-import", "o.obj", "-o", "alone.part"}).exit_code, 0);
    EXPECT_EQ(folder.read("o.part"), folder.read("alone.part"));
}

TEST(RealBatches, sameBytesAndRecordsAsAlone)
{
    Sandbox folder;
    std::vector<std::string> sources;
    for (int i = 0; i < 10; ++i)
    {
        writeObj(folder, "o" + std::to_string(i), 1 + 0.1 * i, 10 * i);
        sources.push_back("o" + std::to_string(i) + ".obj");
    }
    const auto cook = [&](const std::vector<std::string>& of, const std::string& cache)
    {
        std::vector<std::string> command{HEARTH_BIN "/hearth",     "cook", "-q", "-o", "a.hearth", "--cache",
                                         "dir:" + (folder / cache)};
        command.insert(command.end(), of.begin(), of.end());
        // what they say of their work has its seconds
        const ProgramEnd end = folder.run(withoutLightCookers(std::move(command)));
        EXPECT_EQ(end.exit_code, 0) << end.err;
    };
    cook(sources, "batched");
    for (const std::string& source : sources)
        cook({source}, "alone");
    // entries are named by their action's record, contents by their bytes
    for (const char* kind : {"/ac", "/cas"})
    {
        const auto names = [&](const std::string& cache)
        {
            std::set<std::string> files;
            for (const auto& file : fs::recursive_directory_iterator(folder / (cache + kind)))
                if (file.is_regular_file())
                    files.insert(file.path().filename().string());
            return files;
        };
        const std::set<std::string> batched = names("batched"), alone = names("alone");
        EXPECT_GE(batched.size(), 30u);
        size_t others = 0;
        for (const std::string& name : batched)
            others += alone.count(name) == 0 ? 1u : 0u;
        EXPECT_EQ(others, 1u) << kind << ": the pack of all alone is another";
    }
}

} // namespace hearth::test
