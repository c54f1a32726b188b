// Cooks one shard of a plan, into the cache.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/farm/shard_record.h"
#include "pipelines/graph/executor.h"

#include <optional>
#include <string>

namespace hearth::farm
{

/// "another try may go better": batch systems put a job that ends with it back into the queue.
inline constexpr int kTryAgain = 75;

struct ShardOptions
{
    graph::CrewLimits limits;
    std::string programs;  ///< folder of the cookers
    std::string plan_file; ///< as messages name it
};

/// What a process knows of the results and files that are there.
struct Kitchen
{
    cache::Cache& cache;
    graph::ActionCache& actions;
    graph::FileHashes& hashes;
};

/// Cook what the cache does not have of the shard, from what was planned and nothing else, and leave a record in the cache. It
/// may be run any number of times, on several machines at once.
///
/// events    what fails is told by events.failed, too; failures that are no action's are of source `source_count`
/// returns   the record, whose exit code is 0 where every result is in the cache, whole; nullopt where a signal ended it: then
///           there is no record of this run
std::optional<ShardRecord> runShard(const Plan& plan, const std::string& plan_hash, size_t shard,
                                    const Kitchen& kitchen, const ShardOptions& options,
                                    const graph::ExecutorEvents& events);

} // namespace hearth::farm
