// Record of a finished shard: stored in the cache, where merging and monitoring processes find it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache.h"
#include "pipelines/farm/plan.h"
#include "pipelines/graph/journal.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::farm
{

struct ShardAction
{
    size_t action = 0; ///< index in the plan's graph
    graph::Outcome ending = graph::Outcome::unknown;
    graph::CachedResult result; ///< outputs, seconds and memory; no outputs where it failed
};

struct ShardRecord
{
    int exit_code = 0;
    double seconds = 0;
    std::string machine;
    std::vector<std::string> errors; ///< lines
    std::vector<ShardAction> actions;
};

/// Return the number of actions with that outcome.
size_t countActions(const ShardRecord& record, graph::Outcome ending);

/// Return the cache key of a shard's record: each run of the same step of the same shard of the same plan
/// writes the same entry.
/// plan_hash  SHA-256 of the plan's text
std::string recordKey(const std::string& plan_hash, size_t shard, Step step);

/// Read the record of a step of a shard; nullopt where there is none.
std::optional<ShardRecord> readRecord(const std::string& plan_hash, size_t shard, Step step,
                                      cache::Cache& cache);

/// Return the results of all other shards of the plan by action, as their records have them. The records are
/// believed: a wrong one costs work, since what is made of its results is not found under its true key.
std::map<size_t, graph::CachedResult> readOtherResults(const Plan& plan, const std::string& plan_hash,
                                                       size_t shard, cache::Cache& cache);

cache::Fields recordFields(const ShardRecord& record);
/// Parse a record; nullopt where the fields are not those of a record.
std::optional<ShardRecord> parseRecord(const cache::Fields& fields);

/// Serialize a record as JSON, schema "hearth.shard/1", for people and monitoring programs.
std::string recordJson(const ShardRecord& record, const Plan& plan, size_t shard);

/// Verified state of a shard.
struct ShardState
{
    enum class Kind
    {
        no_record, ///< not ended, or not started
        failed,    ///< its record reports a failure
        lost,   ///< results of its record are missing from the cache or damaged, or the record is incomplete
        intact, ///< all its results are in the cache, byte for byte
    };
    Kind kind = Kind::no_record;
    ShardRecord record; ///< empty where there is none
};

/// Verify a step of a shard: read and hash every result of its record.
/// scratch  folder for temporary files; nothing remains in it
ShardState verifyShard(const Plan& plan, const std::string& plan_hash, size_t shard, Step step,
                       cache::Cache& cache, const std::string& scratch);

/// Return the actions of sources whose results are not available from the cache, by index, ascending. Actions
/// are looked up by their current inputs, without trusting records of shards, and results are read and
/// hashed. An action that depends on a missing result counts as missing. Sources without an import are no
/// neighbours, as in a pack that lacks them.
std::vector<size_t> missingResults(graph::Graph graph, cache::Cache& cache, graph::ActionCache& actions,
                                   const std::string& scratch);

} // namespace hearth::farm
