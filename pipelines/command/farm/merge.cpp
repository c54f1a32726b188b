// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/atomic_file.h"
#include "formats/base/temp_directory.h"
#include "pipelines/command/cook/cook.h"
#include "pipelines/command/cook/cook_state.h"
#include "pipelines/command/cook/cook_tools.h"
#include "pipelines/command/farm/farm_run.h"
#include "pipelines/farm/run_shard.h"
#include "pipelines/farm/shard_record.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace hearth::command
{

namespace
{

/// Shards whose results are missing for the same reason.
struct MissingGroup
{
    std::string reason;
    std::vector<size_t> shards; ///< ascending
    size_t results = 0;         ///< number of missing results
};

/// Return the missing actions of a shard.
std::vector<size_t> missingInShard(const farm::Plan& plan, size_t shard, const std::vector<size_t>& missing)
{
    std::vector<size_t> of_shard;
    for (const size_t action : missing)
        if (std::binary_search(plan.shards[shard].begin(), plan.shards[shard].end(),
                               plan.graph.actions[action].source))
            of_shard.push_back(action);
    return of_shard;
}

std::string missingReason(const OpenedPlan& opened, size_t shard, cache::Cache& cache)
{
    auto record = farm::readRecord(opened.hash, shard, farm::Step::complete, cache);
    if (!record && farm::hasTwoSteps(opened.plan.graph))
    {
        record = farm::readRecord(opened.hash, shard, farm::Step::prepare, cache);
        if (record && record->exit_code == 0)
            return "it was prepared, but not completed";
    }
    if (!record)
        return "no record was left";
    const std::string where = record->machine.empty() ? "" : " on " + record->machine;
    if (record->exit_code == 0)
        return "ended well" + where +
               ", but what was made is not in the cache, not whole, or of files that have changed since";
    return fmt::format("failed{} with code {}{}", where, record->exit_code,
                       record->errors.empty() ? "" : ": " + record->errors.front());
}

std::vector<MissingGroup> groupMissingResults(const OpenedPlan& opened, const std::vector<size_t>& missing,
                                              cache::Cache& cache)
{
    std::vector<MissingGroup> groups;
    for (size_t shard = 0; shard < opened.plan.shards.size(); ++shard)
    {
        const size_t results = missingInShard(opened.plan, shard, missing).size();
        if (results == 0)
            continue;
        const std::string reason = missingReason(opened, shard, cache);
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const MissingGroup& known) { return known.reason == reason; });
        if (group == groups.end())
            group = groups.insert(groups.end(), {reason, {}, 0});
        group->shards.push_back(shard);
        group->results += results;
    }
    return groups;
}

/// Name shards: "shard 3/16" for one, "shards 0, 3-5 of 16" for several.
std::string shardNames(const std::vector<size_t>& shards, size_t count)
{
    if (shards.size() == 1)
        return fmt::format("shard {}/{}", shards.front(), count);
    std::string text = "shards ";
    for (size_t i = 0; i < shards.size();)
    {
        size_t last = i;
        while (last + 1 < shards.size() && shards[last + 1] == shards[last] + 1)
            ++last;
        text += (i == 0 ? "" : ", ") + std::to_string(shards[i]) +
                (last == i ? "" : "-" + std::to_string(shards[last]));
        i = last + 1;
    }
    return text + fmt::format(" of {}", count);
}

/// Print which shards have left results out, a line for each reason.
void printMissing(const OpenedPlan& opened, const std::vector<size_t>& missing, const MergeOptions& options,
                  cache::Cache& cache)
{
    for (const MissingGroup& group : groupMissingResults(opened, missing, cache))
        printError({Issue::shard_incomplete, options.plan_file,
                    shardNames(group.shards, opened.plan.shards.size()),
                    fmt::format("{} results are missing{}: {}", group.results,
                                options.lists_missing ? "" : ", and cooked here", group.reason)});
}

/// Print a line after the cook's: the sources that shards should have cooked, and this machine has.
void printCookedHere(const farm::Plan& plan, const std::vector<size_t>& missing)
{
    std::set<size_t> sources;
    for (const size_t action : missing)
        sources.insert(plan.graph.actions[action].source);
    std::vector<size_t> shards;
    for (size_t shard = 0; shard < plan.shards.size(); ++shard)
        if (!missingInShard(plan, shard, missing).empty())
            shards.push_back(shard);
    printMessage(fmt::format("{:<10}{} of {} sources were cooked here: those of {} were missing", "merged",
                             sources.size(), plan.graph.source_count,
                             shardNames(shards, plan.shards.size())));
}

std::string missingList(const farm::Plan& plan, const std::vector<size_t>& missing)
{
    std::string text;
    for (size_t shard = 0; shard < plan.shards.size(); ++shard)
        for (const size_t action : missingInShard(plan, shard, missing))
            text += fmt::format("{:<11}{}  shard {}/{}\n", plan.graph.actions[action].cooker,
                                plan.graph.actions[action].subject, shard, plan.shards.size());
    return text;
}

/// Check the plan against the present files and programs. Return the actions whose results the cache lacks.
Result<std::vector<size_t>> findMissing(const OpenedPlan& opened, const MergeOptions& options,
                                        CookState& cook_state)
{
    std::vector<size_t> all_sources(opened.plan.graph.source_count);
    for (size_t i = 0; i < all_sources.size(); ++i)
        all_sources[i] = i;
    HEARTH_TRY(farm::checkPlan(opened.plan, all_sources, tools::programFolder(), cook_state.actions(),
                               cook_state.hashes()));
    HEARTH_ASSIGN_OR_RETURN(const TempDirectory scratch,
                            TempDirectory::create(temporaryFolderOr("/tmp"), options.output));
    std::vector<size_t> missing =
        farm::missingResults(opened.plan.graph, cook_state.cache(), cook_state.actions(), scratch.path());
    if (options.verbosity != Verbosity::quiet || options.lists_missing)
        printMissing(opened, missing, options, cook_state.cache());
    return missing;
}

/// Cook the pack like the same sources without a plan; the results come from the cache.
int cookPack(const OpenedPlan& opened, const MergeOptions& options)
{
    CookOptions cooked;
    static_cast<graph::CookSettings&>(cooked) = opened.plan.settings;
    static_cast<RunLimits&>(cooked) = options;
    cooked.output = options.output;
    cooked.caches = opened.caches;
    cooked.report_files = options.report_files;
    cooked.skips_missing = options.skips_missing;
    return cook(cooked);
}

Result<int> mergePlan(const MergeOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const OpenedPlan opened, openPlan(options));
    HEARTH_ASSIGN_OR_RETURN(const auto cook_state,
                            CookState::open(opened.caches, opened.file, opened.plan.folder, printError));
    if (cook_state->cache().isEmpty())
        return Error{Issue::usage, "--cache", "", "results of shards are in a cache: say which"};
    HEARTH_TRY(enterSourceFolder(opened));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<size_t> missing, findMissing(opened, options, *cook_state));
    if (!missing.empty() && options.lists_missing)
    {
        HEARTH_TRY(writeText("-", missingList(opened.plan, missing)));
        return farm::kExitRetry;
    }
    const int exit_code = cookPack(opened, options);
    if (exit_code == 0 && !missing.empty() && options.verbosity != Verbosity::quiet)
        printCookedHere(opened.plan, missing);
    return exit_code;
}

} // namespace

int merge(const MergeOptions& chosen)
{
    MergeOptions options = chosen;
    options.output = graph::absolutePath(options.output);
    for (std::string& file : options.report_files)
        if (file != "-")
            file = graph::absolutePath(file);
    const Result<int> merged = mergePlan(options);
    return merged.ok() ? *merged : printError(merged.error());
}

} // namespace hearth::command
