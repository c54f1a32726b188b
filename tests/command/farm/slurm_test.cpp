// Tests a real Slurm cluster on one machine: the demo in shards, a node with a power cut, and a launcher with
// false reports.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/command/farm/slurm_cluster.h"

#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

constexpr int kNodes = 3;

class Slurm : public ::testing::Test
{
protected:
    Slurm()
    {
        // the same cookers, but slowed down, so that something can happen meanwhile
        fs::create_directory(folder / "bin");
        for (const auto& program : fs::directory_iterator(HEARTH_BIN))
            if (program.path().filename().string().starts_with("hearth-"))
                fs::create_symlink(program.path(), folder / "bin" / program.path().filename());
        fs::copy(HEARTH_BIN "/hearth", folder / "bin/hearth");
        // one of each step of a shard
        for (const std::string name : {"hearth-skinning", "hearth-visibility"})
        {
            fs::remove(folder / ("bin/" + name));
            folder.write("bin/" + name, "#!/bin/sh\nsleep 4\nexec " HEARTH_BIN "/" + name + " \"$@\"\n",
                         true);
        }
    }

    /// Write small samples of these kinds; return the pack that a cook on this machine makes of them.
    std::string samples(const std::vector<std::string>& kinds)
    {
        for (const std::string& kind : kinds)
        {
            EXPECT_EQ(folder
                          .run({HEARTH_BIN "/hearth-samples", kind, "-o", kind + ".glb", "--triangles",
                                "2000", "--texture-size", "32"})
                          .exit_code,
                      0);
            files.push_back(kind + ".glb");
        }
        EXPECT_EQ(
            folder
                .run(withSources({HEARTH_BIN "/hearth", "cook"}, {"-o", "local.hearth", "-q", "--no-cache"}))
                .exit_code,
            0);
        return folder.read("local.hearth");
    }

    std::vector<std::string> withSources(std::vector<std::string> command,
                                         const std::vector<std::string>& more)
    {
        command.insert(command.end(), files.begin(), files.end());
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }

    Sandbox folder;
    std::vector<std::string> files;
    std::string hearth = folder / "bin/hearth";
};

/// Return the number in "shards: job 12".
std::string jobIn(const std::string& text, const std::string& before)
{
    const size_t at = text.find(before);
    if (at == std::string::npos)
        return "";
    return text.substr(at + before.size(), text.find('\n', at) - at - before.size());
}

/// Wait until the job has left the queue, with a limit for a busy machine.
void waitFor(const std::string& job, SlurmCluster& cluster)
{
    const auto ended_by = std::chrono::steady_clock::now() + std::chrono::seconds(240);
    while (!cluster.getState(job).empty() && std::chrono::steady_clock::now() < ended_by)
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
}

} // namespace

TEST_F(Slurm, cooksTheDemoWhateverBecomesOfANode)
{
    if (const std::string why = SlurmCluster::whyNot(); !why.empty())
        GTEST_SKIP() << why;
    const std::string pack = samples({"scene", "rock", "terrain", "character", "transforms"});
    ASSERT_FALSE(pack.empty());

    SlurmCluster cluster(folder, kNodes);
    ASSERT_TRUE(cluster.waitForIdle(kNodes, 30)) << cluster.logs();
    ASSERT_EQ(folder.run(withSources({hearth, "plan"}, {"-o", "demo.plan.json", "--shards", "5"})).exit_code,
              0);
    const ProgramEnd submitted =
        folder.run({hearth, "farm", "slurm", "demo.plan.json", "--partition", "cook", "--max-retries", "3"},
                   cluster.environment());
    ASSERT_EQ(submitted.exit_code, 0) << submitted.err << cluster.logs();
    const std::string shards = jobIn(submitted.out, "shards: job ");
    const std::string merge = jobIn(submitted.out, "merge: job ");

    // power cut of a node in the middle of a shard
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const auto killed_by = now() + std::chrono::seconds(90);
    size_t killed = 0;
    while (killed == 0 && now() < killed_by)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        if (cluster.getState(shards).find("R w2\n") != std::string::npos)
            killed = cluster.killNode("w2");
    }
    ASSERT_GT(killed, 0u) << cluster.logs();

    waitFor(merge, cluster);
    const ProgramEnd shown = cluster.run({"scontrol", "show", "job", merge});
    const std::string log = folder.read("slurm-" + merge + ".out");
    EXPECT_NE(shown.out.find("JobState=COMPLETED"), std::string::npos) << shown.out << log << cluster.logs();
    EXPECT_TRUE(folder.read("demo.hearth") == pack) << log;
    EXPECT_EQ(log.find("are missing"), std::string::npos)
        << "the queue has run the lost shard again: " << log;
    const ProgramEnd status = folder.run({hearth, "farm", "status", "demo.plan.json"});
    EXPECT_EQ(status.exit_code, 0) << status.out;
    const ProgramEnd tasks = cluster.run({"scontrol", "show", "job", shards});
    EXPECT_GE(countOccurrences(tasks.out, "Restarts=1"), 1u) << tasks.out;
}

TEST_F(Slurm, believesNoLauncher)
{
    if (const std::string why = SlurmCluster::whyNot(); !why.empty())
        GTEST_SKIP() << why;
    const std::string pack = samples({"rock", "transforms"});
    ASSERT_FALSE(pack.empty());
    SlurmCluster cluster(folder, 1);
    ASSERT_TRUE(cluster.waitForIdle(1, 30)) << cluster.logs();
    ASSERT_EQ(folder.run(withSources({hearth, "plan"}, {"-o", "demo.plan.json", "--shards", "2"})).exit_code,
              0);
    // srun reports success for a program that has done nothing
    const ProgramEnd first =
        folder.run({hearth, "run", "demo.plan.json", "--shard", "0/2", "--launcher", "srun -Q -n1"},
                   cluster.environment());
    EXPECT_EQ(first.exit_code, 0) << first.err << cluster.logs();
    const ProgramEnd lied =
        folder.run({hearth, "run", "demo.plan.json", "--shard", "1/2", "--launcher", "srun -Q -n1 true"},
                   cluster.environment());
    EXPECT_EQ(lied.exit_code, 75) << lied.err;
    EXPECT_NE(lied.err.find("[E5101]"), std::string::npos) << lied.err;
    const ProgramEnd list =
        folder.run({hearth, "merge", "demo.plan.json", "-o", "a.hearth", "--missing", "list"});
    EXPECT_EQ(list.exit_code, 75);
    // clusters, textures, texels, skinning, visibility; the other shard has made the import, to know its
    // neighbours
    EXPECT_EQ(countOccurrences(list.out, "shard 1/2\n"), 5u) << list.out;
    EXPECT_EQ(countOccurrences(list.out, "shard 0/2\n"), 0u) << list.out;
    EXPECT_EQ(folder.run({hearth, "merge", "demo.plan.json", "-o", "a.hearth"}).exit_code, 0);
    EXPECT_TRUE(folder.read("a.hearth") == pack);
}

TEST_F(Slurm, triesAgainWhereThatMayHelp)
{
    if (const std::string why = SlurmCluster::whyNot(); !why.empty())
        GTEST_SKIP() << why;
    const std::string pack = samples({"transforms"});
    ASSERT_FALSE(pack.empty());
    // a cooker that needs more memory than the first machine has
    fs::remove(folder / "bin/hearth-clusters");
    folder.write("bin/hearth-clusters",
                 "#!/bin/sh\nif [ ! -e '" + folder / "tried" + "' ]; then touch '" + folder / "tried" +
                     "'; kill -KILL $$; fi\nexec " HEARTH_BIN "/hearth-clusters \"$@\"\n",
                 true);
    SlurmCluster cluster(folder, 1);
    ASSERT_TRUE(cluster.waitForIdle(1, 30)) << cluster.logs();
    ASSERT_EQ(folder.run(withSources({hearth, "plan"}, {"-o", "demo.plan.json"})).exit_code, 0);
    const ProgramEnd submitted =
        folder.run({hearth, "farm", "slurm", "demo.plan.json", "--max-retries", "1"}, cluster.environment());
    const std::string shards = jobIn(submitted.out, "shards: job ");
    const std::string merge = jobIn(submitted.out, "merge: job ");
    ASSERT_FALSE(merge.empty()) << submitted.err << cluster.logs();
    waitFor(merge, cluster);
    const std::string log = folder.read("slurm-" + merge + ".out");
    EXPECT_NE(cluster.run({"scontrol", "show", "job", shards}).out.find("Restarts=1"), std::string::npos);
    EXPECT_EQ(log.find("are missing"), std::string::npos) << log;
    EXPECT_TRUE(folder.read("demo.hearth") == pack) << log << cluster.logs();
}

} // namespace hearth::test
