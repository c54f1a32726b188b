// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/run_shard.h"

#include "pipelines/graph/resolver.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <unistd.h>

namespace hearth::farm
{

namespace
{

constexpr int kSomeFailed = 1;

std::string machineName()
{
    char name[256] = {};
    return ::gethostname(name, sizeof(name) - 1) == 0 ? name : "";
}

/// Return the common exit code of all failures, kSomeFailed where they differ, and kTryAgain where a retry
/// may help.
int exitCodeOf(const std::vector<graph::Failure>& failures)
{
    if (failures.empty())
        return 0;
    const int first = failures.front().exit_code;
    const auto isTemporary = [](const graph::Failure& failure)
    { return failure.is_temporary || failure.exit_code == kTryAgain; };
    const auto isLikeFirst = [&](const graph::Failure& failure) { return failure.exit_code == first; };
    return std::any_of(failures.begin(), failures.end(), isTemporary)   ? kTryAgain
           : std::all_of(failures.begin(), failures.end(), isLikeFirst) ? first
                                                                        : kSomeFailed;
}

/// Run the shard's actions that the cache does not have; false where a signal ended that.
/// all_is_kept  true if the cache has every result now
bool cookActions(const Plan& plan, size_t shard, const Kitchen& kitchen, const ShardOptions& options,
                 const graph::ExecutorEvents& events, ShardRecord& record,
                 std::vector<graph::Failure>& failures, bool& all_is_kept)
{
    std::vector<size_t> action_of;
    const graph::Graph graph = actionsOf(plan.graph, plan.shards[shard], action_of);
    if (graph.actions.empty())
        return true;
    const std::optional<graph::Journal> no_journal;
    graph::Resolver resolver(
        graph, &kitchen.cache, &kitchen.actions,
        [&]() -> const std::optional<graph::Journal>& { return no_journal; }, false);
    graph::Executor executor(graph, resolver, &kitchen.cache, &kitchen.actions,
                             {options.limits, true, false, options.programs, options.plan_file, false},
                             events);
    if (!executor.run(std::nullopt))
        return false;
    failures = executor.failures();
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const graph::ActionOutcome& outcome = executor.outcomes()[i];
        const bool has_result =
            outcome.ending == graph::Ending::cooked || outcome.ending == graph::Ending::kept;
        record.actions.push_back(
            {action_of[i], outcome.ending, has_result ? outcome.result : graph::KeptResult()});
        all_is_kept = all_is_kept && outcome.is_kept;
    }
    return true;
}

} // namespace

std::optional<ShardRecord> runShard(const Plan& plan, const std::string& plan_hash, size_t shard,
                                    const Kitchen& kitchen, const ShardOptions& options,
                                    const graph::ExecutorEvents& events)
{
    const auto start = std::chrono::steady_clock::now();
    ShardRecord record;
    record.machine = machineName();
    std::vector<graph::Failure> failures;
    const auto fail = [&](const Error& error)
    {
        failures.push_back(graph::failureOf(error, plan.graph.source_count));
        if (events.failed)
            events.failed(failures.back());
    };
    bool all_is_kept = true;
    if (const Status planned =
            checkPlan(plan, plan.shards[shard], options.programs, kitchen.actions, kitchen.hashes);
        !planned.ok())
        fail(planned.error());
    else if (!cookActions(plan, shard, kitchen, options, events, record, failures, all_is_kept))
        return std::nullopt;

    const std::string place = fmt::format("shard {}/{}", shard, plan.shards.size());
    const auto isTemporary = [](const graph::Failure& failure) { return failure.is_temporary; };
    if (std::any_of(failures.begin(), failures.end(), isTemporary))
        fail({Issue::cooker_killed, options.plan_file, place, ""});
    const auto putRecord = [&]
    {
        record.exit_code = exitCodeOf(failures);
        record.errors.clear();
        for (const graph::Failure& failure : failures)
            record.errors.push_back(failure.error);
        record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        kitchen.cache.putEntry(recordKey(plan_hash, shard), recordFields(record));
    };
    putRecord();
    // also if the record itself could not be stored
    if (failures.empty() && (!all_is_kept || !kitchen.cache.isWritable()))
    {
        fail({Issue::results_lost, options.plan_file, place, ""});
        putRecord();
    }
    return record;
}

} // namespace hearth::farm
