// Executes a graph on this machine: takes results from the cache and runs the other actions as child
// processes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/temp_directory.h"
#include "pipelines/graph/cooker_outcome.h"
#include "pipelines/graph/process_pool.h"
#include "pipelines/graph/resolver.h"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::graph
{

struct ExecutorOptions
{
    PoolLimits limits;
    bool keeps_going = true;  ///< after a failure, run the actions that do not depend on it
    bool lists_files = false; ///< pass --depfile to cookers even without a cache: for probedFiles()
    std::string programs;     ///< folder of the cookers
    std::string output;       ///< path of the pack; temporary files are made beside it, or in TMPDIR
    /// True if the last action makes the pack. Else all results go to the cache only, and `output` is just
    /// its name in messages.
    bool makes_pack = true;
    /// True if a source with a failed action is left out of the pack, as skipSource does; else there is no
    /// pack. If all sources fail there is none either.
    bool skips_failed_sources = false;
    /// Actions whose results are wanted; the others run only as far as these need them. Empty: all.
    std::vector<size_t> wanted{};
    /// Results in the cache, by action, that count although nobody has looked what they were made from: what
    /// other machines say of sources that are theirs to check.
    std::map<size_t, CachedResult> known{};
};

struct ActionOutcome
{
    Outcome ending = Outcome::unknown;
    CachedResult result;
    std::vector<std::string> causes;
    Record record;
    /// Paths of the outputs while the executor lives; empty: in the cache only.
    std::vector<std::string> paths;
    bool is_cached = false; ///< the result is in the cache, as far as no write has failed since
};

/// Callbacks for progress; each may be empty.
struct ExecutorEvents
{
    std::function<void(const Action& action, const ActionOutcome& outcome,
                       const std::vector<std::string>& command)>
        starting;
    /// messages  output of the cooker, or the cached warnings of a result from the cache; paths as the user
    ///           typed them
    std::function<void(const Action& action, const ActionOutcome& outcome,
                       const std::vector<std::string>& messages)>
        ended;
    std::function<void(const Failure& failure)> failed;
    /// Called once a second or more often while cookers run.
    std::function<void()> waiting;
};

/// Runs a graph. While it lives, SIGINT, SIGTERM and SIGHUP end run() instead of the process, so that its
/// temporary files are removed.
class Executor
{
public:
    /// graph           skipped sources are removed from its actions of the pack
    /// cache, actions  null: every action runs, and nothing is cached
    Executor(Graph& graph, Resolver& resolver, cache::Cache* cache, ActionCache* actions,
             ExecutorOptions options, ExecutorEvents events);

    /// Make the pack, unless the destination already has that hash. Without a pack, make sure that the cache
    /// has every result, intact.
    /// returns  false where a signal ended it
    bool run(const std::optional<std::string>& existing_hash);

    const std::vector<ActionOutcome>& outcomes() const { return outcomes_; }
    /// Failures, in order of time.
    const std::vector<Failure>& failures() const { return failures_; }
    /// True if the pack exists, complete, at packPath() or at its destination.
    bool hasPack() const { return has_pack_; }
    /// Path of the complete pack, to be moved to its destination; empty where it has failed or is already
    /// there.
    const std::string& packPath() const { return pack_path_; }
    /// Sources that the pack lacks, ascending.
    std::vector<size_t> skippedSources() const;

    /// Paths of files the action opened or probed that are not declared inputs. For a failed action, the
    /// files that it got to.
    std::vector<std::string> probedFiles(size_t action) const;

    /// Fetch the outputs of an action that was taken from the cache as files; false where the cache has lost
    /// them.
    bool materialize(size_t action);

    /// Return one output of an action that succeeded, and fetch no other; nullopt where the cache has lost
    /// it.
    std::optional<std::string> readOutput(size_t action, size_t output);

private:
    enum class State
    {
        waiting,
        must_run,
        running,
        done,
        failed,
    };

    struct OutputId
    {
        size_t action = kNoAction;
        size_t output = 0;
    };

    std::optional<Failure> startReady();
    bool advance(size_t action);
    bool areInputsDone(size_t action) const;
    void need(size_t action);
    bool addListed(size_t lister);
    bool areSourcesSettled(size_t reader) const;
    bool skipFailedSources();
    uint64_t partBytes(size_t action) const;
    std::optional<Failure> start(size_t action);
    std::optional<Failure> makeFolders();
    void fetchOutputs(std::span<const OutputId> outputs);
    void materialize(std::span<const size_t> actions);
    bool hasFile(const Input& input) const;
    std::string inputPath(const Input& input) const;
    bool ensureInputs(size_t action);
    void handleEnd(const ActionEnd& end);
    std::optional<Failure> checkOutputs(size_t action);
    std::optional<Failure> takeList(size_t action);
    void cacheResult(size_t action);
    bool finishPack(const std::optional<std::string>& existing_hash);
    bool finishParts();
    bool ensureResult(size_t action);
    void fail(size_t action, const Failure& failure);
    bool isPack(size_t action) const;
    std::string contentPath(size_t action, size_t output) const;
    std::string readListPath(size_t action) const;
    std::vector<std::string> cookerOutputPaths(size_t action) const;

    Graph& graph_;
    Resolver& resolver_;
    cache::Cache* cache_;
    ActionCache* actions_;
    ExecutorOptions options_;
    ExecutorEvents events_;

    // declared before the folders, so that it is destroyed after them: signals wait until they are gone
    ProcessPool pool_;
    /// beside the pack's destination, so that a rename can put it in place
    std::optional<TempDirectory> pack_folder_;
    std::optional<TempDirectory> part_folder_;

    std::vector<State> states_;
    std::vector<ActionOutcome> outcomes_;
    std::vector<bool> has_begun_; ///< for each action: events_.starting was called
    std::vector<Failure> failures_;
    std::vector<bool> is_needed_;  ///< for each action: wanted, or read by one that is needed
    std::vector<bool> is_skipped_; ///< for each source: removed from the actions of the pack
    bool has_pack_ = false;
    std::string pack_path_;
};

} // namespace hearth::graph
