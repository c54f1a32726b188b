// Tests distributed builds with the real cookers: whatever happens to shards, the pack equals that of a
// single machine.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/command/farm/farm_folder.h"
#include "tests/support/small_sources.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <sys/stat.h>
#include <thread>

namespace hearth::test
{

namespace fs = std::filesystem;

TEST_F(Farm, makesTheBytesOfALocalCook)
{
    sources = {"house.obj", "tree.gltf"};
    const std::vector<std::string> options{"--visibility", "--visibility-quality", "draft", "--bricks"};
    const std::string pack = localPack(options);
    ASSERT_FALSE(pack.empty());
    std::mt19937 random(3);
    for (const size_t count : {size_t{1}, size_t{7}})
    {
        forget();
        plan(count, options);
        std::vector<size_t> order(count);
        std::iota(order.begin(), order.end(), size_t{0});
        for (const bool is_warm : {false, true})
        {
            std::shuffle(order.begin(), order.end(), random);
            for (const size_t shard : order)
            {
                const ProgramEnd end = run(shard, count);
                EXPECT_EQ(end.exit_code, 0) << end.err;
                EXPECT_TRUE(!is_warm || countOccurrences(end.err, " 0 cooked") == 1) << end.err;
            }
            EXPECT_TRUE(merged() == pack) << count << " shards, " << (is_warm ? "warm" : "cold");
        }
    }
}

TEST_F(Farm, readsNeighboursOfOtherShards)
{
    placeSources();
    const std::string pack = localPack(occlusion);
    std::vector<std::string> alone = occlusion;
    alone.insert(alone.end(), {"--visibility-occluders", "source"});
    ASSERT_NE(pack, localPack(alone)) << "sources occlude each other";
    for (const bool is_prepared : {true, false})
    {
        forget();
        plan(4, occlusion);
        if (is_prepared)
        {
            prepareAll(4);
            const ProgramEnd status = hearth({"farm", "status", "plan.json"});
            EXPECT_EQ(status.exit_code, 1);
            EXPECT_EQ(countOccurrences(status.out, " prepared "), 4u) << status.out;
        }
        for (size_t shard = 4; shard-- > 0;)
        {
            const ProgramEnd end = run(shard, 4);
            EXPECT_EQ(end.exit_code, 0) << end.err;
            EXPECT_NE(end.err.find(is_prepared ? " 1 cooked, 5 kept" : " cooked, "), std::string::npos)
                << end.err;
        }
        EXPECT_EQ(hearth({"farm", "status", "plan.json"}).exit_code, 0);
        EXPECT_EQ(hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "list"}).exit_code, 0);
        EXPECT_TRUE(merged() == pack) << is_prepared;
        EXPECT_NE(run(1, 4).err.find(" 0 cooked, 6 kept"), std::string::npos);
    }
}

TEST_F(Farm, makesNeighboursThatTheCacheHasLost)
{
    placeSources();
    const std::string pack = localPack(occlusion);
    plan(4, occlusion);
    prepareAll(4);
    for (const std::string& path : folder.cacheContents())
        fs::remove(path);
    for (size_t shard = 0; shard < 4; ++shard)
        EXPECT_EQ(run(shard, 4).exit_code, 0);
    EXPECT_TRUE(merged() == pack);
}

TEST_F(Farm, preparesWhatReadsNoOtherSource)
{
    placeSources();
    plan(2, occlusion);
    EXPECT_EQ(run(0, 2, {"--prepare"}).exit_code, 0);
    const ProgramEnd list = hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "list"});
    EXPECT_EQ(list.exit_code, 75);
    EXPECT_EQ(countOccurrences(list.out, "shard 0/2\n"), 2u) << list.out;
    EXPECT_EQ(countOccurrences(list.out, "shard 1/2\n"), 12u) << list.out;
    EXPECT_EQ(countOccurrences(list.out, "visibility "), 4u) << list.out;
    EXPECT_NE(list.err.find("it was prepared, but not completed"), std::string::npos) << list.err;
}

TEST_F(Farm, aFailedNeighbourIsSkipped)
{
    placeSources();
    folder.write("b.bin", "short");
    EXPECT_EQ(
        over("cook", {"-o", "local.hearth", "-q", "--no-cache", "--missing", "skip"}, occlusion).exit_code,
        1);
    const std::string pack = folder.read("local.hearth");
    plan(4, occlusion);
    int failed = 0;
    for (const bool is_preparation : {true, false})
        for (size_t shard = 0; shard < 4; ++shard)
        {
            const ProgramEnd end =
                run(shard, 4,
                    is_preparation ? std::vector<std::string>{"--prepare"} : std::vector<std::string>());
            failed += end.exit_code == 0 ? 0 : 1;
            EXPECT_TRUE(end.exit_code == 0 || end.exit_code == 65) << end.err;
            EXPECT_EQ(countOccurrences(end.err, "b.gltf"), end.exit_code == 0 ? 0u : 1u) << end.err;
        }
    EXPECT_EQ(failed, 2) << "both steps of the shard that has the failed source, and no other";
    const ProgramEnd list = hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "list"});
    EXPECT_EQ(countOccurrences(list.out, "b.gltf"), 6u) << list.out;
    EXPECT_EQ(countOccurrences(list.out, "\n"), 6u) << list.out;
    EXPECT_EQ(hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "skip"}).exit_code, 1);
    EXPECT_TRUE(folder.read("farm.hearth") == pack);
}

TEST_F(Farm, makesTheSameBytesElsewhere)
{
    const std::string pack = localPack();
    const mode_t mask = ::umask(077);
    Sandbox elsewhere;
    for (const std::string& name : folder.list())
        if (name != "local.hearth")
            fs::copy(folder / name, elsewhere / name);
    plan(2);
    const std::vector<std::vector<std::string>> environments{
        {"LC_ALL=de_DE.UTF-8", "TZ=Asia/Tokyo"},
        {"LC_ALL=C", "TZ=America/New_York", "TMPDIR=" + elsewhere.path()}};
    for (const std::string& shard : {std::string("0/2"), std::string("1/2")})
    {
        // the plan's folder is of another machine: the sources are elsewhere here
        const ProgramEnd end = hearthIn(
            elsewhere,
            {"run", folder / "plan.json", "-C", ".", "--shard", shard, "--cache", folder.cacheSpec()},
            environments[shard[0] == '0' ? 0 : 1]);
        EXPECT_EQ(end.exit_code, 0) << end.err;
    }
    ::umask(022);
    const ProgramEnd end = hearthIn(
        elsewhere, {"merge", folder / "plan.json", "-o", "farm.hearth", "--cache", folder.cacheSpec()});
    ::umask(mask);
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "source  "), 0u) << "nothing was left to cook: " << end.err;
    EXPECT_TRUE(elsewhere.read("farm.hearth") == pack);
}

TEST_F(Farm, cooksWhatShardsHaveNotLeft)
{
    const std::string pack = localPack();
    plan(2);
    EXPECT_EQ(run(1, 2).exit_code, 0);
    const ProgramEnd list = hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "list"});
    EXPECT_EQ(list.exit_code, 75) << "the shard may be run again";
    EXPECT_FALSE(folder.has("farm.hearth"));
    EXPECT_EQ(countOccurrences(list.out, "shard 0/2\n"), 10u) << list.out;
    EXPECT_EQ(countOccurrences(list.out, "shard 1/2\n"), 0u) << list.out;
    EXPECT_NE(
        list.err.find("plan.json|shard 0/2: warning: 10 results are missing: no record was left [W5100]"),
        std::string::npos)
        << list.err;
    const ProgramEnd end = hearth({"merge", "plan.json", "-o", "farm.hearth"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "source  "), 2u) << end.err;
    EXPECT_NE(end.err.find("10 results are missing, and cooked here"), std::string::npos) << end.err;
    EXPECT_TRUE(
        end.err.ends_with("merged    2 of 4 sources were cooked here: those of shard 0/2 were missing\n"))
        << end.err;
    EXPECT_TRUE(folder.read("farm.hearth") == pack);
    EXPECT_EQ(hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "list"}).exit_code, 0);
}

TEST_F(Farm, skipsWhatALocalCookSkips)
{
    folder.write("tree.bin", "short");
    EXPECT_EQ(over("cook", {"-o", "local.hearth", "-q", "--missing", "skip"}).exit_code, 1);
    const std::string pack = folder.read("local.hearth");
    forget();
    plan(2);
    run(0, 2);
    run(1, 2);
    EXPECT_EQ(hearth({"merge", "plan.json", "-o", "farm.hearth"}).exit_code, 65);
    EXPECT_FALSE(folder.has("farm.hearth"));
    const ProgramEnd end =
        hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "skip", "--report", "r.json"});
    EXPECT_EQ(end.exit_code, 1) << end.err;
    EXPECT_NE(end.err.find("made without 1 of 4 sources: tree.gltf"), std::string::npos) << end.err;
    EXPECT_TRUE(folder.read("farm.hearth") == pack);
    EXPECT_EQ(Json::parse(folder.read("r.json")).value()["status"], "incomplete");
    for (const std::vector<std::string>& farm :
         {std::vector<std::string>{"farm", "slurm", "plan.json", "--print", "--missing", "skip"},
          {"farm", "ninja", "plan.json", "-o", "build.ninja", "--missing", "skip"}})
    {
        const ProgramEnd script = hearth(farm);
        EXPECT_EQ(script.exit_code, 0) << script.err;
        const std::string text = script.out.empty() ? folder.read("build.ninja") : script.out;
        EXPECT_EQ(countOccurrences(text, " --missing skip"), 1u) << text;
        EXPECT_NE(text.find("merge"), std::string::npos) << text;
    }
}

TEST_F(Farm, tellsOfLostShardsOnOneLine)
{
    plan(4);
    EXPECT_EQ(run(2, 4).exit_code, 0);
    const ProgramEnd end = hearth({"merge", "plan.json", "-o", "farm.hearth"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(countOccurrences(end.err, "W5100"), 1u) << end.err;
    EXPECT_EQ(countOccurrences(end.err,
                               "plan.json|shards 0-1, 3 of 4: warning: 15 results are missing, and cooked "
                               "here: no record was left [W5100]\n"),
              1u)
        << end.err;
    EXPECT_TRUE(end.err.ends_with(
        "merged    3 of 4 sources were cooked here: those of shards 0-1, 3 of 4 were missing\n"))
        << end.err;
    const ProgramEnd again = hearth({"merge", "plan.json", "-o", "farm.hearth"});
    EXPECT_EQ(countOccurrences(again.err, "cooked here"), 0u) << again.err;
}

TEST_F(Farm, isSharedOutByAReportOfBefore)
{
    EXPECT_EQ(over("cook", {"-o", "local.hearth", "-q", "--report", "report.json"}).exit_code, 0);
    const std::string pack = folder.read("local.hearth");
    // as if one of four had taken as long as the others together
    auto report = Json::parse(folder.read("report.json")).value();
    for (auto& asset : report["assets"])
        for (auto& stage : asset["stages"])
            stage["seconds"] = asset["source"] == "bush.gltf" ? 30 : 10;
    folder.write("report.json", report.dump());
    const ProgramEnd end = over("plan", {"-o", "plan.json", "--estimates", "report.json"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_NE(end.err.find("4 shards of at most about 150 s"), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("4 of 4 sources have their times from report.json"), std::string::npos) << end.err;
    const ProgramEnd two =
        over("plan", {"-o", "plan.json", "-q", "--shards", "2", "--estimates", "report.json"});
    EXPECT_EQ(two.exit_code, 0);
    EXPECT_EQ(two.err, "");
    EXPECT_EQ(Json::parse(folder.read("plan.json")).value()["shards"], Json({{3}, {0, 1, 2}}));
    // no key has changed: all results exist, and the pack is the same
    for (size_t shard = 0; shard < 2; ++shard)
        EXPECT_NE(run(shard, 2).err.find(" 0 cooked"), std::string::npos);
    EXPECT_TRUE(merged() == pack);
    EXPECT_EQ(over("plan", {"-o", "none.json", "--estimates", "plan.json"}).exit_code, 65);
    EXPECT_EQ(over("plan", {"-o", "none.json", "--estimates", "nowhere.json"}).exit_code, 66);
    EXPECT_FALSE(folder.has("none.json"));
}

TEST_F(Farm, allStepsGoByTheSettings)
{
    const Sandbox elsewhere;
    folder.write("hearth.toml", "[defaults]\nlog = 'quiet'\ncache = 'dir:" + elsewhere / "cache" + "'\n");
    const std::vector<std::string> environment{"HEARTH_CACHE="};
    const auto step = [&](const std::vector<std::string>& words)
    {
        const ProgramEnd end = hearth(words, environment);
        EXPECT_EQ(end.exit_code, 0) << words.front();
        EXPECT_EQ(end.err, "") << words.front();
    };
    step({"plan", "bush.gltf", "-o", "plan.json"});
    step({"run", "plan.json", "--shard", "0/1"});
    EXPECT_TRUE(elsewhere.has("cache"));
    step({"farm", "status", "plan.json"});
    step({"merge", "plan.json", "-o", "farm.hearth"});
    for (const char* verb : {"run", "merge"})
    {
        std::vector<std::string> words{verb, "plan.json"};
        if (words.front() == "merge")
            words.insert(words.end(), {"-o", "farm.hearth"});
        EXPECT_EQ(hearth(words, {"HEARTH_JOBS=0"}).exit_code, 78);
    }
}

TEST_F(Farm, believesNoByteOfTheCache)
{
    const std::string pack = localPack();
    plan(1);
    EXPECT_EQ(run(0, 1).exit_code, 0);
    EXPECT_EQ(hearth({"farm", "status", "plan.json"}).exit_code, 0);
    const auto damage = [&]
    {
        for (const std::string& path : folder.cacheContents())
        {
            fs::permissions(path, fs::perms::owner_all);
            std::ofstream(path, std::ios::binary | std::ios::in) << "damage";
        }
    };
    damage();
    const ProgramEnd status = hearth({"farm", "status", "plan.json"});
    EXPECT_EQ(status.exit_code, 1);
    EXPECT_NE(status.out.find(" lost "), std::string::npos) << status.out;
    EXPECT_NE(status.out.find("0 of 1 shards are done\n"), std::string::npos) << status.out;
    // a shard that is run again repairs its earlier results
    EXPECT_EQ(run(0, 1).exit_code, 0);
    damage();
    EXPECT_EQ(run(0, 1).exit_code, 0);
    EXPECT_EQ(hearth({"farm", "status", "plan.json"}).exit_code, 0);
    EXPECT_TRUE(merged() == pack);
    damage();
    EXPECT_TRUE(merged() == pack);
}

TEST_F(Farm, aKilledShardLeavesNothingWrong)
{
    const std::string pack = localPack();
    plan(1);
    std::mt19937 random(11);
    int killed = 0;
    for (int round = 0; round < 4; ++round)
    {
        forget();
        const pid_t process =
            folder.start({HEARTH_BIN "/hearth", "run", "plan.json", "--shard", "0/1", "-j1"});
        std::this_thread::sleep_for(std::chrono::milliseconds(10 + random() % 100));
        ::kill(process, SIGKILL);
        const bool has_ended = folder.finish(process).exit_code == 0;
        killed += has_ended ? 0 : 1;
        EXPECT_EQ(hearth({"farm", "status", "plan.json"}).exit_code, has_ended ? 0 : 1);
        EXPECT_TRUE(merged() == pack);
    }
    EXPECT_GT(killed, 0) << "no shard was caught at work";
}

TEST_F(Farm, refusesToCookSomethingElse)
{
    plan(2);
    folder.write("house.obj", folder.read("house.obj") + "# edited\n");
    const ProgramEnd status = hearth({"farm", "status", "plan.json"});
    EXPECT_EQ(status.exit_code, 1);
    const ProgramEnd first = run(0, 2);
    const ProgramEnd second = run(1, 2);
    const ProgramEnd& refused = first.exit_code != 0 ? first : second;
    EXPECT_EQ(first.exit_code + second.exit_code, 65) << first.err << second.err;
    EXPECT_NE(refused.err.find("house.obj: error: its content has changed since it was planned [E5001]"),
              std::string::npos)
        << refused.err;
    const ProgramEnd merge = hearth({"merge", "plan.json", "-o", "farm.hearth"});
    EXPECT_EQ(merge.exit_code, 65);
    EXPECT_FALSE(folder.has("farm.hearth"));
    const ProgramEnd after = hearth({"farm", "status", "plan.json", "--format", "json"});
    const auto shards = Json::parse(after.out).value()["shards"];
    EXPECT_EQ(shards[&refused == &first ? 0 : 1]["state"], "failed");
    EXPECT_EQ(shards[&refused == &first ? 0 : 1]["exit"], 65);
    EXPECT_EQ(shards[&refused == &first ? 1 : 0]["state"], "done");
}

TEST_F(Farm, refusesTexturesThatAreNotThoseOfThePlan)
{
    // a plan knows the files that an import found if it was cooked before
    localPack();
    EXPECT_EQ(hearth({"cook", "house.obj", "-o", "house.hearth", "-q"}).exit_code, 0);
    plan(1);
    EXPECT_EQ(countOccurrences(folder.read("plan.json"), "source/house.tga"), 1u);
    folder.write("house.tga", tgaImage(9));
    const ProgramEnd end = run(0, 1);
    EXPECT_EQ(end.exit_code, 65);
    EXPECT_NE(end.err.find("house.tga, which it refers to, has changed"), std::string::npos) << end.err;
    // otherwise the merge detects it: a result that was cooked from another texture is not valid for these
    // files
    forget();
    plan(1);
    EXPECT_EQ(run(0, 1).exit_code, 0);
    folder.write("house.tga", tgaImage(200));
    const std::string pack = localPack();
    const ProgramEnd list = hearth({"merge", "plan.json", "-o", "farm.hearth", "--missing", "list"});
    EXPECT_EQ(countOccurrences(list.out, "house.obj"), 5u) << list.out;
    EXPECT_TRUE(merged() == pack);
}

TEST_F(Farm, aFailedSourceIsToldOnceAndByName)
{
    folder.write("tree.bin", "short");
    plan(4);
    int failed = 0;
    for (size_t shard = 0; shard < 4; ++shard)
        if (const ProgramEnd end = run(shard, 4); end.exit_code != 0)
        {
            ++failed;
            EXPECT_EQ(end.exit_code, 65);
            EXPECT_EQ(countOccurrences(end.err, ": error: "), 1u) << end.err;
            EXPECT_NE(end.err.find("tree.gltf"), std::string::npos) << end.err;
        }
    EXPECT_EQ(failed, 1);
    const ProgramEnd merge = hearth({"merge", "plan.json", "-o", "farm.hearth"});
    EXPECT_EQ(merge.exit_code, 65);
    EXPECT_NE(merge.err.find("with code 65: tree.gltf"), std::string::npos) << merge.err;
    EXPECT_FALSE(folder.has("farm.hearth"));
}

TEST_F(Farm, asksForAnotherTryWhereThatMayHelp)
{
    // a cache that cannot be written, as when the shared disk is gone
    plan(1);
    folder.write("file", "not a folder");
    const ProgramEnd lost = run(0, 1, {"--cache", "dir:file"});
    EXPECT_EQ(lost.exit_code, 75) << lost.err;
    EXPECT_EQ(countOccurrences(lost.err, "[E5102]"), 1u) << lost.err;
    // a cooker that was killed by the machine
    const fs::path copies = folder / "bin";
    fs::create_directory(copies);
    for (const auto& program : fs::directory_iterator(HEARTH_BIN))
        if (program.path().filename().string().starts_with("hearth"))
            fs::copy(program.path(), copies / program.path().filename());
    folder.write("bin/hearth-clusters", "#!/bin/sh\nkill -KILL $$\n", true);
    const std::string program = copies / "hearth";
    EXPECT_EQ(folder.run({program, "plan", "house.obj", "-o", "killed.json"}).exit_code, 0);
    const ProgramEnd killed = folder.run({program, "run", "killed.json", "--shard", "0/1"});
    EXPECT_EQ(killed.exit_code, 75) << killed.err;
    EXPECT_EQ(countOccurrences(killed.err, "[E5103]"), 1u) << killed.err;
    const ProgramEnd nothing = run(0, 1, {"--cache", "dir:nowhere,ro"});
    EXPECT_EQ(nothing.exit_code, 2) << nothing.err;
    // another build of hearth
    const ProgramEnd other = folder.run({program, "run", "plan.json", "--shard", "0/1"});
    EXPECT_EQ(other.exit_code, 65) << other.err;
    EXPECT_EQ(countOccurrences(other.err, "[E5002]"), 1u) << other.err;
}

TEST_F(Farm, settingsOfTheProjectAreInThePlanByValue)
{
    const std::string plain = localPack();
    folder.write("hearth.toml", "[defaults]\nprofile = 'phone'\n[profile.phone]\nclusters.normal_bits = 8\n"
                                "[[rule]]\nmatch = 'house.obj'\ntextures.max_size = 1\n");
    const std::string pack = localPack();
    EXPECT_NE(pack, plain);
    plan(2);
    fs::remove(folder / "hearth.toml");
    EXPECT_EQ(run(0, 2).exit_code, 0);
    EXPECT_EQ(run(1, 2).exit_code, 0);
    EXPECT_TRUE(merged() == pack);
}

TEST_F(Farm, reportsWhatBecameOfIt)
{
    plan(2);
    EXPECT_EQ(run(0, 2).exit_code, 0);
    EXPECT_EQ(run(1, 2).exit_code, 0);
    EXPECT_EQ(hearth({"merge", "plan.json", "-o", "a.hearth", "--report", "a.json"}).exit_code, 0);
    const auto report = Json::parse(folder.read("a.json")).value();
    EXPECT_EQ(report["totals"]["actions"]["cached"], 20) << "all but the link";
    EXPECT_FALSE(report["assets"][3]["clusters"].is_null());
    EXPECT_TRUE(folder.read("a.hearth") == localPack());
}

TEST_F(Farm, refusesWhatIsNoPlan)
{
    const auto refused = [&](const std::string& file, int code)
    {
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"run", file, "--shard", "0/1"},
              {"merge", file, "-o", "a.hearth"},
              {"farm", "status", file},
              {"farm", "slurm", file, "--print"},
              {"farm", "ninja", file, "-o", "build.ninja"}})
        {
            const ProgramEnd end = hearth(arguments);
            EXPECT_EQ(end.exit_code, code) << arguments[0] << end.err;
            EXPECT_EQ(countOccurrences(end.err, "\n"), 1u) << end.err;
            EXPECT_EQ(end.out, "");
        }
        EXPECT_FALSE(folder.has("a.hearth"));
        EXPECT_FALSE(folder.has("build.ninja"));
    };
    refused("nowhere.json", 66);
    folder.write("torn.json", plan(1).substr(0, 300));
    refused("torn.json", 65);
    folder.write("shown.json", hearth({"cook", "house.obj", "-o", "a.hearth", "-n", "--format", "json"}).out);
    refused("shown.json", 65);
    // settings come from a command line, with its limits
    for (const char* setting : {"bricks.voxel_size=0", "visibility.quality=best", "visibility.qualty=high",
                                "-o=x", "more.obj", "--help", ""})
    {
        Json json = Json::parse(plan(1)).value();
        json["cook"]["settings"][0].push_back(setting);
        folder.write("edited.json", json.dump());
        const ProgramEnd end = hearth({"run", "edited.json", "--shard", "0/1"});
        EXPECT_EQ(end.exit_code, 65) << setting;
        EXPECT_NE(end.err.find("edited.json|/cook: error: "), std::string::npos) << end.err;
    }
    EXPECT_EQ(hearth({"plan", "--", "-o.obj", "-o", "p.json"}).exit_code, 2);
    EXPECT_EQ(hearth({"run", "plan.json"}).exit_code, 2) << "which shard?";
    EXPECT_EQ(hearth({"run", "plan.json"}, {"SLURM_ARRAY_TASK_ID=0"}).exit_code, 0);
    EXPECT_EQ(hearth({"run", "plan.json", "--shard", "0/2"}).exit_code, 2);
}

} // namespace hearth::test
