// hearth plan, hearth run and hearth merge: a cook in three steps, the middle one on as many machines as there are.
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
    std::optional<size_t> shard_count; ///< nothing: as many as are worth while
    std::string estimates_file;        ///< a report whose times and memory are gone by; empty: none
    std::vector<std::string> caches;
    bool emits_commands = false; ///< print a command line for each shard
    bool quiet = false;
};

struct RunOptions : PlanOptions, Effort
{
    std::string shard;       ///< "I/N"; empty: as the batch system says
    std::string launcher;    ///< words before the command line of the shard; empty: it runs here
    std::string record_file; ///< empty: none
};

struct MergeOptions : PlanOptions, Effort
{
    std::string output;
    bool cooks_missing = true;             ///< else what is missing is listed
    std::vector<std::string> report_files; ///< as CookOptions::report_files
};

// Each returns the exit code; every problem has been told on stderr.

int makePlanFile(const MakePlanOptions& options);

/// Through a launcher, what the shard has left in the cache is looked at, whatever the launcher says.
int runShard(const RunOptions& options);

/// Read and hash every result, have what is missing cooked here (or list it: code 75), and link the pack.
int merge(const MergeOptions& options);

} // namespace hearth::command
