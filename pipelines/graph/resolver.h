// Decides what must run: looks an action up in the cache, and says why where it is not there.
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

struct Resolved
{
    std::optional<Record> record;     ///< nothing: the result cannot be kept
    std::optional<KeptResult> result; ///< nothing: the action must run
    std::vector<std::string> causes;  ///< why, where it must
};

using JournalSource = std::function<const std::optional<Journal>&()>;

class Resolver
{
public:
    /// cache    null: every action runs
    /// journal  of the last cook into the same pack; asked for where something must run
    Resolver(const Graph& graph, cache::Cache* cache, ActionCache* actions, JournalSource journal,
             bool is_forced)
        : graph_(graph), cache_(cache), actions_(actions), journal_(std::move(journal)), is_forced_(is_forced)
    {
    }

    /// part_hashes  of each input that an action makes
    Resolved resolve(size_t action, const std::vector<std::string>& part_hashes);

    /// The causes of an action that reads what others will have to make.
    std::vector<std::string> causesAfter(size_t action, const std::vector<std::string>& cookers) const;

private:
    Record comparable(size_t action, const std::optional<Record>& record);

    const Graph& graph_;
    cache::Cache* cache_;
    ActionCache* actions_;
    JournalSource journal_;
    bool is_forced_;
};

/// What a cook would do now.
struct Forecast
{
    struct Entry
    {
        bool runs = false;
        std::vector<std::string> causes;
    };
    std::vector<Entry> actions;       ///< of the graph
    std::optional<KeptOutput> result; ///< the pack, where nothing runs
};
Forecast forecast(const Graph& graph, Resolver& resolver);

} // namespace hearth::graph
