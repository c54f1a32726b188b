// Tests the ways to run a plan: launchers, lists of commands, Ninja, and the script for Slurm.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/command/farm/farm_folder.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace fs = std::filesystem;

TEST_F(Farm, aLauncherIsNotBelieved)
{
    plan(2);
    folder.write("liar", "#!/bin/sh\nexit 0\n", true);
    folder.write("honest", "#!/bin/sh\n\"$@\"\nexit 3\n", true);
    const ProgramEnd lied = run(0, 2, {"--launcher", folder / "liar --much", "--record", "0.json"});
    EXPECT_EQ(lied.exit_code, 75);
    EXPECT_NE(lied.err.find("plan.json|shard 0/2: error: the launcher ended well, but the shard has left no "
                            "record in the cache [E5101]"),
              std::string::npos)
        << lied.err;
    EXPECT_FALSE(folder.has("0.json"));
    const ProgramEnd done = run(0, 2, {"--launcher", folder / "honest", "--record", "0.json"});
    EXPECT_EQ(done.exit_code, 0) << "its code is no matter: " << done.err;
    EXPECT_EQ(Json::parse(folder.read("0.json")).value()["actions"].size(), 10u);
    // the launcher still reports success falsely, but all results exist
    EXPECT_EQ(run(0, 2, {"--launcher", folder / "liar"}).exit_code, 0);
    fs::remove(folder.cacheContents().front());
    EXPECT_EQ(run(0, 2, {"--launcher", folder / "liar"}).exit_code, 75);
}

TEST_F(Farm, givesLinesToWhoeverTakesThem)
{
    const std::string pack = localPack();
    const ProgramEnd plan = over("plan", {"-o", "it's a plan.json", "--shards", "3", "--emit", "commands"});
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    EXPECT_EQ(countOccurrences(plan.out, "\n"), 3u) << plan.out;
    folder.write("lines", plan.out);
    const size_t merge = plan.err.find("after them: ");
    ASSERT_NE(merge, std::string::npos) << plan.err;
    // run from another folder, last shard first
    const ProgramEnd end = folder.run({"/bin/sh", "-c", "mkdir sub; cd sub; tac ../lines | sh -e"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(hearth({"farm", "status", "it's a plan.json"}).exit_code, 0);
    EXPECT_EQ(folder.run({"/bin/sh", "-c", plan.err.substr(merge + 12)}).exit_code, 0);
    EXPECT_TRUE(folder.read("it's a plan.hearth") == pack);
}

TEST_F(Farm, givesLinesThatPrepareBeforeThoseThatComplete)
{
    placeSources();
    const std::string pack = localPack(occlusion);
    const ProgramEnd plan =
        over("plan", {"-o", "plan.json", "--shards", "3", "--emit", "commands"}, occlusion);
    EXPECT_EQ(countOccurrences(plan.out, "\n"), 6u) << plan.out;
    EXPECT_EQ(countOccurrences(plan.out.substr(0, plan.out.size() / 2), "--prepare"), 3u) << plan.out;
    folder.write("lines", plan.out);
    // also in the wrong order
    for (const char* order : {"cat", "tac"})
    {
        forget();
        const ProgramEnd end = folder.run({"/bin/sh", "-c", std::string(order) + " lines | sh -e"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
        EXPECT_EQ(hearth({"farm", "status", "plan.json"}).exit_code, 0);
        EXPECT_TRUE(merged() == pack);
    }
}

TEST_F(Farm, isBuiltByNinjaInTwoSteps)
{
    placeSources();
    const std::string pack = localPack(occlusion);
    plan(3, occlusion);
    const ProgramEnd written = hearth(
        {"farm", "ninja", "plan.json", "-o", "build.ninja", "--launcher", "env", "--pack", "out.hearth"});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    const ProgramEnd built = folder.run({"/usr/bin/env", "ninja", "-v"});
    EXPECT_EQ(built.exit_code, 0) << built.out << built.err;
    EXPECT_LT(built.out.rfind("--prepare"), built.out.find("[4/7]")) << built.out;
    EXPECT_TRUE(folder.read("out.hearth") == pack);
    EXPECT_NE(folder.run({"/usr/bin/env", "ninja"}).out.find("no work to do"), std::string::npos);
}

TEST_F(Farm, printsAScriptForSlurmWithTwoSteps)
{
    placeSources();
    plan(3, occlusion);
    const ProgramEnd end = hearth({"farm", "slurm", "plan.json", "--print"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(countOccurrences(end.out, "#SBATCH --array=0-2\n"), 2u) << end.out;
    EXPECT_EQ(countOccurrences(end.out, " --prepare "), 1u) << end.out;
    EXPECT_NE(end.out.find("--dependency=\"afterany:${prepare%%;*}\""), std::string::npos) << end.out;
    folder.write("sbatch", "#!/bin/sh\necho \"$@\" >> order\ncat > job$$\necho $(wc -l < order)\n", true);
    const ProgramEnd submitted =
        hearth({"farm", "slurm", "plan.json"}, {"PATH=" + folder.path() + ":/usr/bin:/bin"});
    EXPECT_EQ(submitted.out, "prepare: job 1\nshards: job 2\nmerge: job 3\n") << submitted.err;
    EXPECT_EQ(folder.read("order"),
              "--parsable\n--parsable --dependency=afterany:1\n--parsable --dependency=afterany:2\n");
}

TEST_F(Farm, isBuiltByNinja)
{
    const std::string pack = localPack();
    plan(3);
    const ProgramEnd written = hearth({"farm", "ninja", "plan.json", "-o", "build.ninja", "--launcher",
                                       "env WHERE=$HOME", "--pack", "out put.hearth"});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    const auto ninja = [&] { return folder.run({"/usr/bin/env", "ninja", "-k", "0"}); };
    const ProgramEnd built = ninja();
    EXPECT_EQ(built.exit_code, 0) << built.out << built.err;
    EXPECT_TRUE(folder.read("out put.hearth") == pack);
    EXPECT_NE(ninja().out.find("no work to do"), std::string::npos);
    // a launcher that falsely reports success breaks the build where nothing was done
    forget();
    fs::remove_all(folder / "plan.json.shards");
    fs::remove(folder / "out put.hearth");
    EXPECT_EQ(hearth({"farm", "ninja", "plan.json", "-o", "build.ninja", "--launcher", "true", "--pack",
                      "out put.hearth"})
                  .exit_code,
              0);
    const ProgramEnd lied = ninja();
    EXPECT_NE(lied.exit_code, 0);
    EXPECT_EQ(countOccurrences(lied.out, "[E5101]"), 3u) << lied.out;
    EXPECT_FALSE(folder.has("out put.hearth"));
}

TEST_F(Farm, printsTheScriptForSlurm)
{
    plan(7);
    const ProgramEnd end = hearth({"farm", "slurm", "plan.json", "--print", "--partition", "cook",
                                   "--mem-per-shard", "2G", "--max-retries", "5"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    for (const char* line : {"#SBATCH --array=0-6\n", "#SBATCH --partition=cook\n", "#SBATCH --mem=2048M\n",
                             "--dependency=\"afterany:", "\"$SLURM_ARRAY_TASK_ID/7\" --memory 2048M",
                             "-lt 5 ]", "hearth merge "})
        EXPECT_NE(end.out.find(line), std::string::npos) << line << end.out;
    folder.write("script", end.out);
    EXPECT_EQ(folder.run({"/bin/sh", "-n", "script"}).exit_code, 0);
    EXPECT_EQ(hearth({"farm", "slurm", "plan.json", "--print", "--partition", "a\nb"}).exit_code, 2);
    // the generated script submits; here sbatch is a stub
    folder.write("sbatch", "#!/bin/sh\ncat > job$$\necho 17\n", true);
    const ProgramEnd submitted =
        hearth({"farm", "slurm", "plan.json"}, {"PATH=" + folder.path() + ":/usr/bin:/bin"});
    EXPECT_EQ(submitted.out, "shards: job 17\nmerge: job 17\n") << submitted.err;
    folder.write("sbatch", "#!/bin/sh\nexit 1\n", true);
    EXPECT_EQ(hearth({"farm", "slurm", "plan.json"}, {"PATH=" + folder.path() + ":/usr/bin:/bin"}).exit_code,
              74);
}

} // namespace hearth::test
