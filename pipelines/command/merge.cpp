// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/private_folder.h"
#include "cook/tools/whole_file.h"
#include "pipelines/command/cook.h"
#include "pipelines/command/cook_memory.h"
#include "pipelines/command/cook_tools.h"
#include "pipelines/command/farm_run.h"
#include "pipelines/farm/shard_record.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

constexpr int kSomeMissing = 1;

/// Actions of a shard that are missing.
std::vector<size_t> missingOf(const farm::Plan& plan, size_t shard, const std::vector<size_t>& missing)
{
    std::vector<size_t> of_shard;
    for (const size_t action : missing)
        if (std::binary_search(plan.shards[shard].begin(), plan.shards[shard].end(),
                               plan.graph.actions[action].source))
            of_shard.push_back(action);
    return of_shard;
}

std::string reasonOf(const OpenedPlan& opened, size_t shard, cache::Cache& cache)
{
    const auto fields = cache.entry(farm::recordKey(opened.hash, shard));
    const auto record = fields ? farm::recordOf(*fields) : std::nullopt;
    if (!record)
        return "it has left no record";
    const std::string where = record->machine.empty() ? "" : " on " + record->machine;
    if (record->exit_code == 0)
        return "it ended well" + where +
               ", but what it made is not in the cache, not whole, or of files that have changed since";
    return fmt::format("it failed{} with code {}{}", where, record->exit_code,
                       record->errors.empty() ? "" : ": " + record->errors.front());
}

/// Tell of shards that have left results out.
void printMissing(const OpenedPlan& opened, const std::vector<size_t>& missing, const MergeOptions& options,
                  cache::Cache& cache)
{
    const farm::Plan& plan = opened.plan;
    for (size_t shard = 0; shard < plan.shards.size(); ++shard)
        if (const std::vector<size_t> of_shard = missingOf(plan, shard, missing); !of_shard.empty())
            tell({Issue::shard_incomplete, options.plan_file,
                  fmt::format("shard {}/{}", shard, plan.shards.size()),
                  fmt::format("{} results are missing{}: {}", of_shard.size(),
                              options.cooks_missing ? ", and cooked here" : "",
                              reasonOf(opened, shard, cache))});
}

std::string listOf(const farm::Plan& plan, const std::vector<size_t>& missing)
{
    std::string text;
    for (size_t shard = 0; shard < plan.shards.size(); ++shard)
        for (const size_t action : missingOf(plan, shard, missing))
            text += fmt::format("{:<11}{}  shard {}/{}\n", plan.graph.actions[action].cooker,
                                plan.graph.actions[action].subject, shard, plan.shards.size());
    return text;
}

/// What cannot be had from the cache, by what was planned and is there.
Result<std::vector<size_t>> findMissing(const OpenedPlan& opened, const MergeOptions& options,
                                        CookMemory& memory)
{
    std::vector<size_t> all_sources(opened.plan.graph.source_count);
    for (size_t i = 0; i < all_sources.size(); ++i)
        all_sources[i] = i;
    HEARTH_TRY(
        farm::checkPlan(opened.plan, all_sources, tools::programFolder(), memory.actions(), memory.hashes()));
    HEARTH_ASSIGN_OR_RETURN(const tools::PrivateFolder scratch,
                            tools::PrivateFolder::create(tools::temporaryOr("/tmp"), options.output));
    std::vector<size_t> missing =
        farm::missingResults(opened.plan.graph, memory.cache(), memory.actions(), scratch.path());
    if (options.verbosity != Verbosity::quiet || !options.cooks_missing)
        printMissing(opened, missing, options, memory.cache());
    return missing;
}

/// The pack, as a cook of the same sources makes it; it finds the results in the cache.
int cookPack(const OpenedPlan& opened, const MergeOptions& options)
{
    CookOptions cooked;
    static_cast<graph::CookSettings&>(cooked) = opened.plan.settings;
    static_cast<Effort&>(cooked) = options;
    cooked.output = options.output;
    cooked.caches = opened.caches;
    cooked.report_files = options.report_files;
    return cook(cooked);
}

Result<int> mergePlan(const MergeOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const OpenedPlan opened, openPlan(options));
    HEARTH_ASSIGN_OR_RETURN(const auto memory,
                            CookMemory::open(opened.caches, opened.file, opened.plan.folder, tell));
    if (memory->cache().isEmpty())
        return Error{Issue::usage, "--cache", "", "results of shards are in a cache: say which"};
    HEARTH_TRY(enterFolder(opened));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<size_t> missing, findMissing(opened, options, *memory));
    if (missing.empty() || options.cooks_missing)
        return cookPack(opened, options);
    HEARTH_TRY(tools::writeText("-", listOf(opened.plan, missing)));
    return kSomeMissing;
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
    return merged.ok() ? *merged : tell(merged.error());
}

} // namespace hearth::command
