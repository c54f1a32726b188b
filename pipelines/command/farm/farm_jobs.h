// hearth farm: hands a plan to a batch system, and tells how far its shards are.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/farm/open_plan.h"

#include <optional>
#include <string>

namespace hearth::command
{

struct SlurmVerbOptions : PlanOptions
{
    std::string pack;
    std::string partition;
    std::optional<uint64_t> memory_bytes; ///< of a shard; nothing: as its cookers are thought to need
    unsigned retries = 2;
    bool prints = false; ///< print the script, and submit nothing
};

struct NinjaVerbOptions : PlanOptions
{
    std::string pack;
    std::string output;
    std::string launcher;
};

// Each returns the exit code; every problem has been told on stderr.

int farmSlurm(const SlurmVerbOptions& options);
int farmNinja(const NinjaVerbOptions& options);

/// Read and hash what every shard has left. returns  1 where a shard has not left all
int farmStatus(const PlanOptions& options, const std::string& format);

} // namespace hearth::command
