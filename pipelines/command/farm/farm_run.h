// hearth plan, run and merge: a distributed build in three steps; the second one runs on any number of
// machines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/run_limits.h"
#include "pipelines/command/farm/open_plan.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

struct MakePlanOptions
{
    farm::Request request;
    std::string output;                ///< file, or "-"
    std::optional<size_t> shard_count; ///< nullopt: as many as are worthwhile
    std::string estimates_file;        ///< report of an earlier cook, for times and memory; empty: none
    std::vector<std::string> caches;
    bool emits_commands = false; ///< print the command line of each shard
    bool quiet = false;
};

struct RunOptions : PlanOptions, RunLimits
{
    std::string shard; ///< "I/N"; empty: index that the batch system gives
    farm::Step step = farm::Step::complete;
    std::string launcher;    ///< words before the shard's command line; empty: run here
    std::string record_file; ///< empty: none
};

struct MergeOptions : PlanOptions, RunLimits
{
    std::string output;
    bool lists_missing = false;            ///< list missing results instead of cooking them here
    bool skips_missing = false;            ///< as CookOptions::skips_missing
    std::vector<std::string> report_files; ///< as CookOptions::report_files
};

// Each returns the exit code; every problem has been printed on stderr.

int makePlanFile(const MakePlanOptions& options);

/// Run a shard. With a launcher the results in the cache decide on success, whatever the launcher returns.
int runShard(const RunOptions& options);

/// Read and hash every result, cook missing ones here (or list them: code 75), and link the pack.
int merge(const MergeOptions& options);

} // namespace hearth::command
