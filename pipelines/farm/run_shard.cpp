// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/run_shard.h"

#include "pipelines/graph/resolver.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <iterator>
#include <unistd.h>

namespace hearth::farm
{

namespace
{

constexpr int kExitMixedFailures = 1;

std::string machineName()
{
    char name[256] = {};
    return ::gethostname(name, sizeof(name) - 1) == 0 ? name : "";
}

/// Return the common exit code of all failures, kExitMixedFailures where they differ, and kExitRetry where a
/// retry may help.
int combinedExitCode(const std::vector<graph::Failure>& failures)
{
    if (failures.empty())
        return 0;
    const int first = failures.front().exit_code;
    const auto isTemporary = [](const graph::Failure& failure)
    { return failure.is_temporary || failure.exit_code == kExitRetry; };
    const auto isLikeFirst = [&](const graph::Failure& failure) { return failure.exit_code == first; };
    return std::any_of(failures.begin(), failures.end(), isTemporary)   ? kExitRetry
           : std::all_of(failures.begin(), failures.end(), isLikeFirst) ? first
                                                                        : kExitMixedFailures;
}

/// Selects what is a shard's to report: the actions of its sources; failures of these and of no source, and
/// all that another try may mend.
class ShardFilter
{
public:
    /// Both must outlive it.
    ShardFilter(const Plan& plan, size_t shard) : graph_(plan.graph), sources_(plan.shards[shard]) {}

    bool accepts(const graph::Action& action) const
    {
        return std::ranges::binary_search(sources_, action.source);
    }
    bool accepts(const graph::Failure& failure) const
    {
        return failure.source == graph_.source_count || failure.is_temporary ||
               std::ranges::binary_search(sources_, failure.source);
    }

    /// Return events that are called for what the filter accepts; `events` must outlive them.
    graph::ExecutorEvents select(const graph::ExecutorEvents& events) const
    {
        graph::ExecutorEvents selected;
        selected.waiting = events.waiting;
        if (events.starting)
            selected.starting = [&events, filter = *this](const auto& action, const auto&... more)
            {
                if (filter.accepts(action))
                    events.starting(action, more...);
            };
        if (events.ended)
            selected.ended = [&events, filter = *this](const auto& action, const auto&... more)
            {
                if (filter.accepts(action))
                    events.ended(action, more...);
            };
        if (events.failed)
            selected.failed = [&events, filter = *this](const graph::Failure& failure)
            {
                if (filter.accepts(failure))
                    events.failed(failure);
            };
        return selected;
    }

private:
    const graph::Graph& graph_;
    const std::vector<size_t>& sources_; ///< ascending
};

/// Run the shard's actions that the cache does not have; false where a signal ended that.
/// is_all_cached  true if the cache has every result now
bool cookActions(const Plan& plan, const std::string& plan_hash, size_t shard, const CacheHandles& caches,
                 const ShardOptions& options, const graph::ExecutorEvents& events, ShardRecord& record,
                 std::vector<graph::Failure>& failures, bool& is_all_cached)
{
    graph::ExecutorOptions executor_options{.limits = options.limits,
                                            .programs = options.programs,
                                            .output = options.plan_file,
                                            .makes_pack = false,
                                            .skips_failed_sources = true};
    executor_options.wanted = listActions(plan.graph, plan.shards[shard], options.step);
    if (executor_options.wanted.empty())
        return true;
    if (options.step == Step::complete && hasTwoSteps(plan.graph))
        executor_options.known = readOtherResults(plan, plan_hash, shard, caches.cache);
    const std::vector<size_t> wanted = executor_options.wanted;
    graph::Graph graph = plan.graph;
    const std::optional<graph::Journal> no_journal;
    graph::Resolver resolver(
        graph, &caches.cache, &caches.actions,
        [&]() -> const std::optional<graph::Journal>& { return no_journal; }, false);
    const ShardFilter filter(plan, shard);
    graph::Executor executor(graph, resolver, &caches.cache, &caches.actions, std::move(executor_options),
                             filter.select(events));
    if (!executor.run(std::nullopt))
        return false;
    std::ranges::copy_if(executor.failures(), std::back_inserter(failures),
                         [&](const graph::Failure& failure) { return filter.accepts(failure); });
    for (const size_t action : wanted)
    {
        const graph::ActionOutcome& outcome = executor.outcomes()[action];
        const bool has_result =
            outcome.ending == graph::Outcome::cooked || outcome.ending == graph::Outcome::cached;
        record.actions.push_back(
            {action, outcome.ending, has_result ? outcome.result : graph::CachedResult()});
        is_all_cached = is_all_cached && outcome.is_cached;
    }
    return true;
}

} // namespace

std::optional<ShardRecord> runShard(const Plan& plan, const std::string& plan_hash, size_t shard,
                                    const CacheHandles& caches, const ShardOptions& options,
                                    const graph::ExecutorEvents& events)
{
    const auto start = std::chrono::steady_clock::now();
    ShardRecord record;
    record.machine = machineName();
    std::vector<graph::Failure> failures;
    const auto fail = [&](const Error& error)
    {
        failures.push_back(graph::makeFailure(error, plan.graph.source_count));
        if (events.failed)
            events.failed(failures.back());
    };
    bool is_all_cached = true;
    if (const Status planned =
            checkPlan(plan, plan.shards[shard], options.programs, caches.actions, caches.hashes);
        !planned.ok())
        fail(planned.error());
    else if (!cookActions(plan, plan_hash, shard, caches, options, events, record, failures, is_all_cached))
        return std::nullopt;

    const std::string place = fmt::format("shard {}/{}", shard, plan.shards.size());
    const auto isTemporary = [](const graph::Failure& failure) { return failure.is_temporary; };
    if (std::any_of(failures.begin(), failures.end(), isTemporary))
        fail({Issue::cooker_killed, options.plan_file, place, ""});
    const auto putRecord = [&]
    {
        record.exit_code = combinedExitCode(failures);
        record.errors.clear();
        for (const graph::Failure& failure : failures)
            record.errors.push_back(failure.error);
        record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        caches.cache.putEntry(recordKey(plan_hash, shard, options.step), recordFields(record));
    };
    putRecord();
    // also if the record itself could not be stored
    if (failures.empty() && (!is_all_cached || !caches.cache.isWritable()))
    {
        fail({Issue::results_lost, options.plan_file, place, ""});
        putRecord();
    }
    return record;
}

} // namespace hearth::farm
