// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/farm/farm_run.h"

#include "formats/base/atomic_file.h"
#include "formats/base/regular_file.h"
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
graph::ExecutorEvents makeShardEvents(const RunLimits& limits, ProgressLines* lines)
{
    graph::ExecutorEvents events;
    events.ended = [verbosity = limits.verbosity, lines](const graph::Action& action,
                                                         const graph::ActionOutcome& outcome,
                                                         const std::vector<std::string>& messages)
    {
        printMessages(messages, verbosity);
        if (outcome.ending == graph::Outcome::cooked && verbosity == Verbosity::all)
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
        if (!failure.is_reported)
            printMessage(failure.error);
    };
    return events;
}

/// Open the caches and the cook state of a shard; each shard has its own state.
Result<std::unique_ptr<CookState>> openShardState(const OpenedPlan& opened, size_t shard)
{
    return CookState::open(opened.caches, fmt::format("{}.{}", opened.file, shard), opened.plan.folder,
                           printError);
}

void printShardEnd(const farm::ShardRecord& record, const std::string& place)
{
    printMessage(fmt::format("{:<10}{:>8.2f} s {:>12}  {} cooked, {} kept",
                             record.exit_code == 0 ? "done" : "failed", record.seconds, place,
                             farm::countActions(record, graph::Outcome::cooked),
                             farm::countActions(record, graph::Outcome::cached)));
}

int writeRecord(const RunOptions& options, const farm::ShardRecord& record, const farm::Plan& plan,
                size_t shard)
{
    if (options.record_file.empty())
        return 0;
    const Status written = writeText(options.record_file, farm::recordJson(record, plan, shard));
    return written.ok() ? 0 : printError(written.error());
}

int runLocally(const RunOptions& options, const OpenedPlan& opened, size_t shard)
{
    const auto cook_state = openShardState(opened, shard);
    if (!cook_state.ok())
        return printError(cook_state.error());
    if (!(*cook_state)->cache().isWritable())
        return printError(
            {Issue::usage, "--cache", "", "a shard keeps its results in a cache that it may write to"});
    if (const Status entered = enterSourceFolder(opened); !entered.ok())
        return printError(entered.error());
    std::optional<ProgressLines> lines;
    if (options.verbosity != Verbosity::quiet && options.progress != "none")
        lines.emplace(opened.plan.graph,
                      farm::listActions(opened.plan.graph, opened.plan.shards[shard], options.step),
                      printFaint);
    const auto record =
        farm::runShard(opened.plan, opened.hash, shard,
                       {(*cook_state)->cache(), (*cook_state)->actions(), (*cook_state)->hashes()},
                       {makePoolLimits(options.jobs, options.memory_bytes), tools::programFolder(),
                        options.plan_file, options.step},
                       makeShardEvents(options, lines ? &*lines : nullptr));
    (*cook_state)->finish();
    if (!record)
        return kInterrupted;
    if (options.verbosity != Verbosity::quiet)
        printShardEnd(*record, fmt::format("{}/{}", shard, opened.plan.shards.size()));
    if (record->exit_code != 0)
        return record->exit_code;
    return writeRecord(options, *record, opened.plan, shard);
}

/// Return the command line of a launcher with the shard that it starts.
std::vector<std::string> launcherCommand(const RunOptions& options, const OpenedPlan& opened, size_t shard)
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
    if (options.step == farm::Step::prepare)
        command.emplace_back("--prepare");
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

int runThroughLauncher(const RunOptions& options, const OpenedPlan& opened, size_t shard)
{
    std::string how = "ended well";
    {
        tools::ChildProcesses children;
        const Result<size_t> started = children.start(launcherCommand(options, opened, shard));
        if (!started.ok())
            return printError(started.error());
        const std::optional<tools::ChildOutcome> end = children.wait();
        if (!end)
            return kInterrupted;
        std::fputs(end->messages.c_str(), stderr);
        if (end->signal != 0)
            how = fmt::format("was ended by signal {}", end->signal);
        else if (end->exit_code != 0)
            how = fmt::format("ended with code {}", end->exit_code);
    }
    const auto cook_state = openShardState(opened, shard);
    if (!cook_state.ok())
        return printError(cook_state.error());
    const auto scratch = TempDirectory::create(temporaryFolderOr("/tmp"), options.plan_file);
    if (!scratch.ok())
        return printError(scratch.error());
    const farm::ShardState state = farm::verifyShard(opened.plan, opened.hash, shard, options.step,
                                                     (*cook_state)->cache(), scratch->path());
    if (state.kind == farm::ShardState::Kind::intact)
        return writeRecord(options, state.record, opened.plan, shard);
    if (state.kind == farm::ShardState::Kind::failed)
    {
        for (const std::string& error : state.record.errors)
            printMessage(error);
        return state.record.exit_code;
    }
    return printError({Issue::shard_unverified, options.plan_file,
                       fmt::format("shard {}/{}", shard, opened.plan.shards.size()),
                       fmt::format("the launcher {}, but {}", how,
                                   state.kind == farm::ShardState::Kind::no_record
                                       ? "the shard has left no record in the cache"
                                       : "results of the shard are not in the cache, or not whole")});
}

Result<farm::Measurements> readEstimates(const std::string& estimates_file)
{
    if (estimates_file.empty())
        return farm::Measurements();
    HEARTH_ASSIGN_OR_RETURN(const std::string report, readFile(estimates_file));
    return farm::readMeasurements(report, estimates_file);
}

Result<std::string> makePlanText(const MakePlanOptions& options, const farm::Measurements& measured,
                                 CookState& cook_state, farm::Plan& plan)
{
    HEARTH_ASSIGN_OR_RETURN(plan, farm::makePlan(options.request, graph::workingFolder(),
                                                 {options.shard_count, measured}, tools::programFolder(),
                                                 cook_state.actions(), cook_state.hashes()));
    const std::string text = farm::planText(plan);
    // parse it again: every machine would refuse a plan whose names are not UTF-8, or look like options
    HEARTH_TRY(farm::parsePlan(text, options.output));
    return text;
}

void printPlan(const farm::Plan& plan, const std::string& output)
{
    const std::vector<double> seconds = farm::estimateSourceTimes(plan.graph);
    double longest = 0;
    for (const std::vector<size_t>& shard : plan.shards)
        longest = std::max(longest,
                           std::accumulate(shard.begin(), shard.end(), 0.0,
                                           [&](double sum, size_t source) { return sum + seconds[source]; }));
    printMessage(fmt::format("{:<10}{} sources, {} actions, {} shards of at most about {:.0f} s  {}",
                             "planned", plan.graph.source_count, plan.graph.actions.size(),
                             plan.shards.size(), std::max(1.0, longest), output));
}

} // namespace

int makePlanFile(const MakePlanOptions& options)
{
    if (options.emits_commands && options.output == "-")
        return printError({Issue::usage, "--emit", "", "needs a plan in a file, not on stdout"});
    const auto cook_state =
        CookState::open(options.caches, options.output, graph::workingFolder(), printError);
    if (!cook_state.ok())
        return printError(cook_state.error());
    const Result<farm::Measurements> measured = readEstimates(options.estimates_file);
    if (!measured.ok())
        return printError(measured.error());
    farm::Plan plan;
    const Result<std::string> text = makePlanText(options, *measured, **cook_state, plan);
    if (!text.ok())
        return printError(text.error());
    if (const Status written = writeText(options.output, *text); !written.ok())
        return printError(written.error());
    (*cook_state)->finish();
    if (!options.quiet)
        printPlan(plan, options.output);
    if (!options.quiet && !options.estimates_file.empty())
        printMessage(fmt::format("{:<10}{} of {} sources have their times from {}", "",
                                 farm::countMeasured(*measured, options.request.sources),
                                 options.request.sources.size(), options.estimates_file));
    if (!options.emits_commands)
        return 0;
    const farm::FarmJob job =
        makeFarmJob({plan, graph::absolutePath(options.output), "", "", absoluteCaches(options.caches)}, "");
    if (!options.quiet)
        printMessage("after them: " + farm::mergeCommand(job));
    const Status printed = writeText("-", farm::shardCommands(job));
    return printed.ok() ? 0 : printError(printed.error());
}

int runShard(const RunOptions& chosen)
{
    RunOptions options = chosen;
    if (!options.record_file.empty() && options.record_file != "-")
        options.record_file = graph::absolutePath(options.record_file);
    const Result<OpenedPlan> opened = openPlan(options);
    if (!opened.ok())
        return printError(opened.error());
    const Result<size_t> shard = farm::shardIndex(options.shard, opened->plan.shards.size(),
                                                  [](const char* name) { return std::getenv(name); });
    if (!shard.ok())
        return printError(shard.error());
    return options.launcher.empty() ? runLocally(options, *opened, *shard)
                                    : runThroughLauncher(options, *opened, *shard);
}

} // namespace hearth::command
