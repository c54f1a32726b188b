// Decides which actions must run: looks an action up in the cache, and explains a cache miss.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action_cache.h"
#include "pipelines/graph/journal.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

struct Resolution
{
    std::optional<Record> record;       ///< nullopt: the result cannot be cached
    std::optional<CachedResult> result; ///< nullopt: the action must run
    std::vector<std::string> causes;    ///< reasons to run it
};

using JournalSource = std::function<const std::optional<Journal>&()>;

class Resolver
{
public:
    /// cache    null: every action runs
    /// journal  of the last cook into the same pack; called only if an action must run
    Resolver(const Graph& graph, cache::Cache* cache, ActionCache* actions, JournalSource journal,
             bool is_forced)
        : graph_(graph), cache_(cache), actions_(actions), journal_(std::move(journal)), is_forced_(is_forced)
    {
    }

    /// Look an action up.
    /// part_hashes  SHA-256 of each input that an action makes
    Resolution resolve(size_t action, const std::vector<std::string>& part_hashes);

    /// Return the causes of an action that reads outputs which other actions have yet to make.
    std::vector<std::string> causesAfter(size_t action, const std::vector<std::string>& cookers) const;

private:
    Record comparableRecord(size_t action, const std::optional<Record>& record);

    const Graph& graph_;
    cache::Cache* cache_;
    ActionCache* actions_;
    JournalSource journal_;
    bool is_forced_;
};

/// Result of a dry run.
struct Forecast
{
    struct Entry
    {
        bool runs = false;
        std::vector<std::string> causes;
    };
    std::vector<Entry> actions;         ///< [graph.actions.size()]
    std::optional<CachedOutput> result; ///< the pack, if nothing has to run
};
/// graph  gets the inputs that results name: applyList
Forecast forecast(Graph& graph, Resolver& resolver);

} // namespace hearth::graph
