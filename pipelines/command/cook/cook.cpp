// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cook.h"

#include "cook/tools/lod_files.h"
#include "cook/tools/sha256.h"
#include "formats/base/atomic_file.h"
#include "formats/base/flush.h"
#include "formats/base/regular_file.h"
#include "pipelines/command/cook/cook_report.h"
#include "pipelines/command/cook/cook_state.h"
#include "pipelines/command/cook/cook_summary.h"
#include "pipelines/command/cook/cook_tools.h"
#include "pipelines/command/cook/depfile.h"
#include "pipelines/command/cook/dry_run.h"
#include "pipelines/command/cook/render_progress.h"
#include "pipelines/command/cook/unmatched_textures.h"
#include "pipelines/command/shell/event_log.h"
#include "pipelines/command/shell/messages.h"
#include "pipelines/command/shell/name_list.h"
#include "pipelines/command/shell/progress.h"
#include "pipelines/command/shell/progress_lines.h"
#include "pipelines/command/sources/size_outliers.h"
#include "pipelines/command/sources/source_list.h"
#include "pipelines/command/sources/unused_files.h"
#include "pipelines/graph/causes.h"
#include "pipelines/graph/executor.h"
#include "pipelines/graph/skip_source.h"
#include "pipelines/report/write_report.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <unistd.h>

namespace hearth::command
{

using namespace tools;
using graph::Failure;
using graph::Outcome;

namespace
{

constexpr int kSomeFailed = 1;

/// Outcome of a cook: the report that the CookRecorder fills.
using CookOutcome = report::CookReport;

// ---- messages

bool isFatalWarning(const std::string& line, const CookOptions& options)
{
    if (!options.fatal_warnings || !graph::isWarning(line))
        return false;
    const std::vector<std::string>& codes = *options.fatal_warnings;
    return codes.empty() || std::find(codes.begin(), codes.end(), splitMessage(line).code) != codes.end();
}

/// True if the cook ends with a summary. Summaries are for people; programs get each message once.
bool hasSummary(const CookOptions& options)
{
    return options.verbosity != Verbosity::quiet && messageFormat() == MessageFormat::text;
}

/// Print a child's messages and count its warnings. Prints errors always, warnings unless quiet, all others
/// only with Verbosity::all.
/// were_printed  the previous cook has printed the same: warnings are only counted, except with
///               Verbosity::all
/// returns    the number of warnings that count as errors
size_t printMessages(const std::vector<std::string>& lines, bool were_printed, const CookOptions& options,
                     CookSummary& summary)
{
    size_t fatal_count = 0;
    for (const std::string& line : lines)
    {
        const bool is_fatal = isFatalWarning(line, options);
        const bool is_warning = graph::isWarning(line);
        const bool is_folded = is_warning && were_printed && !is_fatal && hasSummary(options) &&
                               options.verbosity != Verbosity::all;
        fatal_count += is_fatal ? 1 : 0;
        if (is_warning)
            summary.addWarning(line, is_folded);
        if (graph::isError(line) || is_fatal ||
            (is_warning && !is_folded && options.verbosity != Verbosity::quiet) ||
            options.verbosity == Verbosity::all)
            printMessage(line);
    }
    return fatal_count;
}

/// True if the last cook into the pack had the same result for an action, and so has printed its warnings.
/// state  state of previous cooks; null: none
bool wasPrintedBefore(const graph::Action& action, const graph::ActionOutcome& outcome,
                      const graph::Graph& graph, CookState* state)
{
    if (outcome.ending != Outcome::cached || state == nullptr || !state->journal())
        return false;
    const graph::JournalAction* last = graph::findLastAction(action, graph, *state->journal());
    return last != nullptr && (last->ending == Outcome::cooked || last->ending == Outcome::cached) &&
           last->record == outcome.record;
}

std::string joinWords(const std::vector<std::string>& words, const char* between)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

ProgressStyle chooseProgressStyle(const CookOptions& options)
{
    return options.verbosity == Verbosity::quiet ? ProgressStyle::none : progressStyle(options.progress);
}

/// Receivers of the events of a cook.
struct Listeners
{
    EventLog* log = nullptr; ///< null: none
    ProgressBar bar;
    std::optional<ProgressLines> lines; ///< of plain progress
    size_t fatal_warnings = 0;
    CookSummary summary;
};

/// Make executor events that feed the listeners and the recorder, which must outlive the events.
/// state  state of previous cooks; null: none
graph::ExecutorEvents makeCookEvents(const graph::Graph& graph, const CookOptions& options, CookState* state,
                                     Listeners& listeners, CookRecorder& recorder)
{
    EventLog* const log = listeners.log;
    graph::ExecutorEvents events;
    events.starting = [&options, &listeners, log, &recorder](const graph::Action& action,
                                                             const graph::ActionOutcome& outcome,
                                                             const std::vector<std::string>& command)
    {
        recorder.starting(action);
        if (log != nullptr)
            log->start(action, outcome);
        if (options.explain)
            printMessage(
                fmt::format("{:<11}{}: {}", action.cooker, action.subject, joinWords(outcome.causes, "; ")));
        if (options.verbosity == Verbosity::all)
            printMessage(faint(joinWords(command, " ")));
        listeners.bar.started(action.cooker + " " + action.subject);
        if (listeners.lines)
            listeners.lines->starting(action);
    };
    events.ended = [&graph, &options, state, &listeners, log,
                    &recorder](const graph::Action& action, const graph::ActionOutcome& outcome,
                               const std::vector<std::string>& messages)
    {
        recorder.ended(action, outcome);
        if (log != nullptr)
            log->end(action, outcome);
        const bool were_printed = !messages.empty() && wasPrintedBefore(action, outcome, graph, state);
        listeners.fatal_warnings += printMessages(messages, were_printed, options, listeners.summary);
        if (outcome.ending == Outcome::cooked && options.verbosity == Verbosity::all)
            printStage(action, outcome);
        listeners.bar.ended();
        if (listeners.lines)
            listeners.lines->ended(action, outcome);
    };
    events.waiting = [&listeners]
    {
        if (listeners.lines)
            listeners.lines->waiting();
    };
    events.failed = [&graph, &listeners, log, &recorder](const Failure& failure)
    {
        recorder.failed(failure);
        if (log != nullptr)
            log->error(failure.error);
        if (!failure.is_reported)
            printMessage(failure.error);
        // in a cook of one source the failure is near the end anyway
        if (graph.source_count > 1)
            listeners.summary.addFailure(failure.error);
    };
    return events;
}

/// Warn of sources whose scale differs from the others', by the linked pack.
void warnOfOutliers(const graph::Graph& graph, const graph::Executor& executor, const CookOptions& options,
                    CookState* state, Listeners& listeners, CookRecorder& recorder)
{
    const std::string& linked = executor.packPath().empty() ? options.output : executor.packPath();
    const bool were_printed =
        wasPrintedBefore(graph.actions.back(), executor.outcomes().back(), graph, state);
    const std::vector<size_t> in_pack = graph::sourcesRead(graph, graph.actions.back());
    std::vector<std::string> names;
    for (const size_t source : in_pack)
        names.push_back(options.sources[source]);
    for (const SizeOutlier& outlier : findSizeOutliers(linked, names))
    {
        listeners.fatal_warnings +=
            printMessages({outlier.warning}, were_printed, options, listeners.summary);
        recorder.report().source_warnings[in_pack[outlier.source]] = outlier.warning;
    }
}

/// Warn of rules for textures that match none.
void warnOfUnmatchedTextures(const graph::Graph& graph, graph::Executor& executor, const CookOptions& options,
                             Listeners& listeners)
{
    const auto hasRules = [](const settings::Values& values)
    {
        return settings::findValue(values, "textures.image") != nullptr ||
               settings::findValue(values, "textures.role") != nullptr;
    };
    if (std::ranges::none_of(options.values_of_source, hasRules))
        return;
    std::vector<std::optional<std::string>> statistics(options.sources.size());
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const graph::Action& action = graph.actions[i];
        const Outcome ending = executor.outcomes()[i].ending;
        if (action.cooker == "texels" && (ending == Outcome::cooked || ending == Outcome::cached))
            statistics[action.source] = executor.readOutput(i, 1);
    }
    for (const Error& warning : findUnmatchedTextures(options, statistics))
        listeners.fatal_warnings +=
            printMessages({formatMessage(warning)}, false, options, listeners.summary);
}

/// Print how many sources have failed, if the cook has several. Actions that depend on a failed one are no
/// failures of their own.
void printFailedCount(const graph::Graph& graph, const graph::Executor& executor, const CookOptions& options)
{
    std::set<size_t> failed;
    for (const Failure& failure : executor.failures())
        if (failure.source < graph.source_count)
            failed.insert(failure.source);
    if (!failed.empty() && graph.source_count > 1 && options.verbosity != Verbosity::quiet)
        printMessage(fmt::format("{}: not linked, because a dependency failed: {} of {} sources",
                                 options.output, failed.size(), graph.source_count));
}

/// Print which files of cooked folders no cooker has read. Only for a cook that succeeded: the import of a
/// failed source may not have reached its textures.
void printUnusedFiles(const std::vector<std::string>& files, const CookOptions& options,
                      std::vector<std::string> read)
{
    read.insert(read.end(), {options.output, options.depfile, options.events_file});
    read.insert(read.end(), options.report_files.begin(), options.report_files.end());
    if (const std::string text = unusedFilesText(files, read); !text.empty())
        printMessage(text);
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
    for (const std::string& source : options.sources)
        if (std::filesystem::equivalent(source, options.depfile, error))
            return Error{Issue::usage, options.depfile, "", "the depfile would overwrite a source"};
    if (!options.depfile.empty() &&
        graph::absolutePath(options.depfile) == graph::absolutePath(options.output))
        return Error{Issue::usage, options.depfile, "", "the depfile would overwrite the output"};
    for (const std::vector<std::string>& words : options.lods_of_source)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<LodFile> lods, parseLodFiles(words));
        for (const LodFile& lod : lods)
        {
            if (std::filesystem::equivalent(lod.path, options.output, error))
                return Error{Issue::usage, options.output, "",
                             "the output would overwrite a level of detail"};
            if (std::filesystem::equivalent(lod.path, options.depfile, error))
                return Error{Issue::usage, options.depfile, "",
                             "the depfile would overwrite a level of detail"};
        }
    }
    return success();
}

/// Make the journal of this cook.
/// last  journal of the previous cook: supplies the records of actions that this cook did not reach
graph::Journal makeJournal(const graph::Graph& graph, const graph::Executor& executor,
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
        const graph::JournalAction* before =
            last ? graph::findLastAction(graph.actions[i], graph, *last) : nullptr;
        if (outcome.record.empty() && before != nullptr)
            journal.actions.back().record = before->record;
    }
    return journal;
}

// ---- the cook

void failCook(const Error& error, CookOutcome& outcome)
{
    printMessage(formatMessage(error));
    outcome.exit_code = exitCode(error);
    outcome.error = formatMessage(error);
}

/// Fail because warnings count as errors. The results stay in the cache and warn again in the next cook; the
/// pack is not written.
void failForWarnings(size_t count, const CookOptions& options, CookOutcome& outcome)
{
    outcome.exit_code = kSomeFailed;
    outcome.error =
        fmt::format("{}: error: not written, because warnings count as errors: {}", options.output, count);
    printMessage(outcome.error);
}

/// Store the failures in the outcome: their exit code if all have the same one, else kSomeFailed.
void storeFailures(const std::vector<Failure>& failures, CookOutcome& outcome)
{
    outcome.error = failures.front().error;
    outcome.exit_code = failures.front().exit_code;
    for (const Failure& failure : failures)
        if (failure.exit_code != outcome.exit_code)
            outcome.exit_code = kSomeFailed;
}

/// Store in the outcome which sources the pack lacks, and print their names.
void storeSkipped(const std::vector<size_t>& skipped, const std::vector<Failure>& failures,
                  const CookOptions& options, CookOutcome& outcome)
{
    if (skipped.empty())
        return;
    outcome.skipped = skipped;
    outcome.exit_code = kSomeFailed;
    outcome.error = failures.front().error;
    std::vector<std::string> names;
    for (const size_t source : skipped)
        names.push_back(options.sources[source]);
    if (options.verbosity != Verbosity::quiet)
        printMessage(fmt::format("{}: made without {} of {} sources: {}", options.output, skipped.size(),
                                 options.sources.size(), namesText(names)));
}

/// Return the reason why the pack is put into place although no action has made it.
std::string outputCause(const std::optional<std::string>& old_pack_hash)
{
    return old_pack_hash ? "it was not what had been cooked: changed since, or damaged" : "it was not there";
}

/// Flush a file to the disk, before it replaces the old pack.
bool flush(const std::string& path)
{
    const RegularFile file(path);
    if (file.isOpen())
        return flushFile(file.descriptor());
    errno = file.openError();
    return false;
}

bool writeDepfile(const graph::Graph& graph, const graph::Executor& executor, const CookOptions& options,
                  CookOutcome& outcome)
{
    if (options.depfile.empty())
        return true;
    const Result<std::string> text = makeDepfile(graph, executor, options.output);
    const Status written = text.ok() ? writeText(options.depfile, *text) : Status(text.error());
    if (!written.ok())
        failCook(written.error(), outcome);
    return written.ok();
}

bool haveSameContent(const std::string& a, const std::string& b)
{
    std::error_code error;
    return std::filesystem::file_size(a, error) == std::filesystem::file_size(b, error) && !error &&
           computeFileSha256(a) == computeFileSha256(b);
}

/// Move the pack into place, unless the same pack is there already: build tools compare its time.
/// old_pack_hash  hash of the old pack; nullopt if there is none, or no cache: without a cache the old pack
///                is not hashed
bool placePack(const graph::Executor& executor, const std::optional<std::string>& old_pack_hash,
               const CookOptions& options, CookOutcome& outcome)
{
    const graph::CachedOutput& pack = executor.outcomes().back().result.outputs.front();
    outcome.output_bytes = pack.bytes;
    outcome.is_up_to_date = executor.packPath().empty() || (old_pack_hash && *old_pack_hash == pack.hash);
    if (!outcome.is_up_to_date && !old_pack_hash && haveSameContent(executor.packPath(), options.output))
        return true;
    if (outcome.is_up_to_date ||
        (flush(executor.packPath()) && ::rename(executor.packPath().c_str(), options.output.c_str()) == 0))
        return true;
    failCook({Issue::cannot_write, options.output, "", std::string("cannot write: ") + std::strerror(errno)},
             outcome);
    return false;
}

/// Put a complete pack into place after its depfile; a cook without a pack fails.
/// returns  the reason why the pack is replaced although no action has made it; empty if there is none
std::string finishPack(const graph::Graph& graph, const graph::Executor& executor,
                       const std::optional<std::string>& old_pack_hash, size_t fatal_warnings,
                       const CookOptions& options, CookOutcome& outcome)
{
    if (!executor.hasPack())
    {
        storeFailures(executor.failures(), outcome);
        printFailedCount(graph, executor, options);
        return "";
    }
    if (fatal_warnings > 0)
    {
        failForWarnings(fatal_warnings, options, outcome);
        return "";
    }
    // before the pack: whoever finds a new pack finds its depfile, too
    if (!writeDepfile(graph, executor, options, outcome) ||
        !placePack(executor, old_pack_hash, options, outcome))
        return "";
    outcome.has_pack = true;
    storeSkipped(executor.skippedSources(), executor.failures(), options, outcome);
    const bool is_replaced = !outcome.is_up_to_date && executor.outcomes().back().ending == Outcome::cached;
    return is_replaced ? outputCause(old_pack_hash) : "";
}

/// Run the actions of the graph, and put the pack into place.
/// graph  skipped sources are removed from its actions of the pack
/// state  state of previous cooks; null: none
void cookGraph(graph::Graph& graph, CookState* state, const CookOptions& options, EventLog* log,
               CookRecorder& recorder)
{
    recorder.begin(graph);
    CookOutcome& outcome = recorder.report();
    cache::Cache* cache = state == nullptr ? nullptr : &state->cache();
    graph::ActionCache* actions = state == nullptr ? nullptr : &state->actions();
    const std::optional<std::string> old_pack_hash =
        state == nullptr ? std::nullopt : state->hashes().hashFile(options.output);
    graph::Resolver resolver(
        graph, cache, actions, [&]() -> const std::optional<graph::Journal>& { return state->journal(); },
        options.force);
    const ProgressStyle style = chooseProgressStyle(options);
    Listeners listeners{log, {style, graph.actions.size()}, std::nullopt, 0, {}};
    if (style == ProgressStyle::plain)
        listeners.lines.emplace(graph, printFaint);
    listeners.fatal_warnings = printMessages(options.setting_warnings, false, options, listeners.summary);
    graph::Executor executor(graph, resolver, cache, actions,
                             {makePoolLimits(options.jobs, options.memory_bytes), !options.fail_fast,
                              options.lists_files, programFolder(), options.output, true,
                              options.skips_missing},
                             makeCookEvents(graph, options, state, listeners, recorder));
    const bool interrupted = !executor.run(old_pack_hash);
    clearBar();
    if (!interrupted && executor.hasPack())
    {
        warnOfOutliers(graph, executor, options, state, listeners, recorder);
        warnOfUnmatchedTextures(graph, executor, options, listeners);
    }
    if (!interrupted && hasSummary(options))
        for (const std::string& line : listeners.summary.lines())
            printMessage(line);
    if (options.lists_files)
        recorder.copyDependencies(executor);
    std::string output_cause;
    if (interrupted)
    {
        outcome.exit_code = kInterrupted;
        outcome.error = "interrupted";
    }
    else
        output_cause = finishPack(graph, executor, old_pack_hash, listeners.fatal_warnings, options, outcome);
    if (!options.report_files.empty())
        recorder.copyOutcomes(executor);
    if (state == nullptr)
        return;
    const auto has_run = [](const graph::ActionOutcome& end) { return end.ending != Outcome::cached; };
    // an interrupted cook is not recorded: the next cook has the same causes
    if (!interrupted && (!output_cause.empty() ||
                         std::any_of(executor.outcomes().begin(), executor.outcomes().end(), has_run)))
        state->write(makeJournal(graph, executor, options, output_cause, state->journal()));
    if (options.explain && !output_cause.empty())
        printMessage(fmt::format("{:<11}{}: {}", "pack", options.output, output_cause));
}

/// Check the output, make the graph, open the caches and cook.
/// graph  receives the graph; must outlive the recorder
void cookInto(const CookOptions& options, EventLog* log, std::optional<graph::Graph>& graph,
              CookRecorder& recorder)
{
    const auto failed = [&](const Error& error) { failCook(error, recorder.report()); };
    if (const Status status = checkOutput(options); !status.ok())
        return failed(status.error());
    Result<graph::Graph> made = graph::makeCookGraph(options);
    if (!made.ok())
        return failed(made.error());
    graph = std::move(made).value();
    if (log != nullptr)
        log->cook(*graph);
    if (options.no_cache)
        return cookGraph(*graph, nullptr, options, log, recorder);
    const auto warn = [&](const Error& warning)
    {
        if (options.verbosity != Verbosity::quiet)
            printMessage(formatMessage(warning));
    };
    const auto state = CookState::open(options.caches, options.output, graph::workingFolder(), warn);
    if (!state.ok())
        return failed(state.error());
    if (!options.force)
        (*state)->enablePrefetch(*graph);
    cookGraph(*graph, (*state)->cache().isEmpty() ? nullptr : state->get(), options, log, recorder);
    (*state)->finish();
}

/// Write the reports. Return the exit code of the cook; if it is 0, that of the first report that cannot be
/// written.
int writeReports(const CookOptions& options, CookOutcome& outcome)
{
    if (outcome.has_pack)
        outcome.bytes_of_chunks = readChunkBytes(options.output);
    const std::string json = report::reportJson(outcome);
    for (const std::string& file : options.report_files)
    {
        RenderProgress progress(chooseProgressStyle(options), printFaint);
        const Status status =
            report::writeReport(json, file, outcome.has_pack ? options.output : "", "report",
                                [&](size_t drawn, size_t count) { progress.show(drawn, count); });
        progress.end();
        if (status.ok())
            continue;
        printMessage(formatMessage(status.error()));
        return outcome.exit_code != 0 ? outcome.exit_code : exitCode(status.error());
    }
    return outcome.exit_code;
}

} // namespace

int cook(const CookOptions& chosen, std::vector<std::string>* dependencies)
{
    CookOptions options = chosen;
    const std::vector<std::string> files_in_folders = options.verbosity == Verbosity::quiet
                                                          ? std::vector<std::string>()
                                                          : filesInFolders(options.source_words);
    options.lists_files = dependencies != nullptr || !options.depfile.empty() || !files_in_folders.empty();
    if (options.dry_run)
    {
        command::printMessages(options.setting_warnings, options.verbosity);
        return dryRun(options);
    }
    std::optional<graph::Graph> graph;
    CookRecorder recorder;
    CookOutcome& outcome = recorder.report();
    outcome.sources = options.sources;
    outcome.output = options.output;
    outcome.started = utcNow();
    std::optional<EventLog> log;
    if (!options.events_file.empty())
    {
        Result<EventLog> created = EventLog::create(options.events_file);
        if (!created.ok())
        {
            printMessage(formatMessage(created.error()));
            return exitCode(created.error());
        }
        log.emplace(std::move(created).value());
    }
    cookInto(options, log ? &*log : nullptr, graph, recorder);
    if (dependencies != nullptr)
        *dependencies = recorder.dependencies();
    outcome.seconds = recorder.seconds();
    int exit_code = outcome.exit_code;
    if (!options.report_files.empty() && exit_code != kInterrupted)
        exit_code = writeReports(options, outcome);
    // includes the time of the reports, whose images may take longer than the cook
    const double seconds = recorder.seconds();
    if (log)
        log->done(exit_code, seconds);
    if (outcome.exit_code == 0)
        printUnusedFiles(files_in_folders, options, recorder.dependencies());
    if (outcome.has_pack && options.verbosity != Verbosity::quiet)
        printMessage(fmt::format("{:<10}{:>8.2f} s {:>12}  {}",
                                 outcome.is_up_to_date ? "up to date" : "cooked", seconds,
                                 readableSize(outcome.output_bytes), options.output));
    return exit_code;
}

} // namespace hearth::command
