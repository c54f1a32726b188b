// What a shard says of itself when it ends: kept in the cache, where everyone who merges or watches finds it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache.h"
#include "pipelines/farm/plan.h"
#include "pipelines/graph/journal.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::farm
{

struct ShardAction
{
    size_t action = 0; ///< of the plan's graph
    graph::Ending ending = graph::Ending::unknown;
    graph::KeptResult result; ///< outputs, seconds and memory; outputs none where it failed
};

struct ShardRecord
{
    int exit_code = 0;
    double seconds = 0;
    std::string machine;
    std::vector<std::string> errors; ///< lines
    std::vector<ShardAction> actions;
};

/// Actions that ended so.
size_t countOf(const ShardRecord& record, graph::Ending ending);

/// plan_hash  SHA-256 of the plan's text
/// The key under which the record lies: whoever runs the same shard of the same plan writes the same place.
std::string recordKey(const std::string& plan_hash, size_t shard);

cache::Fields recordFields(const ShardRecord& record);
/// nullopt where the fields are not those of a record
std::optional<ShardRecord> recordOf(const cache::Fields& fields);

/// Schema "hearth.shard/1", for people and programs that watch.
std::string recordJson(const ShardRecord& record, const Plan& plan, size_t shard);

/// What is known of a shard without believing anybody.
struct ShardState
{
    enum class Kind
    {
        no_record, ///< it has not ended, or nobody has started it
        failed,    ///< its record says so
        lost, ///< its record names results that are not in the cache, or not whole, or not all that it should
        whole, ///< all its results are in the cache, byte for byte
    };
    Kind kind = Kind::no_record;
    ShardRecord record; ///< empty where there is none
};

/// Every result that the record names is read and hashed.
/// scratch  folder for what is read; nothing stays in it
ShardState stateOf(const Plan& plan, const std::string& plan_hash, size_t shard, cache::Cache& cache,
                   const std::string& scratch);

/// Actions of sources whose results cannot be had from the cache, by index, ascending: looked up by what is to be cooked, not by
/// what shards say, read and hashed. What is made of what is missing counts as missing.
std::vector<size_t> missingResults(const graph::Graph& graph, cache::Cache& cache,
                                   graph::ActionCache& actions, const std::string& scratch);

} // namespace hearth::farm
