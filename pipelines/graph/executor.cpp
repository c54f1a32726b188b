// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/executor.h"

#include "cook/tools/dependency_list.h"
#include "cook/tools/sha256.h"
#include "formats/base/regular_file.h"
#include "pipelines/graph/lists.h"
#include "pipelines/graph/skip_source.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace hearth::graph
{

namespace
{

constexpr const char* kLost = "its result is not in the cache, or not whole";

std::optional<uint64_t> fileSize(const std::string& path)
{
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(path, error);
    return error ? std::nullopt : std::optional<uint64_t>(size);
}

std::optional<std::string> readIfThere(const std::string& path)
{
    Result<std::string> text = readFile(path);
    return text ? std::optional<std::string>(std::move(text).value()) : std::nullopt;
}

/// Replace paths in temporary folders by the subject, which the user knows.
std::string replacePaths(std::string text, const std::vector<std::string>& paths, const std::string& subject)
{
    for (const std::string& path : paths)
        for (size_t at = text.find(path); at != std::string::npos; at = text.find(path, at))
        {
            text.replace(at, path.size(), subject);
            at += subject.size();
        }
    return text;
}

} // namespace

Executor::Executor(Graph& graph, Resolver& resolver, cache::Cache* cache, ActionCache* actions,
                   ExecutorOptions options, ExecutorEvents events)
    : graph_(graph),
      resolver_(resolver),
      cache_(cache),
      actions_(actions),
      options_(std::move(options)),
      events_(std::move(events)),
      pool_(graph, options_.limits),
      states_(graph.actions.size(), State::waiting),
      outcomes_(graph.actions.size()),
      has_begun_(graph.actions.size()),
      is_needed_(graph.actions.size(), options_.wanted.empty()),
      is_skipped_(graph.source_count)
{
    for (const size_t action : options_.wanted)
        need(action);
}

/// Mark an action as needed, and those that it reads from.
void Executor::need(size_t index)
{
    if (is_needed_[index])
        return;
    is_needed_[index] = true;
    const Action& action = graph_.actions[index];
    for (const Input& input : action.inputs)
        if (input.action != kNoAction)
            need(input.action);
    if (action.lister != kNoAction)
        need(action.lister);
}

/// Add the inputs and words that an action has listed. False where its list is malformed.
bool Executor::addListed(size_t lister)
{
    if (!applyList(graph_, lister, outcomes_[lister].result.list))
        return false;
    for (size_t i = 0; i < graph_.actions.size(); ++i)
        if (is_needed_[i] && graph_.actions[i].lister == lister)
            for (const Input& input : graph_.actions[i].inputs)
                need(input.action);
    return true;
}

std::optional<Failure> Executor::makeFolders()
{
    if (part_folder_)
        return std::nullopt;
    if (options_.makes_pack)
    {
        Result<TempDirectory> pack_folder =
            TempDirectory::create(parentFolder(options_.output), options_.output);
        if (!pack_folder.ok())
            return makeFailure(pack_folder.error(), graph_.source_count);
        pack_folder_.emplace(std::move(pack_folder).value());
    }
    Result<TempDirectory> parts = TempDirectory::create(
        temporaryFolderOr(pack_folder_ ? pack_folder_->path() : "/tmp"), options_.output);
    if (!parts.ok())
        return makeFailure(parts.error(), graph_.source_count);
    part_folder_.emplace(std::move(parts).value());
    return std::nullopt;
}

std::string Executor::readListPath(size_t action) const
{
    return fmt::format("{}/{}.reads", part_folder_->path(), action);
}

bool Executor::isPack(size_t action) const
{
    return options_.makes_pack && action + 1 == graph_.actions.size();
}

/// Return the paths that the action's cooker writes to.
std::vector<std::string> Executor::cookerOutputPaths(size_t action) const
{
    std::vector<std::string> paths;
    for (const std::string& output : graph_.actions[action].outputs)
        // the pack is on the file system of its destination, so that a rename can move it
        paths.push_back(isPack(action) ? pack_folder_->path() + "/" + output
                                       : fmt::format("{}/{}.{}", part_folder_->path(),
                                                     graph_.actions[action].source, output));
    return paths;
}

/// Return the path of an output with known content. The name is the same in every cook, since a cooker may
/// write the name of its input into its output. Equal contents share one file.
std::string Executor::contentPath(size_t action, size_t output) const
{
    return isPack(action) ? cookerOutputPaths(action)[output]
                          : part_folder_->path() + "/" + outcomes_[action].result.outputs[output].hash;
}

bool Executor::materialize(size_t action)
{
    materialize(std::span(&action, 1));
    return !outcomes_[action].paths.empty();
}

/// Fetch the outputs that are not there as files in one call: a cache on a server answers many requests in
/// the time of one.
void Executor::fetchOutputs(std::span<const OutputId> outputs)
{
    if (outputs.empty() || cache_ == nullptr || makeFolders())
        return;
    std::vector<cache::ContentRequest> wanted;
    std::set<std::string> paths_wanted; // equal contents share one file
    for (const OutputId id : outputs)
    {
        const CachedOutput& output = outcomes_[id.action].result.outputs[id.output];
        const std::string path = contentPath(id.action, id.output);
        // the pack becomes a user file, which may be written to
        const cache::FileAccess use =
            isPack(id.action) ? cache::FileAccess::read_write : cache::FileAccess::read_only;
        if (!fileSize(path) && paths_wanted.insert(path).second)
            wanted.push_back({output.hash, path, use, output.bytes});
    }
    cache_->fetch(wanted);
}

/// Fetch all outputs of these actions.
void Executor::materialize(std::span<const size_t> actions)
{
    std::vector<size_t> missing;
    std::copy_if(actions.begin(), actions.end(), std::back_inserter(missing),
                 [&](size_t action) { return outcomes_[action].paths.empty(); });
    std::vector<OutputId> outputs;
    for (const size_t action : missing)
        for (size_t i = 0; i < outcomes_[action].result.outputs.size(); ++i)
            outputs.push_back({action, i});
    if (outputs.empty() || cache_ == nullptr || makeFolders())
        return;
    fetchOutputs(outputs);
    for (const size_t action : missing)
    {
        std::vector<std::string> paths;
        for (size_t i = 0; i < outcomes_[action].result.outputs.size(); ++i)
            paths.push_back(contentPath(action, i));
        if (std::all_of(paths.begin(), paths.end(), fileSize))
            outcomes_[action].paths = paths;
    }
}

/// Return the path of an input's file; the file exists after ensureInputs().
std::string Executor::inputPath(const Input& input) const
{
    if (input.action == kNoAction)
        return input.path;
    const std::vector<std::string>& paths = outcomes_[input.action].paths;
    return paths.empty() ? contentPath(input.action, input.output) : paths[input.output];
}

/// True if the file of an input that an action makes exists.
bool Executor::hasFile(const Input& input) const
{
    return !outcomes_[input.action].paths.empty() || (input.output != 0 && fileSize(inputPath(input)));
}

std::vector<std::string> Executor::probedFiles(size_t index) const
{
    const Action& action = graph_.actions[index];
    if (!action.finds_files)
        return {};
    if (outcomes_[index].ending == Outcome::cached)
        return actions_->probedFiles(action, outcomes_[index].record);
    const Result<std::string> text = readFile(readListPath(index));
    const auto reads = text ? tools::DependencyList::parse(*text) : std::nullopt;
    std::vector<std::string> paths;
    if (reads)
        for (const auto& [path, hash] : reads->files())
            paths.push_back(path);
    return paths;
}

std::optional<std::string> Executor::readOutput(size_t action, size_t output)
{
    const ActionOutcome& outcome = outcomes_[action];
    if (!outcome.paths.empty())
        return readIfThere(outcome.paths[output]);
    if (cache_ == nullptr || makeFolders())
        return std::nullopt;
    const std::string path = contentPath(action, output);
    if (!fileSize(path) &&
        !cache_->fetch(outcome.result.outputs[output].hash, path, cache::FileAccess::read_only))
        return std::nullopt;
    return readIfThere(path);
}

/// Make sure that the action's input files exist; an input that the cache has lost is made again first. Of an
/// action whose part is not read, only the output that is read is fetched.
bool Executor::ensureInputs(size_t action)
{
    std::vector<size_t> producers;
    std::vector<OutputId> others;
    for (const Input& input : graph_.actions[action].inputs)
        if (input.action != kNoAction && input.output == 0)
            producers.push_back(input.action);
        else if (input.action != kNoAction && outcomes_[input.action].paths.empty())
            others.push_back({input.action, input.output});
    materialize(producers);
    fetchOutputs(others);
    bool have = true;
    for (const Input& input : graph_.actions[action].inputs)
    {
        if (input.action == kNoAction || hasFile(input) || ensureResult(input.action))
            continue;
        have = false;
        // the remade input may differ
        states_[action] = State::waiting;
    }
    return have;
}

/// Return the bytes of the action's inputs that earlier actions made.
uint64_t Executor::partBytes(size_t action) const
{
    uint64_t bytes = 0;
    for (const Input& input : graph_.actions[action].inputs)
        if (input.action != kNoAction)
            bytes += outcomes_[input.action].result.outputs[input.output].bytes;
    return bytes;
}

std::optional<Failure> Executor::start(size_t index)
{
    const Action& action = graph_.actions[index];
    if (auto failure = makeFolders())
        return failure;
    ActionPaths paths{{}, cookerOutputPaths(index)};
    for (const Input& input : action.inputs)
        paths.inputs.push_back(inputPath(input));
    std::vector<std::string> command = commandLine(action, options_.programs, paths);
    if (action.finds_files && (cache_ != nullptr || options_.lists_files))
        command.insert(command.end(), {"--depfile", readListPath(index)});
    if (events_.starting && !has_begun_[index])
        events_.starting(action, outcomes_[index], command);
    has_begun_[index] = true;
    if (const Status started = pool_.start(index, partBytes(index), command); !started.ok())
        return makeFailure(started.error(), action.source);
    states_[index] = State::running;
    return std::nullopt;
}

/// True if it is known which sources fail before an action of the pack reads them.
bool Executor::areSourcesSettled(size_t reader) const
{
    const bool is_list = graph_.actions[reader].is_lister;
    for (size_t i = 0; i < states_.size(); ++i)
    {
        const Action& action = graph_.actions[i];
        // what waits for one list may be waited for by another
        const bool waits_for_list = is_list && action.lister != kNoAction;
        const bool is_settled = states_[i] == State::done || states_[i] == State::failed;
        if (action.source == graph_.source_count ? states_[i] == State::running
                                                 : is_needed_[i] && !waits_for_list && !is_settled)
            return false;
    }
    return true;
}

/// Remove sources that have failed since the last call from the actions of the pack, unless all have failed.
/// A source can fail late, when a lost result is made again: what was made with it is then made again without
/// it. False where nothing has changed.
bool Executor::skipFailedSources()
{
    std::vector<bool> has_failed(graph_.source_count, false);
    for (const Failure& failure : failures_)
        if (failure.source < graph_.source_count)
            has_failed[failure.source] = true;
    if (has_failed == is_skipped_ || std::count(has_failed.begin(), has_failed.end(), false) == 0)
        return false;
    for (size_t i = 0; i < states_.size(); ++i)
    {
        const Action& action = graph_.actions[i];
        // failed because the list, or a neighbour, has failed, not by itself
        const bool was_left_out = outcomes_[i].ending == Outcome::skipped;
        const bool is_listed = action.lister != kNoAction && !has_failed[action.source];
        if (states_[i] == State::failed ? !(is_listed && was_left_out)
                                        : !is_listed && !readsSources(graph_, action))
            continue;
        states_[i] = State::waiting;
        outcomes_[i].paths.clear();
    }
    for (size_t i = 0; i < graph_.actions.size(); ++i)
        if (graph_.actions[i].is_lister)
            removeListed(graph_, i);
    for (size_t source = 0; source < graph_.source_count; ++source)
        if (has_failed[source] && !is_skipped_[source])
            skipSource(graph_, source, failures_);
    is_skipped_ = has_failed;
    return true;
}

std::vector<size_t> Executor::skippedSources() const
{
    std::vector<size_t> skipped;
    for (size_t source = 0; source < is_skipped_.size(); ++source)
        if (is_skipped_[source])
            skipped.push_back(source);
    return skipped;
}

/// Advance an action that waits or must run by one step. True if its state has changed.
bool Executor::advance(size_t index)
{
    const Action& action = graph_.actions[index];
    const auto isIn = [&](State state)
    {
        return [this, state](const Input& input)
        { return input.action != kNoAction && states_[input.action] == state; };
    };
    ActionOutcome& outcome = outcomes_[index];
    if (options_.skips_failed_sources && readsSources(graph_, action))
    {
        if (!areSourcesSettled(index))
            return false;
        if (skipFailedSources())
            return true;
    }
    const size_t lister = action.lister;
    if (std::any_of(action.inputs.begin(), action.inputs.end(), isIn(State::failed)) ||
        (lister != kNoAction && states_[lister] == State::failed))
    {
        states_[index] = State::failed;
        outcome.ending = Outcome::skipped;
        return true;
    }
    if (states_[index] != State::waiting || !areInputsDone(index))
        return false;
    if (const auto known = options_.known.find(index); known != options_.known.end())
    {
        states_[index] = State::done;
        outcome.ending = Outcome::cached;
        outcome.is_cached = true;
        outcome.result = known->second;
        return true;
    }

    std::vector<std::string> part_hashes;
    for (const Input& input : action.inputs)
        part_hashes.push_back(
            input.action == kNoAction ? "" : outcomes_[input.action].result.outputs[input.output].hash);
    Resolution resolved = resolver_.resolve(index, part_hashes);
    outcome.record = resolved.record.value_or(Record());
    outcome.causes = std::move(resolved.causes);
    if (!resolved.result)
    {
        states_[index] = State::must_run;
        return true;
    }
    states_[index] = State::done;
    outcome.ending = Outcome::cached;
    outcome.is_cached = true;
    outcome.result = std::move(*resolved.result);
    if (action.is_lister && !addListed(index))
    {
        states_[index] = State::must_run;
        outcome.causes = {kLost};
        return true;
    }
    if (events_.ended)
        events_.ended(action, outcome, outcome.result.warnings);
    return true;
}

/// True if all that the action reads has been made.
bool Executor::areInputsDone(size_t index) const
{
    const Action& action = graph_.actions[index];
    const auto isDone = [&](size_t before) { return before == kNoAction || states_[before] == State::done; };
    return isDone(action.lister) && std::all_of(action.inputs.begin(), action.inputs.end(),
                                                [&](const Input& input) { return isDone(input.action); });
}

std::optional<Failure> Executor::startReady()
{
    for (bool has_changed = true; has_changed;)
    {
        has_changed = false;
        for (size_t i = 0; i < graph_.actions.size(); ++i)
        {
            if (!is_needed_[i])
                continue;
            if (states_[i] == State::waiting || states_[i] == State::must_run)
                has_changed |= advance(i);
            if (states_[i] != State::must_run || !areInputsDone(i) || !pool_.canStart(i, partBytes(i)))
                continue;
            has_changed = true;
            if (!ensureInputs(i))
                continue;
            if (auto failure = start(i))
                return failure;
        }
    }
    return std::nullopt;
}

void Executor::fail(size_t action, const Failure& failure)
{
    states_[action] = State::failed;
    outcomes_[action].ending = Outcome::failed;
    failures_.push_back(failure);
}

/// Check that the outputs exist, and take them into the outcome; else report a defect of the cooker.
std::optional<Failure> Executor::checkOutputs(size_t index)
{
    ActionOutcome& outcome = outcomes_[index];
    outcome.paths = cookerOutputPaths(index);
    outcome.result.outputs.clear();
    for (size_t i = 0; i < outcome.paths.size(); ++i)
    {
        const std::optional<uint64_t> bytes = fileSize(outcome.paths[i]);
        if (!bytes)
            return makeFailure({Issue::child_failed, graph_.actions[index].subject, "",
                                "hearth-" + graph_.actions[index].cooker + " ended well, but made nothing"},
                               graph_.actions[index].source);
        outcome.result.outputs.push_back({"", *bytes});
        if (cache_ == nullptr)
            continue;
        outcome.result.outputs.back().hash = tools::computeFileSha256(outcome.paths[i]).value_or("");
        if (const std::string known = contentPath(index, i);
            ::rename(outcome.paths[i].c_str(), known.c_str()) == 0)
            outcome.paths[i] = known;
    }
    return std::nullopt;
}

/// Read the list that an action has made; else report a defect of its cooker.
std::optional<Failure> Executor::takeList(size_t index)
{
    ActionOutcome& outcome = outcomes_[index];
    outcome.result.list = readIfThere(outcome.paths.front()).value_or("");
    if (addListed(index))
        return std::nullopt;
    const Action& action = graph_.actions[index];
    return makeFailure({Issue::child_failed, action.subject, "",
                        "hearth-" + action.cooker + " ended well, but its list is malformed"},
                       action.source);
}

void Executor::cacheResult(size_t index)
{
    const Action& action = graph_.actions[index];
    ActionOutcome& outcome = outcomes_[index];
    if (cache_ == nullptr || outcome.record.empty())
        return;
    if (action.finds_files)
    {
        const Result<std::string> text = readFile(readListPath(index));
        const auto reads = text ? tools::DependencyList::parse(*text) : std::nullopt;
        const auto whole = reads ? actions_->recordFromReads(action, outcome.record, *reads) : std::nullopt;
        if (!whole)
            return;
        outcome.record = *whole;
    }
    if (!cache_->isWritable())
        return;
    for (size_t i = 0; i < outcome.paths.size(); ++i)
        cache_->put(outcome.result.outputs[i].hash, outcome.paths[i],
                    isPack(index) ? cache::FileAccess::read_write : cache::FileAccess::read_only);
    actions_->store(action, outcome.record, outcome.result);
    outcome.is_cached = cache_->isWritable();
}

void Executor::handleEnd(const ActionEnd& action_end)
{
    for (const size_t action : action_end.not_begun)
        states_[action] = State::must_run;
    if (action_end.action == kNoAction)
        return;
    const tools::ChildOutcome& end = action_end.end;
    const size_t index = action_end.action;
    const Action& action = graph_.actions[index];
    ActionOutcome& outcome = outcomes_[index];

    std::vector<std::string> private_paths = cookerOutputPaths(index);
    for (const Input& input : action.inputs)
        if (input.action != kNoAction)
            private_paths.push_back(inputPath(input));
    const std::vector<std::string> lines =
        splitLines(replacePaths(end.messages, private_paths, action.subject));
    outcome.result.warnings.clear();
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(outcome.result.warnings), isWarning);
    outcome.result.seconds = end.seconds;
    outcome.result.cpu_seconds = end.cpu_seconds;
    outcome.result.peak_rss_bytes = end.peak_rss_bytes;
    std::optional<Failure> failure = makeFailure(action, end, lines);
    if (!failure)
        failure = checkOutputs(index);
    if (!failure && action.is_lister)
        failure = takeList(index);
    if (failure)
        fail(index, *failure);
    else
    {
        states_[index] = State::done;
        outcome.ending = Outcome::cooked;
        cacheResult(index);
    }
    if (events_.ended)
        events_.ended(action, outcome, lines);
    if (failure && events_.failed)
        events_.failed(*failure);
}

/// Make sure that the pack exists as a file, unless the destination has it already. False where it must be
/// linked again first.
bool Executor::finishPack(const std::optional<std::string>& existing_hash)
{
    const size_t last = graph_.actions.size() - 1;
    if (states_[last] != State::done)
        return true;
    if (cache_ != nullptr && existing_hash == outcomes_[last].result.outputs.front().hash)
    {
        has_pack_ = true;
        return true;
    }
    if (!ensureResult(last))
        return false;
    has_pack_ = true;
    pack_path_ = outcomes_[last].paths.front();
    return true;
}

/// Make sure that an action's outputs exist as files. False where the cache has lost them; the action must
/// run then.
bool Executor::ensureResult(size_t action)
{
    if (materialize(action))
        return true;
    // a result that was only known from elsewhere has no record yet: look for it first
    states_[action] = options_.known.erase(action) > 0 ? State::waiting : State::must_run;
    outcomes_[action].is_cached = false;
    outcomes_[action].causes = {kLost};
    return false;
}

/// Make sure that every wanted result exists as files and is intact. False where some must be made again
/// first.
bool Executor::finishParts()
{
    bool have = true;
    for (size_t i = 0; i < states_.size(); ++i)
        if (states_[i] == State::done &&
            (options_.wanted.empty() || std::ranges::count(options_.wanted, i) > 0))
            have = ensureResult(i) && have;
    return have;
}

bool Executor::run(const std::optional<std::string>& existing_hash)
{
    for (;;)
    {
        if (const auto failure = startReady())
        {
            // a process or folder cannot be created: nothing else would succeed
            failures_.push_back(*failure);
            if (events_.failed)
                events_.failed(*failure);
            return true;
        }
        if (pool_.isIdle())
        {
            if (options_.skips_failed_sources && skipFailedSources())
                continue;
            if (options_.makes_pack ? finishPack(existing_hash) : finishParts())
                return true;
            continue;
        }
        const std::optional<ActionEnd> end = pool_.wait(events_.waiting);
        if (!end)
            return false;
        handleEnd(*end);
        if (!failures_.empty() && !options_.keeps_going)
            return true;
    }
}

} // namespace hearth::graph
