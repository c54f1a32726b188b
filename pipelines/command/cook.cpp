// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook.h"

#include "cook/tools/lod_files.h"
#include "cook/tools/whole_file.h"
#include "formats/pack_view.h"
#include "pipelines/command/cook_memory.h"
#include "pipelines/command/dry_run.h"
#include "pipelines/command/event_log.h"
#include "pipelines/command/messages.h"
#include "pipelines/command/progress.h"
#include "pipelines/graph/causes.h"
#include "pipelines/graph/executor.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace hearth::command
{

using namespace tools;
using graph::Ending;
using graph::Failure;

namespace
{

constexpr int kInterrupted = 130;
constexpr int kSomeFailed = 1;

// ---- messages

void print(const std::string& line)
{
    tell(line);
}

bool isFatalWarning(const std::string& line, const CookOptions& options)
{
    if (!options.fatal_warnings || !graph::isWarning(line))
        return false;
    const std::vector<std::string>& codes = *options.fatal_warnings;
    return codes.empty() || std::find(codes.begin(), codes.end(), partsOf(line).code) != codes.end();
}

/// Pass on a child's messages: errors always, the noise of libraries only when everything is asked for.
/// returns  how many warnings among them count as errors
size_t passOn(const std::vector<std::string>& lines, const CookOptions& options)
{
    size_t fatal_count = 0;
    for (const std::string& line : lines)
    {
        const bool is_fatal = isFatalWarning(line, options);
        fatal_count += is_fatal ? 1 : 0;
        if (graph::isError(line) || is_fatal ||
            (graph::isWarning(line) && options.verbosity != Verbosity::quiet) ||
            options.verbosity == Verbosity::all)
            print(line);
    }
    return fatal_count;
}

std::string joined(const std::vector<std::string>& words, const char* between)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

void printStage(const graph::Action& action, const graph::ActionOutcome& outcome)
{
    print(faint(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", action.cooker, outcome.result.seconds,
                            readableSize(outcome.result.outputs.front().bytes), action.subject)));
}

/// What the events of a cook go to.
struct Listeners
{
    EventLog* log = nullptr; ///< null: none
    ProgressStyle style = ProgressStyle::plain;
    ProgressBar bar;
    size_t fatal_warnings = 0;
};

/// The listeners live as long as the events.
graph::ExecutorEvents eventsFor(const CookOptions& options, Listeners& listeners)
{
    EventLog* const log = listeners.log;
    graph::ExecutorEvents events;
    events.starting = [&options, &listeners, log](const graph::Action& action,
                                                  const graph::ActionOutcome& outcome,
                                                  const std::vector<std::string>& command)
    {
        if (log != nullptr)
            log->start(action, outcome);
        if (options.explain)
            print(fmt::format("{:<11}{}: {}", action.cooker, action.subject, joined(outcome.causes, "; ")));
        if (options.verbosity == Verbosity::all)
            print(faint(joined(command, " ")));
        listeners.bar.started(action.cooker + " " + action.subject);
    };
    events.ended = [&options, &listeners, log](const graph::Action& action,
                                               const graph::ActionOutcome& outcome,
                                               const std::vector<std::string>& messages)
    {
        if (log != nullptr)
            log->end(action, outcome);
        listeners.fatal_warnings += passOn(messages, options);
        if (outcome.ending == Ending::cooked && options.verbosity != Verbosity::quiet &&
            listeners.style == ProgressStyle::plain)
            printStage(action, outcome);
        listeners.bar.ended();
    };
    events.failed = [log](const Failure& failure)
    {
        if (log != nullptr)
            log->error(failure.error);
        if (!failure.is_told)
            print(failure.error);
    };
    return events;
}

/// Which sources could not be cooked, where others could: what depends on them is no failure of its own.
void printLeftOut(const graph::Graph& graph, const graph::Executor& executor, const CookOptions& options)
{
    const auto failed = static_cast<size_t>(
        std::count_if(executor.failures().begin(), executor.failures().end(),
                      [&](const Failure& failure) { return failure.source < graph.source_count; }));
    if (failed > 0 && graph.source_count > 1 && options.verbosity != Verbosity::quiet)
        print(fmt::format("{}: not linked, because a dependency failed: {} of {} sources", options.output,
                          failed, graph.source_count));
}

// ---- before and after

Status checkOutput(const CookOptions& options)
{
    std::error_code error;
    if (std::filesystem::is_directory(options.output, error))
        return Error{Issue::cannot_write, options.output, "", "is a folder"};
    for (const std::string& source : options.sources)
        if (std::filesystem::equivalent(source, options.output, error))
            return Error{Issue::usage, options.output, "", "the output would overwrite a source"};
    HEARTH_ASSIGN_OR_RETURN(const std::vector<LodFile> lods, parseLodFiles(options.lods));
    if (!lods.empty() && options.sources.size() > 1)
        return Error{Issue::usage, "--lod", "",
                     "needs a cook of one source: which of several it is for is not said"};
    for (const LodFile& lod : lods)
        if (std::filesystem::equivalent(lod.path, options.output, error))
            return Error{Issue::usage, options.output, "", "the output would overwrite a level of detail"};
    return success();
}

/// Three quarters of the machine's memory, where the user says nothing.
uint64_t memoryFor(const CookOptions& options)
{
    if (options.memory_bytes > 0)
        return options.memory_bytes;
    return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) /
           4 * 3;
}

/// META of the pack at `path`, for the report.
std::string metaOf(const std::string& path)
{
    const auto reader = formats::ContainerReader::open(path, formats::Check::structure);
    if (!reader.ok())
        return "";
    const auto meta = reader->read(formats::kChunkMeta);
    if (!meta.ok())
        return "";
    return {reinterpret_cast<const char*>(meta->bytes().data()), meta->bytes().size()};
}

Status writeReport(const CookOptions& options, const CookOutcome& outcome)
{
    const std::string meta = outcome.exit_code == 0 ? metaOf(options.output) : "";
    return writeText(options.report_file, reportJson(options, outcome, meta));
}

/// What a cooker has written beside its part; empty where it has not been asked to.
std::string textOfOutput(const graph::Graph& graph, graph::Executor& executor, size_t action,
                         const std::string& name)
{
    const std::vector<std::string>& outputs = graph.actions[action].outputs;
    const auto output = std::find(outputs.begin(), outputs.end(), name);
    if (output == outputs.end() || !executor.materialize(action))
        return "";
    const auto index = static_cast<size_t>(output - outputs.begin());
    return cache::readText(executor.outcomes()[action].paths[index]).value_or("");
}

/// What the report says of the actions that ended well.
void fillStages(const graph::Graph& graph, graph::Executor& executor, CookOutcome& outcome)
{
    outcome.cluster_statistics.resize(graph.source_count);
    outcome.visibility.resize(graph.source_count);
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const graph::Action& action = graph.actions[i];
        const graph::ActionOutcome& end = executor.outcomes()[i];
        outcome.stages.push_back({action.cooker, action.source, end.result.seconds, end.result.cpu_seconds,
                                  end.result.peak_rss_bytes, end.result.outputs.front().bytes,
                                  end.ending == Ending::kept});
        const auto textOf = [&](const char* name) { return textOfOutput(graph, executor, i, name); };
        if (action.cooker == "clusters")
            outcome.cluster_statistics[action.source] = textOf(graph::kClustersStatistics);
        if (action.cooker == "visibility")
            outcome.visibility[action.source] = {textOf(graph::kVisibilityStatistics),
                                                 textOf(graph::kVisibilityPicture)};
        if (action.cooker == "bricks")
            outcome.brick_statistics = textOf(graph::kBrickStatistics);
    }
}

/// last  of the cook before, whose records stand for those that this one did not get to
graph::Journal journalOf(const graph::Graph& graph, const graph::Executor& executor,
                         const CookOptions& options, const std::string& output_cause,
                         const std::optional<graph::Journal>& last)
{
    graph::Journal journal;
    journal.folder = graph::workingFolder();
    journal.output = graph::absolutePath(options.output);
    journal.output_cause = output_cause;
    journal.graph = graph;
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const graph::ActionOutcome& outcome = executor.outcomes()[i];
        journal.actions.push_back({outcome.ending, outcome.causes, outcome.record});
        const graph::JournalAction* before = last ? graph::lastOf(graph.actions[i], graph, *last) : nullptr;
        if (outcome.record.empty() && before != nullptr)
            journal.actions.back().record = before->record;
    }
    return journal;
}

// ---- the cook

void fail(const Error& error, size_t source, CookOutcome& outcome)
{
    print(formatMessage(error));
    outcome.exit_code = exitCode(error);
    outcome.error = formatMessage(error);
    outcome.failed_sources = {source};
}

/// The results are kept, and warn again in the next cook; the pack does not appear.
void failByWarnings(size_t count, const CookOptions& options, CookOutcome& outcome)
{
    outcome.exit_code = kSomeFailed;
    outcome.error =
        fmt::format("{}: error: not written, because warnings count as errors: {}", options.output, count);
    outcome.failed_sources = {options.sources.size()};
    print(outcome.error);
}

/// What failed, as the outcome: one exit code where all have the same.
void takeFailures(const std::vector<Failure>& failures, CookOutcome& outcome)
{
    outcome.error = failures.front().error;
    outcome.exit_code = failures.front().exit_code;
    for (const Failure& failure : failures)
    {
        outcome.failed_sources.push_back(failure.source);
        if (failure.exit_code != outcome.exit_code)
            outcome.exit_code = kSomeFailed;
    }
}

/// Why the pack is put in its place, where no action ran for it.
std::string outputCause(const std::optional<std::string>& hash_there)
{
    return hash_there ? "it was not what had been cooked: changed since, or damaged" : "it was not there";
}

/// Onto the disk, before it takes the place of what was there; what a cooker wrote is there.
bool flush(const std::string& path)
{
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool flushed = file >= 0 && ::fsync(file) == 0;
    if (file >= 0)
        ::close(file);
    return flushed;
}

/// Move the pack into place, unless what is there already is the same.
bool placePack(const graph::Executor& executor, const std::optional<std::string>& hash_there,
               const CookOptions& options, CookOutcome& outcome)
{
    const graph::KeptOutput& pack = executor.outcomes().back().result.outputs.front();
    outcome.output_bytes = pack.bytes;
    outcome.is_up_to_date = executor.packPath().empty() || (hash_there && *hash_there == pack.hash);
    const bool is_flushed = outcome.is_up_to_date || executor.outcomes().back().ending == Ending::cooked ||
                            flush(executor.packPath());
    if (outcome.is_up_to_date ||
        (is_flushed && ::rename(executor.packPath().c_str(), options.output.c_str()) == 0))
        return true;
    fail({Issue::cannot_write, options.output, "", std::string("cannot write: ") + std::strerror(errno)},
         options.sources.size(), outcome);
    return false;
}

/// Cook, with what is known of cooks before (null: nothing).
void cookGraph(const graph::Graph& graph, CookMemory* memory, const CookOptions& options, EventLog* log,
               CookOutcome& outcome)
{
    cache::Cache* cache = memory == nullptr ? nullptr : &memory->cache();
    graph::ActionCache* actions = memory == nullptr ? nullptr : &memory->actions();
    const std::optional<std::string> hash_there =
        memory == nullptr ? std::nullopt : memory->hashes().hashOf(options.output);
    graph::Resolver resolver(
        graph, cache, actions, [&]() -> const std::optional<graph::Journal>& { return memory->journal(); },
        options.force);
    const ProgressStyle style =
        options.verbosity == Verbosity::quiet ? ProgressStyle::none : progressStyle(options.progress);
    Listeners listeners{log, style, {style, graph.actions.size()}, 0};
    graph::Executor executor(
        graph, resolver, cache, actions,
        {options.jobs, memoryFor(options), !options.fail_fast, programFolder(), options.output},
        eventsFor(options, listeners));
    const bool interrupted = !executor.run(hash_there);
    clearBar();
    std::string output_cause;
    if (interrupted)
    {
        outcome.exit_code = kInterrupted;
        outcome.error = "interrupted";
        outcome.failed_sources = {options.sources.size()};
    }
    else if (!executor.failures().empty())
    {
        takeFailures(executor.failures(), outcome);
        printLeftOut(graph, executor, options);
    }
    else if (listeners.fatal_warnings > 0)
        failByWarnings(listeners.fatal_warnings, options, outcome);
    else if (placePack(executor, hash_there, options, outcome))
    {
        if (!options.report_file.empty())
            fillStages(graph, executor, outcome);
        if (!outcome.is_up_to_date && executor.outcomes().back().ending == Ending::kept)
            output_cause = outputCause(hash_there);
    }
    if (memory == nullptr)
        return;
    const auto has_run = [](const graph::ActionOutcome& end) { return end.ending != Ending::kept; };
    // an interrupted cook is as good as none: the next one's causes are still those of this one
    if (!interrupted && (!output_cause.empty() ||
                         std::any_of(executor.outcomes().begin(), executor.outcomes().end(), has_run)))
        memory->write(journalOf(graph, executor, options, output_cause, memory->journal()));
    if (options.explain && !output_cause.empty())
        print(fmt::format("{:<11}{}: {}", "pack", options.output, output_cause));
}

void cookInto(const CookOptions& options, EventLog* log, CookOutcome& outcome)
{
    const auto failed = [&](const Error& error) { fail(error, options.sources.size(), outcome); };
    if (const Status status = checkOutput(options); !status.ok())
        return failed(status.error());
    const Result<graph::Graph> graph = graph::makeCookGraph(options);
    if (!graph.ok())
        return failed(graph.error());
    if (log != nullptr)
        log->cook(*graph);
    if (options.no_cache)
        return cookGraph(*graph, nullptr, options, log, outcome);
    const auto warn = [&](const Error& warning)
    {
        if (options.verbosity != Verbosity::quiet)
            print(formatMessage(warning));
    };
    const auto memory = CookMemory::open(options.caches, options.output, graph::workingFolder(), warn);
    if (!memory.ok())
        return failed(memory.error());
    cookGraph(*graph, (*memory)->cache().isEmpty() ? nullptr : memory->get(), options, log, outcome);
    (*memory)->finish();
}

} // namespace

int cook(const CookOptions& chosen)
{
    CookOptions options = chosen;
    options.statistics = !options.report_file.empty();
    if (options.dry_run)
        return dryRun(options);
    const auto start = std::chrono::steady_clock::now();
    CookOutcome outcome;
    std::optional<EventLog> log;
    if (!options.events_file.empty())
    {
        Result<EventLog> created = EventLog::create(options.events_file);
        if (!created.ok())
        {
            print(formatMessage(created.error()));
            return exitCode(created.error());
        }
        log.emplace(std::move(created).value());
    }
    cookInto(options, log ? &*log : nullptr, outcome);
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (log)
        log->done(outcome.exit_code, outcome.seconds);
    if (outcome.exit_code == 0 && options.verbosity != Verbosity::quiet)
        print(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", outcome.is_up_to_date ? "up to date" : "cooked",
                          outcome.seconds, readableSize(outcome.output_bytes), options.output));

    if (!options.report_file.empty() && outcome.exit_code != kInterrupted)
        if (const Status status = writeReport(options, outcome); !status.ok())
        {
            print(formatMessage(status.error()));
            return outcome.exit_code != 0 ? outcome.exit_code : exitCode(status.error());
        }
    return outcome.exit_code;
}

} // namespace hearth::command
