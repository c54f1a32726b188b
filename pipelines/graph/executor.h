// Runs what must run of a graph as child processes of this machine, and takes the rest from the cache.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/temp_directory.h"
#include "pipelines/graph/cooker_outcome.h"
#include "pipelines/graph/process_pool.h"
#include "pipelines/graph/resolver.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::graph
{

struct ExecutorOptions
{
    CrewLimits limits;
    bool keeps_going = true;  ///< after a failure, with what does not depend on it
    bool lists_files = false; ///< has cookers list what they find without a cache, too: for filesLookedFor()
    std::string programs;     ///< folder of the cookers
    std::string output;       ///< the pack: temporary files are made beside it, or in TMPDIR
    /// The last action makes the pack. Else all that is made is for the cache alone, and `output` only what messages call it.
    bool makes_pack = true;
};

struct ActionOutcome
{
    Ending ending = Ending::unknown;
    KeptResult result;
    std::vector<std::string> causes;
    Record record;
    /// Where the outputs lie while the executor lives; empty: in the cache only.
    std::vector<std::string> paths;
    bool is_kept = false; ///< the result is in the cache, as far as that has not failed since
};

/// What it tells while it works; each may be empty.
struct ExecutorEvents
{
    std::function<void(const Action& action, const ActionOutcome& outcome,
                       const std::vector<std::string>& command)>
        starting;
    /// messages  what the cooker said, or the kept warnings of a result from the cache; paths in words of the user
    std::function<void(const Action& action, const ActionOutcome& outcome,
                       const std::vector<std::string>& messages)>
        ended;
    std::function<void(const Failure& failure)> failed;
    /// Cookers run: called once a second or more often.
    std::function<void()> waiting;
};

/// While it lives, SIGINT, SIGTERM and SIGHUP end run() instead of the process; its temporary files go with it.
class Executor
{
public:
    /// cache, actions  null: every action runs, and nothing is kept
    Executor(const Graph& graph, Resolver& resolver, cache::Cache* cache, ActionCache* actions,
             ExecutorOptions options, ExecutorEvents events);

    /// Make the pack, unless a file of that hash is there already; without a pack, have every result whole in the cache.
    /// returns  false where a signal ended it
    bool run(const std::optional<std::string>& hash_there);

    const std::vector<ActionOutcome>& outcomes() const { return outcomes_; }
    /// What failed, in the order in which it did.
    const std::vector<Failure>& failures() const { return failures_; }
    /// The whole pack, to be moved into its place; empty where it has failed, or is there already.
    const std::string& packPath() const { return pack_path_; }

    /// Paths of the files that an action has read, or has looked for in vain, without being told of them. Of one that
    /// failed those that it got to.
    std::vector<std::string> filesLookedFor(size_t action) const;

    /// Have the outputs of an action that was taken from the cache as files; false where the cache has lost them.
    bool materialize(size_t action);

    /// One output of an action that ended well, of which nothing else is fetched; nullopt where the cache has lost it.
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

    std::optional<Failure> startWhatCan();
    bool advance(size_t action);
    uint64_t partBytes(size_t action) const;
    std::optional<Failure> start(size_t action);
    std::optional<Failure> makeFolders();
    void materialize(std::span<const size_t> actions);
    bool haveInputs(size_t action);
    void takeEnd(const CrewEnd& end);
    std::optional<Failure> checkOutputs(size_t action);
    void keepResult(size_t action);
    bool finishPack(const std::optional<std::string>& hash_there);
    bool finishParts();
    bool haveAgain(size_t action);
    void fail(size_t action, const Failure& failure);
    bool isPack(size_t action) const;
    std::string pathOf(size_t action, size_t output) const;
    std::string readListOf(size_t action) const;
    std::vector<std::string> pathsOf(size_t action) const;

    const Graph& graph_;
    Resolver& resolver_;
    cache::Cache* cache_;
    ActionCache* actions_;
    ExecutorOptions options_;
    ExecutorEvents events_;

    // before the folders, so that it goes after them: signals wait until they are gone
    Crew crew_;
    std::optional<TempDirectory> beside_; ///< the pack, where a rename can put it in place
    std::optional<TempDirectory> parts_;

    std::vector<State> states_;
    std::vector<ActionOutcome> outcomes_;
    std::vector<bool> has_begun_; ///< of the actions: events_.starting was told
    std::vector<Failure> failures_;
    std::string pack_path_;
};

} // namespace hearth::graph
