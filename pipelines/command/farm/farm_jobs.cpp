// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/farm/farm_jobs.h"

#include "cook/json/json.h"
#include "formats/base/atomic_file.h"
#include "formats/base/temp_directory.h"
#include "pipelines/command/cook/cook_state.h"
#include "pipelines/command/cook/cook_tools.h"
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

constexpr int kNotAll = 1;

int tellEnd(const Status& status)
{
    return status.ok() ? 0 : tell(status.error());
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

const char* wordOf(Kind kind)
{
    switch (kind)
    {
    case Kind::no_record:
        return "no record";
    case Kind::failed:
        return "failed";
    case Kind::lost:
        return "lost";
    case Kind::whole:
        break;
    }
    return "done";
}

std::string statusText(const farm::Plan& plan, const std::vector<farm::ShardState>& states)
{
    std::string text = fmt::format("{:>5}  {:<9} {:>7} {:>7} {:>7} {:>9}  {}\n", "shard", "state", "sources",
                                   "cooked", "kept", "seconds", "machine");
    for (size_t shard = 0; shard < states.size(); ++shard)
    {
        const farm::ShardRecord& record = states[shard].record;
        const std::string error = record.errors.empty() ? "" : ": " + record.errors.front();
        text +=
            fmt::format("{:>5}  {:<9} {:>7} ", shard, wordOf(states[shard].kind), plan.shards[shard].size());
        text += states[shard].kind == Kind::no_record
                    ? "\n"
                    : fmt::format(
                          "{:>7} {:>7} {:>9.2f}  {}{}\n", farm::countOf(record, graph::Ending::cooked),
                          farm::countOf(record, graph::Ending::kept), record.seconds, record.machine, error);
    }
    const auto whole = std::count_if(states.begin(), states.end(),
                                     [](const farm::ShardState& state) { return state.kind == Kind::whole; });
    return text + fmt::format("{} of {} shards are done\n", whole, states.size());
}

std::string statusJson(const farm::Plan& plan, const std::vector<farm::ShardState>& states)
{
    Json json{{"schema", "hearth.farm/1"}, {"shards", Json::array()}};
    for (size_t shard = 0; shard < states.size(); ++shard)
    {
        Json sources = Json::array();
        for (const size_t source : plan.shards[shard])
            sources.push_back(plan.request.sources[source]);
        Json entry{{"shard", shard}, {"state", wordOf(states[shard].kind)}, {"sources", sources}};
        const farm::ShardRecord& record = states[shard].record;
        if (states[shard].kind != Kind::no_record)
            entry.update({{"exit", record.exit_code},
                          {"cooked", farm::countOf(record, graph::Ending::cooked)},
                          {"kept", farm::countOf(record, graph::Ending::kept)},
                          {"seconds", record.seconds},
                          {"machine", record.machine},
                          {"errors", record.errors}});
        json["shards"].push_back(entry);
    }
    return json.dump(1) + "\n";
}

} // namespace

int farmSlurm(const SlurmVerbOptions& options)
{
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return tell(opened.error());
    const graph::Graph& graph = opened->plan.graph;
    const std::string script = farm::slurmScript(
        jobOf(*opened, options.pack),
        {options.partition, options.memory_bytes.value_or(farm::shardMemory(graph)),
         std::max(farm::mergeMemory(graph), options.memory_bytes.value_or(0)), options.retries});
    return tellEnd(options.prints ? writeText("-", script) : runScript(script));
}

int farmNinja(const NinjaVerbOptions& options)
{
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return tell(opened.error());
    return tellEnd(
        writeText(options.output, farm::ninjaFile(jobOf(*opened, options.pack), options.launcher)));
}

int farmStatus(const PlanOptions& options, const std::string& format)
{
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return tell(opened.error());
    const auto memory = CookMemory::open(opened->caches, opened->file, opened->plan.folder, tell);
    if (!memory.ok())
        return tell(memory.error());
    const auto scratch = TempDirectory::create(temporaryOr("/tmp"), options.plan_file);
    if (!scratch.ok())
        return tell(scratch.error());
    std::vector<farm::ShardState> states;
    for (size_t shard = 0; shard < opened->plan.shards.size(); ++shard)
        states.push_back(
            farm::stateOf(opened->plan, opened->hash, shard, (*memory)->cache(), scratch->path()));
    const int printed = tellEnd(writeText("-", format == "json" ? statusJson(opened->plan, states)
                                                                : statusText(opened->plan, states)));
    const bool are_whole =
        std::all_of(states.begin(), states.end(),
                    [](const farm::ShardState& state) { return state.kind == Kind::whole; });
    return printed != 0 ? printed : are_whole ? 0 : kNotAll;
}

} // namespace hearth::command
