// A plan as work for batch systems: command lines, a build file for Ninja, a script for Slurm.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/farm/plan.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::farm
{

/// What every machine is told. Paths are absolute, so that it is no matter where a command is started.
struct FarmJob
{
    std::string hearth; ///< the program
    std::string plan_file;
    std::string pack;                ///< that the merge writes
    std::string directory;           ///< of the sources; empty: as the plan says
    std::vector<std::string> caches; ///< of --cache
    size_t shard_count = 1;
};

/// A word of a command line as a POSIX shell reads it.
std::string shellQuoted(const std::string& word);

/// A command line for each shard, for GNU parallel, xargs, OpenCue's cuecmd and others that take lists of them.
std::string shardCommands(const FarmJob& job);
/// What is to be done after all of them, in a line without a break.
std::string mergeCommand(const FarmJob& job);

/// A file for Ninja that runs each shard through `launcher` ("srun -Q -n1"; empty: none), checks what it has left, and merges.
/// Records of shards are written to the folder PLAN.shards.
std::string ninjaFile(const FarmJob& job, const std::string& launcher);

struct SlurmOptions
{
    std::string partition;     ///< empty: the cluster's own
    uint64_t memory_bytes = 0; ///< of a shard
    uint64_t merge_memory_bytes = 0;
    unsigned retries = 2; ///< of a shard that asks for another try
};

/// A shell script that submits the shards as an array, and the merge after them, however they end.
std::string slurmScript(const FarmJob& job, const SlurmOptions& options);

/// The most that one cooker is thought to take, of actions of sources or of those of the pack; and what hearth takes.
uint64_t shardMemory(const graph::Graph& graph);
uint64_t mergeMemory(const graph::Graph& graph);

} // namespace hearth::farm
