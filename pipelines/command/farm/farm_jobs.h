// hearth farm: hands a plan to a batch system (distributed build), and prints the state of its shards.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/farm/open_plan.h"

#include <optional>
#include <string>

namespace hearth::command
{

/// Options of the verbs that write commands for a merge.
struct FarmVerbOptions : PlanOptions
{
    std::string pack;    ///< empty: beside the plan, and named after it
    std::string missing; ///< word of --missing for the merge
};

struct SlurmVerbOptions : FarmVerbOptions
{
    std::string partition;
    std::optional<uint64_t> memory_bytes; ///< of a shard; nullopt: the estimate for its cookers
    unsigned retries = 2;
    bool prints = false; ///< print the script instead of submitting it
};

struct NinjaVerbOptions : FarmVerbOptions
{
    std::string output;
    std::string launcher;
};

// Each returns the exit code; every problem has been printed on stderr.

int submitToSlurm(const SlurmVerbOptions& options);
int writeNinjaFile(const NinjaVerbOptions& options);

/// Read and hash the results of every shard. returns  1 if a shard is incomplete
int printFarmStatus(const PlanOptions& options, const std::string& format);

} // namespace hearth::command
