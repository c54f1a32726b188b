// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/farm/farm_run.h"

#include "formats/base/atomic_file.h"
#include "pipelines/command/cook/cook_state.h"
#include "pipelines/command/cook/cook_tools.h"
#include "pipelines/command/shell/progress_lines.h"
#include "pipelines/farm/run_shard.h"
#include "pipelines/farm/shard_index.h"
#include "pipelines/farm/shards.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <numeric>

namespace hearth::command
{

namespace
{

/// Make executor events that write to a log, which has no bar.
/// lines  progress lines of the shard; null: none. They must outlive the events
graph::ExecutorEvents eventsFor(const Effort& effort, ProgressLines* lines)
{
    graph::ExecutorEvents events;
    events.ended = [verbosity = effort.verbosity, lines](const graph::Action& action,
                                                         const graph::ActionOutcome& outcome,
                                                         const std::vector<std::string>& messages)
    {
        passOn(messages, verbosity);
        if (outcome.ending == graph::Ending::cooked && verbosity == Verbosity::all)
            printStage(action, outcome);
        if (lines != nullptr)
            lines->ended(action, outcome);
    };
    if (lines != nullptr)
    {
        events.starting = [lines](const graph::Action& action, const graph::ActionOutcome&,
                                  const std::vector<std::string>&) { lines->starting(action); };
        events.waiting = [lines] { lines->waiting(); };
    }
    events.failed = [](const graph::Failure& failure)
    {
        if (!failure.is_told)
            print(failure.error);
    };
    return events;
}

/// Open the caches and the cook state of a shard; each shard has its own state.
Result<std::unique_ptr<CookMemory>> memoryOf(const OpenedPlan& opened, size_t shard)
{
    return CookMemory::open(opened.caches, fmt::format("{}.{}", opened.file, shard), opened.plan.folder,
                            tell);
}

void printEnd(const farm::ShardRecord& record, const std::string& place)
{
    print(fmt::format("{:<10}{:>8.2f} s {:>12}  {} cooked, {} kept",
                      record.exit_code == 0 ? "done" : "failed", record.seconds, place,
                      farm::countOf(record, graph::Ending::cooked),
                      farm::countOf(record, graph::Ending::kept)));
}

int writeRecord(const RunOptions& options, const farm::ShardRecord& record, const farm::Plan& plan,
                size_t shard)
{
    if (options.record_file.empty())
        return 0;
    const Status written = writeText(options.record_file, farm::recordJson(record, plan, shard));
    return written.ok() ? 0 : tell(written.error());
}

int runHere(const RunOptions& options, const OpenedPlan& opened, size_t shard)
{
    const auto memory = memoryOf(opened, shard);
    if (!memory.ok())
        return tell(memory.error());
    if (!(*memory)->cache().isWritable())
        return tell(
            {Issue::usage, "--cache", "", "a shard keeps its results in a cache that it may write to"});
    if (const Status entered = enterFolder(opened); !entered.ok())
        return tell(entered.error());
    std::vector<size_t> action_of;
    std::optional<ProgressLines> lines;
    if (options.verbosity != Verbosity::quiet && options.progress != "none")
        lines.emplace(farm::actionsOf(opened.plan.graph, opened.plan.shards[shard], action_of), printFaint);
    const auto record = farm::runShard(
        opened.plan, opened.hash, shard, {(*memory)->cache(), (*memory)->actions(), (*memory)->hashes()},
        {limitsOf(options.jobs, options.memory_bytes), tools::programFolder(), options.plan_file},
        eventsFor(options, lines ? &*lines : nullptr));
    (*memory)->finish();
    if (!record)
        return kInterrupted;
    if (options.verbosity != Verbosity::quiet)
        printEnd(*record, fmt::format("{}/{}", shard, opened.plan.shards.size()));
    if (record->exit_code != 0)
        return record->exit_code;
    return writeRecord(options, *record, opened.plan, shard);
}

/// Return the command line of a launcher with the shard that it starts.
std::vector<std::string> launchedCommand(const RunOptions& options, const OpenedPlan& opened, size_t shard)
{
    // env searches PATH for the launcher, as a shell would
    std::vector<std::string> command{"/usr/bin/env"};
    for (size_t at = 0; at < options.launcher.size();)
    {
        const size_t end = std::min(options.launcher.find(' ', at), options.launcher.size());
        if (end > at)
            command.push_back(options.launcher.substr(at, end - at));
        at = end + 1;
    }
    const std::vector<std::string> run{tools::programFolder() + "/hearth", "run", opened.file, "--shard",
                                       fmt::format("{}/{}", shard, opened.plan.shards.size())};
    command.insert(command.end(), run.begin(), run.end());
    // nothing from inside the plan: launchers such as ssh hand their words to a shell
    if (!opened.directory.empty())
        command.insert(command.end(), {"-C", opened.directory});
    if (options.jobs > 0)
        command.insert(command.end(), {"-j", std::to_string(options.jobs)});
    if (options.memory_bytes > 0)
        command.insert(command.end(), {"--memory", std::to_string(options.memory_bytes)});
    for (const std::string& cache : opened.caches)
        command.insert(command.end(), {"--cache", cache});
    return command;
}

int runThere(const RunOptions& options, const OpenedPlan& opened, size_t shard)
{
    std::string how = "ended well";
    {
        tools::ChildProcesses children;
        const Result<size_t> started = children.start(launchedCommand(options, opened, shard));
        if (!started.ok())
            return tell(started.error());
        const std::optional<tools::ChildEnd> end = children.wait();
        if (!end)
            return kInterrupted;
        std::fputs(end->messages.c_str(), stderr);
        if (end->signal != 0)
            how = fmt::format("was ended by signal {}", end->signal);
        else if (end->exit_code != 0)
            how = fmt::format("ended with code {}", end->exit_code);
    }
    const auto memory = memoryOf(opened, shard);
    if (!memory.ok())
        return tell(memory.error());
    const auto scratch = TempDirectory::create(temporaryOr("/tmp"), options.plan_file);
    if (!scratch.ok())
        return tell(scratch.error());
    const farm::ShardState state =
        farm::stateOf(opened.plan, opened.hash, shard, (*memory)->cache(), scratch->path());
    if (state.kind == farm::ShardState::Kind::whole)
        return writeRecord(options, state.record, opened.plan, shard);
    if (state.kind == farm::ShardState::Kind::failed)
    {
        for (const std::string& error : state.record.errors)
            print(error);
        return state.record.exit_code;
    }
    return tell({Issue::shard_unverified, options.plan_file,
                 fmt::format("shard {}/{}", shard, opened.plan.shards.size()),
                 fmt::format("the launcher {}, but {}", how,
                             state.kind == farm::ShardState::Kind::no_record
                                 ? "the shard has left no record in the cache"
                                 : "results of the shard are not in the cache, or not whole")});
}

Result<farm::Measured> measuredBefore(const std::string& estimates_file)
{
    if (estimates_file.empty())
        return farm::Measured();
    const std::optional<std::string> report = cache::readText(estimates_file);
    if (!report)
        return Error{Issue::input_missing, estimates_file, "", "cannot be read"};
    return farm::measuredOf(*report, estimates_file);
}

Result<std::string> planOf(const MakePlanOptions& options, const farm::Measured& measured, CookMemory& memory,
                           farm::Plan& plan)
{
    HEARTH_ASSIGN_OR_RETURN(plan, farm::makePlan(options.request, graph::workingFolder(),
                                                 {options.shard_count, measured}, tools::programFolder(),
                                                 memory.actions(), memory.hashes()));
    const std::string text = farm::planText(plan);
    // parse it again: every machine would refuse a plan whose names are not UTF-8, or look like options
    HEARTH_TRY(farm::parsePlan(text, options.output));
    return text;
}

void printPlan(const farm::Plan& plan, const std::string& output)
{
    const std::vector<double> seconds = farm::secondsOfSources(plan.graph);
    double longest = 0;
    for (const std::vector<size_t>& shard : plan.shards)
        longest = std::max(longest,
                           std::accumulate(shard.begin(), shard.end(), 0.0,
                                           [&](double sum, size_t source) { return sum + seconds[source]; }));
    print(fmt::format("{:<10}{} sources, {} actions, {} shards of at most about {:.0f} s  {}", "planned",
                      plan.graph.source_count, plan.graph.actions.size(), plan.shards.size(),
                      std::max(1.0, longest), output));
}

} // namespace

int makePlanFile(const MakePlanOptions& options)
{
    if (options.emits_commands && options.output == "-")
        return tell({Issue::usage, "--emit", "", "needs a plan in a file, not on stdout"});
    const auto memory = CookMemory::open(options.caches, options.output, graph::workingFolder(), tell);
    if (!memory.ok())
        return tell(memory.error());
    const Result<farm::Measured> measured = measuredBefore(options.estimates_file);
    if (!measured.ok())
        return tell(measured.error());
    farm::Plan plan;
    const Result<std::string> text = planOf(options, *measured, **memory, plan);
    if (!text.ok())
        return tell(text.error());
    if (const Status written = writeText(options.output, *text); !written.ok())
        return tell(written.error());
    (*memory)->finish();
    if (!options.quiet)
        printPlan(plan, options.output);
    if (!options.quiet && !options.estimates_file.empty())
        print(fmt::format("{:<10}{} of {} sources have their times from {}", "",
                          farm::countMeasured(*measured, options.request.sources),
                          options.request.sources.size(), options.estimates_file));
    if (!options.emits_commands)
        return 0;
    const farm::FarmJob job =
        jobOf({plan, graph::absolutePath(options.output), "", "", absoluteCaches(options.caches)}, "");
    if (!options.quiet)
        print("after them: " + farm::mergeCommand(job));
    const Status printed = writeText("-", farm::shardCommands(job));
    return printed.ok() ? 0 : tell(printed.error());
}

int runShard(const RunOptions& chosen)
{
    RunOptions options = chosen;
    if (!options.record_file.empty() && options.record_file != "-")
        options.record_file = graph::absolutePath(options.record_file);
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return tell(opened.error());
    const Result<size_t> shard = farm::shardIndex(options.shard, opened->plan.shards.size(),
                                                  [](const char* name) { return std::getenv(name); });
    if (!shard.ok())
        return tell(shard.error());
    return options.launcher.empty() ? runHere(options, *opened, *shard) : runThere(options, *opened, *shard);
}

} // namespace hearth::command
