// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/prefetch.h"

#include "pipelines/graph/lists.h"

namespace hearth::graph
{

namespace
{

struct PendingLookup
{
    size_t action = 0;
    Record record;
};

/// True if what is listed for the action is not known yet.
bool waitsForList(const Action& action, const OutputHashes& hashes)
{
    return action.lister != kNoAction && hashes[action.lister].empty();
}

/// Return the actions that can be looked up now, and remove them from `remaining`.
std::vector<PendingLookup> nextWave(const Graph& graph, ActionCache& actions, const OutputHashes& hashes,
                                    std::vector<size_t>& remaining)
{
    std::vector<PendingLookup> wave;
    std::vector<size_t> later;
    for (const size_t index : remaining)
    {
        const Action& action = graph.actions[index];
        const auto part_hashes = findPartHashes(action, hashes);
        if (!part_hashes || waitsForList(action, hashes))
            later.push_back(index);
        else if (std::optional<Record> record = actions.makeRecord(action, *part_hashes))
            wave.push_back({index, std::move(*record)});
    }
    remaining = std::move(later);
    return wave;
}

} // namespace

void prefetch(const Graph& planned, cache::Cache& cache, ActionCache& actions)
{
    Graph graph = planned; // gets the inputs that are only known from results
    OutputHashes hashes(graph.actions.size());
    std::vector<size_t> remaining;
    for (size_t i = 0; i < graph.actions.size(); ++i)
        remaining.push_back(i);
    for (;;)
    {
        const std::vector<PendingLookup> wave = nextWave(graph, actions, hashes, remaining);
        if (wave.empty())
            return;
        std::vector<std::string> keys;
        for (const PendingLookup& lookup : wave)
            keys.push_back(graph.actions[lookup.action].finds_files ? findingsKey(lookup.record)
                                                                    : resultKey(lookup.record));
        cache.prefetch(keys);
        keys.clear();
        for (const PendingLookup& lookup : wave)
            if (graph.actions[lookup.action].finds_files)
                if (const auto record =
                        actions.recordFromFindings(graph.actions[lookup.action], lookup.record))
                    keys.push_back(resultKey(*record));
        cache.prefetch(keys);
        for (const PendingLookup& lookup : wave)
            if (const auto result = actions.find(graph.actions[lookup.action], lookup.record).result)
                if (!graph.actions[lookup.action].is_lister || applyList(graph, lookup.action, result->list))
                    hashes[lookup.action] = listHashes(*result);
    }
}

} // namespace hearth::graph
