// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/farm/farm_jobs.h"

#include "cook/json/json.h"
#include "formats/base/atomic_file.h"
#include "formats/base/temp_directory.h"
#include "pipelines/command/cook/cook_state.h"
#include "pipelines/command/cook/cook_tools.h"
#include "pipelines/command/cook/missing_option.h"
#include "pipelines/farm/shard_record.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::command
{

namespace
{

using Kind = farm::ShardState::Kind;

constexpr int kIncomplete = 1;

int printStatus(const Status& status)
{
    return status.ok() ? 0 : printError(status.error());
}

/// Run the script in a shell, with this process's input and output.
Status runScript(const std::string& script)
{
    std::array<std::string, 3> words{"sh", "-c", script};
    std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t process = 0;
    int status = 0;
    if (::posix_spawn(&process, "/bin/sh", nullptr, nullptr, arguments.data(), environ) == 0 &&
        ::waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return success();
    return Error{Issue::submit_failed, "sbatch", "", ""};
}

farm::FarmJob makeMergingJob(const OpenedPlan& opened, const FarmVerbOptions& options)
{
    farm::FarmJob job = makeFarmJob(opened, options.pack);
    job.skips_missing = options.missing == kMissingSkip;
    return job;
}

/// State of a shard in a list.
struct ListedState : farm::ShardState
{
    bool is_prepared = false; ///< only its first step has ended
};

/// Return the state of a shard: of its last step that has left a record.
ListedState getShardState(const OpenedPlan& opened, size_t shard, cache::Cache& cache,
                          const std::string& scratch)
{
    ListedState state{
        farm::verifyShard(opened.plan, opened.hash, shard, farm::Step::complete, cache, scratch)};
    if (state.kind != Kind::no_record || !farm::hasTwoSteps(opened.plan.graph))
        return state;
    return {farm::verifyShard(opened.plan, opened.hash, shard, farm::Step::prepare, cache, scratch), true};
}

const char* shardStateName(const ListedState& state)
{
    switch (state.kind)
    {
    case Kind::no_record:
        return "no record";
    case Kind::failed:
        return "failed";
    case Kind::lost:
        return "lost";
    case Kind::intact:
        break;
    }
    return state.is_prepared ? "prepared" : "done";
}

bool isDone(const ListedState& state)
{
    return state.kind == Kind::intact && !state.is_prepared;
}

std::string statusText(const farm::Plan& plan, const std::vector<ListedState>& states)
{
    std::string text = fmt::format("{:>5}  {:<9} {:>7} {:>7} {:>7} {:>9}  {}\n", "shard", "state", "sources",
                                   "cooked", "kept", "seconds", "machine");
    for (size_t shard = 0; shard < states.size(); ++shard)
    {
        const farm::ShardRecord& record = states[shard].record;
        const std::string error = record.errors.empty() ? "" : ": " + record.errors.front();
        text += fmt::format("{:>5}  {:<9} {:>7} ", shard, shardStateName(states[shard]),
                            plan.shards[shard].size());
        text += states[shard].kind == Kind::no_record
                    ? "\n"
                    : fmt::format("{:>7} {:>7} {:>9.2f}  {}{}\n",
                                  farm::countActions(record, graph::Outcome::cooked),
                                  farm::countActions(record, graph::Outcome::cached), record.seconds,
                                  record.machine, error);
    }
    return text + fmt::format("{} of {} shards are done\n",
                              std::count_if(states.begin(), states.end(), isDone), states.size());
}

std::string statusJson(const farm::Plan& plan, const std::vector<ListedState>& states)
{
    Json json{{"schema", "hearth.farm/1"}, {"shards", Json::array()}};
    for (size_t shard = 0; shard < states.size(); ++shard)
    {
        Json sources = Json::array();
        for (const size_t source : plan.shards[shard])
            sources.push_back(plan.request.sources[source]);
        Json entry{{"shard", shard}, {"state", shardStateName(states[shard])}, {"sources", sources}};
        const farm::ShardRecord& record = states[shard].record;
        if (states[shard].kind != Kind::no_record)
            entry.update({{"exit", record.exit_code},
                          {"cooked", farm::countActions(record, graph::Outcome::cooked)},
                          {"kept", farm::countActions(record, graph::Outcome::cached)},
                          {"seconds", record.seconds},
                          {"machine", record.machine},
                          {"errors", record.errors}});
        json["shards"].push_back(entry);
    }
    return json.dump(1) + "\n";
}

} // namespace

int submitToSlurm(const SlurmVerbOptions& options)
{
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return printError(opened.error());
    const graph::Graph& graph = opened->plan.graph;
    const std::string script = farm::slurmScript(
        makeMergingJob(*opened, options),
        {options.partition, options.memory_bytes.value_or(farm::shardMemory(graph)),
         std::max(farm::mergeMemory(graph), options.memory_bytes.value_or(0)), options.retries});
    return printStatus(options.prints ? writeText("-", script) : runScript(script));
}

int writeNinjaFile(const NinjaVerbOptions& options)
{
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return printError(opened.error());
    return printStatus(
        writeText(options.output, farm::ninjaFile(makeMergingJob(*opened, options), options.launcher)));
}

int printFarmStatus(const PlanOptions& options, const std::string& format)
{
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return printError(opened.error());
    const auto cook_state = CookState::open(opened->caches, opened->file, opened->plan.folder, printError);
    if (!cook_state.ok())
        return printError(cook_state.error());
    const auto scratch = TempDirectory::create(temporaryFolderOr("/tmp"), options.plan_file);
    if (!scratch.ok())
        return printError(scratch.error());
    std::vector<ListedState> states;
    for (size_t shard = 0; shard < opened->plan.shards.size(); ++shard)
        states.push_back(getShardState(*opened, shard, (*cook_state)->cache(), scratch->path()));
    const int printed = printStatus(writeText("-", format == "json" ? statusJson(opened->plan, states)
                                                                    : statusText(opened->plan, states)));
    const bool are_done = std::all_of(states.begin(), states.end(), isDone);
    return printed != 0 ? printed : are_done ? 0 : kIncomplete;
}

} // namespace hearth::command
