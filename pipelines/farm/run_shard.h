// Cooks one shard of a plan and stores its results in the cache.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/farm/shard_record.h"
#include "pipelines/graph/executor.h"

#include <optional>
#include <string>

namespace hearth::farm
{

/// Exit code for "a retry may succeed" (EX_TEMPFAIL): batch systems requeue a job that ends with it.
inline constexpr int kExitRetry = 75;

struct ShardOptions
{
    graph::PoolLimits limits;
    std::string programs;  ///< folder of the cookers
    std::string plan_file; ///< name for messages
    Step step = Step::complete;
};

/// Handles of the caches of a process: contents, results of actions, hashes of files.
struct CacheHandles
{
    cache::Cache& cache;
    graph::ActionCache& actions;
    graph::FileHashes& hashes;
};

/// Cook the actions of a shard's step that the cache does not have, exactly as planned, and put a record into
/// the cache. Safe to run any number of times, on several machines at once. Results of other shards that it
/// reads are made here, if no record of these shards has them; a source of theirs that fails is no neighbour,
/// and is for them to report.
///
/// events    get the actions and failures of the shard's sources. events.failed also reports failures of the
///           shard; a failure that belongs to no action has source `source_count`
/// returns   the record; its exit code is 0 if every result is in the cache, intact; nullopt where a signal
///           ended it: then there is no record of this run
std::optional<ShardRecord> runShard(const Plan& plan, const std::string& plan_hash, size_t shard,
                                    const CacheHandles& caches, const ShardOptions& options,
                                    const graph::ExecutorEvents& events);

} // namespace hearth::farm
