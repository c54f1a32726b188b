// Converts a plan into jobs for batch systems: command lines, a build file for Ninja, a script for Slurm.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/farm/plan.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::farm
{

/// Arguments that all commands of a farm job share. Paths are absolute, so that commands can be started from
/// any folder.
struct FarmJob
{
    std::string hearth; ///< path of the hearth executable
    std::string plan_file;
    std::string pack;                ///< output of the merge
    std::string directory;           ///< folder of the sources; empty: as the plan says
    std::vector<std::string> caches; ///< values of --cache
    size_t shard_count = 1;
    bool has_two_steps = false; ///< all shards are prepared first: Step::prepare
    bool skips_missing = false; ///< the merge leaves out sources that cannot be cooked
};

/// Quote a word of a command line for a POSIX shell.
std::string quoteForShell(const std::string& word);

/// Return a command line for each step of each shard, for GNU parallel, xargs, OpenCue's cuecmd and other
/// programs that take lists of them. Lines that prepare come first. A line that is run before them makes what
/// it lacks itself, so their order is no matter for the results.
std::string shardCommands(const FarmJob& job);
/// Return the command line to run after all shards, without a line break.
std::string mergeCommand(const FarmJob& job);

/// Return a build file for Ninja that runs each step of each shard through `launcher` ("srun -Q -n1"; empty:
/// none), checks its results, and merges. Records of shards are written to the folder PLAN.shards.
std::string ninjaFile(const FarmJob& job, const std::string& launcher);

struct SlurmOptions
{
    std::string partition;     ///< empty: the cluster's default
    uint64_t memory_bytes = 0; ///< for each shard
    uint64_t merge_memory_bytes = 0;
    unsigned retries = 2; ///< retries of a shard that ends with code 75
};

/// Return a shell script that submits each step of the shards as a job array, one after the other, and after
/// them the merge, however they end.
std::string slurmScript(const FarmJob& job, const SlurmOptions& options);

/// Return the estimated peak memory of hearth and of one cooker, over the actions of sources (shardMemory) or
/// of all actions (mergeMemory).
uint64_t shardMemory(const graph::Graph& graph);
uint64_t mergeMemory(const graph::Graph& graph);

} // namespace hearth::farm
